#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# consolidation_test.sh FOLDER: runs the program FOLDER/consolidation on small columns with every option and bad input,
# and checks the keys on stdout, the files, the messages and the exit codes.
set -uo pipefail
binary=$(realpath "$1")/consolidation
source "$(dirname "$(realpath "${BASH_SOURCE[0]}")")/common.sh"
make_packing box >beads.txt
make_packing none >no_box.txt

keys="grains height porosity permeability modulus viscosity c_v consolidation_over_wave_time time_step drag_step_bound \
initial_pressure settlement_final settlement_error_max pressure_error_max pressure_error_rms mass_defect \
swept_volume_defect steps rebuilds unsolved_steps seconds_packing seconds_coupled peak_rss_mb"
files="profiles.csv profiles.svg settlement.csv settlement.svg"

# runs TITLE ARGUMENTS…: must succeed, with the keys in their order and all files.
runs() {
  title=$1
  shift
  rm -rf out
  "$binary" "$@" --out out >stdout 2>stderr || fail "$title: exit code $? ($(tail -n 1 stderr))"
  local found
  found=$(sed -n 's/^\([a-z0-9_]*\)=.*/\1/p' stdout | tr '\n' ' ')
  [ "$(echo $found)" = "$(echo $keys)" ] || fail "$title: keys are: $found"
  [ "$(cd out && echo *)" = "$files" ] || fail "$title: files are: $(cd out && echo *)"
  # of columns a few grains wide, that are asked to drain not much slower than a wave passes
  expect settlement_error_max "< 0.15"
  expect pressure_error_rms "< 0.15"
  expect mass_defect "< 1e-12"
  expect swept_volume_defect "< 1e-9"
  expect unsolved_steps "== 0"
  expect drag_step_bound "> 0"
  expect c_v "> 0"
  if command -v xmllint >/dev/null; then
    xmllint --noout out/settlement.svg out/profiles.svg || fail "$title: XML"
  fi
}

# refuses TITLE MESSAGE ARGUMENTS…: must exit with 2, say MESSAGE (a regular expression), and write nothing.
refuses() {
  title=$1
  local message=$2 code=0
  shift 2
  rm -rf out
  "$binary" "$@" --out out >stdout 2>stderr || code=$?
  [ "$code" = 2 ] || fail "$title: exit code $code, expected 2"
  grep -Eq -- "$message" stderr || fail "$title: said '$(cat stderr)', expected '$message'"
  [ ! -s stdout ] || fail "$title: wrote on stdout"
  [ ! -e out ] && [ ! -e consolidation_out ] || fail "$title: wrote files"
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

"$binary" --help >stdout 2>stderr || fail "help: exit code $?"
for option in --grains --slenderness --seed --modulus --stress --step --slowness --end --refresh-every --rebuild-every --out; do
  grep -q -- "$option" stdout || fail "help does not name $option"
done

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
title="a folder that cannot be"
touch taken
code=0
"$binary" $small --out taken/here >stdout 2>stderr || code=$?
[ "$code" = 1 ] || fail "$title: exit code $code, expected 1"
[ ! -s stdout ] || fail "$title: wrote on stdout"
report
