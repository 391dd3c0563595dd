#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# consolidation_test.sh FOLDER: runs the program FOLDER/consolidation on small columns with every option and bad input,
# and checks the keys on stdout, the files, the messages and the exit codes.
source "$(dirname "$(realpath "${BASH_SOURCE[0]}")")/common.sh"

keys="grains height porosity permeability modulus viscosity c_v consolidation_over_wave_time time_step drag_step_bound \
initial_pressure settlement_final settlement_error_max pressure_error_max pressure_error_rms mass_defect \
swept_volume_defect steps rebuilds unsolved_steps seconds_packing seconds_coupled peak_rss_mb"
files="profiles.csv profiles.svg settlement.csv settlement.svg"

every_run() {
  # of columns a few grains wide, that are asked to drain not much slower than a wave passes
  expect settlement_error_max "< 0.15"
  expect pressure_error_rms "< 0.15"
  expect mass_defect "< 1e-12"
  expect swept_volume_defect "< 1e-9"
  expect unsolved_steps "== 0"
  expect drag_step_bound "> 0"
  expect c_v "> 0"
}

small="--grains 120 --slenderness 2 --end 0.11"
runs "small" $small
[ "$(value grains)" = 120 ] || fail "grains=$(value grains)"
[ "$(value consolidation_over_wave_time)" = 50 ] || fail "slowness=$(value consolidation_over_wave_time)"
[ "$(wc -l <out/profiles.csv)" = 21 ] || fail "profiles.csv: expected ten layers at T = 0.05 and at 0.1"
expect rebuilds "== 0"
height=$(value height)
viscosity=$(value viscosity)
sed '/^seconds\|^peak/d' stdout >first
runs "again" $small
sed '/^seconds\|^peak/d' stdout | cmp -s first - || fail "a second run gives other numbers"

runs "rebuilds, rarer conductances" $small --rebuild-every 50 --refresh-every 100
expect rebuilds "> 2"
runs "another seed" $small --seed 2
expect height "!= $height"
runs "slower" $small --slowness 100
expect viscosity "> 1.99 * $viscosity"
expect viscosity "< 2.01 * $viscosity"
runs "harder grains, more load" $small --modulus 2e8 --stress 4e6
expect height "> 0.999 * $height"  # the same shape: the load has grown with the stiffness
expect height "< 1.001 * $height"
runs "smaller step of the load" $small --step 0.005
runs "grains from a file" beads.txt --end 0.06
[ "$(value grains)" = 343 ] || fail "grains=$(value grains)"

helps --grains --slenderness --seed --modulus --stress --step --slowness --end --refresh-every --rebuild-every --out

refuses "unknown option" "surprise" --surprise
refuses "no number" "--end" --end soon
refuses "no stress" "--stress: found 0, expected a finite number above 0" --stress 0
refuses "negative step" "--step: found -0.01" --step=-0.01
refuses "infinite modulus" "--modulus: found inf" --modulus inf
refuses "no number at all" "--slowness: found -?nan" --slowness nan
refuses "flat" "--slenderness: found 0" --slenderness 0
refuses "too short" "--end: found 0.01, expected at least 0.05" --end 0.01
refuses "never a conductance" "--refresh-every: found 0, expected at least 1" --refresh-every 0
refuses "too few" "--grains: found 20, expected at least 50" --grains 20
refuses "missing file" "absent.txt: found .*No such file" absent.txt
refuses "no box" "the packing: found .*expected a box with six walls" no_box.txt
cannot_write $small
report
