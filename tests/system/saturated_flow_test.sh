#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# saturated_flow_test.sh FOLDER: runs the program FOLDER/saturated_flow on small packings with every option and bad
# input, and checks the keys on stdout, the files, the messages and the exit codes.
source "$(dirname "$(realpath "${BASH_SOURCE[0]}")")/common.sh"

keys="grains pores throats nodes flat_pores coincident_throats closed_throats refused_throats permeability \
permeability_over_r2 flux_in flux_out force_total_x force_total_y force_total_z force_defect min_pressure max_pressure \
contrast dissipation_at_throats iterations backward_error seconds_tessellation seconds_laws seconds_setup seconds_solve \
seconds_resolve peak_rss_mb"
files="forces.csv gradient.png grains.vtp pores.vtu pressure.svg"

every_run() {
  expect permeability "> 0"
  expect force_defect "< 1e-9"  # the default stop: a backward error of 1e-10
  expect backward_error "<= 1e-10"
  expect flux_in "> 0"
  holds "$(value flux_in)" "- $(value flux_out) < 1e-8 * $(value flux_in)" || fail "$title: in and out differ"
  holds "$(value flux_out)" "- $(value flux_in) < 1e-8 * $(value flux_in)" || fail "$title: in and out differ"
  [ "$(wc -l <out/forces.csv)" = "$(($(value grains) + 1))" ] || fail "$title: forces.csv has another number of grains"
}
# same KEY VALUE: equal to 1e-6, far above the stop and far below what a wrong option would do.
same() { awk -v a="$(value "$1")" -v b="$2" 'BEGIN { d = a - b; exit !(d * d <= 1e-12 * b * b) }' || fail "$title: $1=$(value "$1"), expected $2"; }
times() { awk -v a="$1" -v b="$2" 'BEGIN { printf "%.12g", a * b }'; }

runs "defaults" beads.txt
[ "$(value grains)" = 343 ] || fail "grains=$(value grains)"
same max_pressure 1
same force_total_y 1  # the drop times the area of the box
k=$(value permeability)
q=$(value flux_in)

for solver in ldlt cg cholmod; do
  runs "solver $solver" beads.txt --solver $solver
  same permeability "$k"
done
runs "viscosity" beads.txt --viscosity 2e-3
same permeability "$k"
same flux_in "$(times 0.5 "$q")"
runs "pressure drop" beads.txt --pressure-drop 7
same permeability "$k"
same flux_in "$(times 7 "$q")"
runs "scale" beads.txt --scale 0.001
same permeability "$(times 1e-6 "$k")"
runs "the other way" beads.txt --inlet y_max --outlet y_min
same permeability "$k"
runs "slip, named" beads.txt --slip
same permeability "$k"
runs "no slip" beads.txt --no-slip
expect permeability "< 0.99 * $k"
runs "along x" beads.txt --inlet x_min --outlet x_max
same force_total_x 1
runs "mean radius" beads.txt --law mean_radius
runs "calibrated" beads.txt --law calibrated
expect permeability "< $k"
runs "periodic across" beads.txt --periodic xz
runs "periodic, gradient" beads.txt --periodic xyz --gradient x
same force_total_x 1
runs "periodic, no gradient named" beads.txt --periodic xyz
grep -q "a mean gradient drives the flow" stderr || fail "the gradient is not mentioned"
runs "no box" no_box.txt

helps --viscosity --inlet --outlet --pressure-drop --slip --no-slip --law --periodic --gradient --solver --scale --out

refuses "unknown option" "surprise" beads.txt --surprise
refuses "no number" "--viscosity: found \"water\", expected a number above 0" beads.txt --viscosity water
refuses "zero viscosity" "--viscosity: found \"0\"" beads.txt --viscosity 0
refuses "drop" "--pressure-drop: found \"-1\"" beads.txt --pressure-drop=-1
refuses "both slips" "excludes" beads.txt --slip --no-slip
refuses "law" "--law: found \"kozeny\", expected one of hydraulic_radius, mean_radius, calibrated" beads.txt --law kozeny
refuses "solver" "--solver: found \"gauss\", expected one of multigrid, ldlt, cg, cholmod" beads.txt --solver gauss
refuses "inlet = outlet" "--outlet: found \"y_min\", expected another face" beads.txt --outlet y_min
refuses "round a corner" "--outlet: found \"x_max\", expected y_max, opposite" beads.txt --outlet x_max
refuses "gradient between walls" "--gradient: found \"x\", expected an axis along which the box repeats" beads.txt --gradient x
refuses "no axis" "--gradient: found \"w\"" beads.txt --periodic x --gradient w
refuses "missing file" "absent.txt: found .*No such file" absent.txt
cannot_write beads.txt
report
