#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# lattice_permeability_test.sh FOLDER: runs the program FOLDER/lattice_permeability on a lattice of spheres and checks
# the keys on stdout, the file, the messages and the exit codes.
source "$(dirname "$(realpath "${BASH_SOURCE[0]}")")/common.sh"

keys="grains nodes nodes_per_radius fluid_nodes porosity half_way_share permeability_coarse permeability \
permeability_over_r2 permeability_extrapolated discretisation_estimate steps mlups seconds"
files="lattices.csv"

every_run() {
  [ "$(wc -l <out/lattices.csv)" = 3 ] || fail "$title: lattices.csv has not two rows"
  expect mlups "> 0"
}

# simple cubic spheres of solid fraction 0.45: k = 1/(6πa 28.1) of the period squared (Zick and Homsy)
awk 'BEGIN {
  print "# box 0 2 0 2 0 2"
  for (i = 0; i < 2; ++i) for (j = 0; j < 2; ++j) for (k = 0; k < 2; ++k) print i + 0.2, j + 0.3, k + 0.4, 0.4754
}' >cubic.txt
runs "a lattice of spheres" cubic.txt --periodic xyz --nodes 24 --steady 1e-4
expect permeability "> 0.9 * 0.003971"
expect permeability "< 1.1 * 0.003971"
expect half_way_share "< 0.3"
expect porosity "> 0.53"
expect porosity "< 0.57"
runs "in float, along z" cubic.txt --periodic xyz --nodes 12 --axis z --steady 1e-3 --precision float --tau 0.8

title="a killed run goes on to the same numbers"
taken_up="cubic.txt --periodic xyz --nodes 24 --steady 1e-4 --out out --state kept"
same() { grep -Ev '^(mlups|seconds)=' "$1"; }
"$binary" ${taken_up% --state kept} >whole 2>stderr || fail "$title: exit code $?"
"$binary" $taken_up >stdout 2>stderr &
pid=$!
while [ ! -e kept/wait_2.bin ] && kill -0 "$pid" 2>/dev/null; do sleep 0.02; done
kill -9 "$pid" 2>/dev/null || fail "$title: it ended before it was killed"
wait "$pid" 2>/dev/null
"$binary" $taken_up >stdout 2>stderr || fail "$title: exit code $?"
grep -q "takes up kept/wait_2.bin" stderr || fail "$title: it began anew"
diff <(same whole) <(same stdout) || fail "$title: other numbers"
title="a finished state answers at once"
"$binary" $taken_up >stdout 2>stderr || fail "$title: exit code $?"
diff <(same whole) <(same stdout) || fail "$title: other numbers"
expect mlups "== 0"
title="the state of another run"
exits 2 "state of wait 1: found the state of another experiment" ${taken_up/1e-4/1e-3}
title="a damaged state"
printf 'x' | dd of=kept/wait_1.bin bs=1 seek=5000 conv=notrunc 2>/dev/null
exits 2 "found a checksum that does not match" $taken_up

helps --nodes --axis --tau --steady --precision --state
refuses "walls" "does not repeat" cubic.txt --nodes 12
refuses "an odd number of nodes" "multiple of 3" cubic.txt --periodic xyz --nodes 13
refuses "tau" "above 0.5" cubic.txt --periodic xyz --tau 0.5
refuses "an axis" "x, y or z" cubic.txt --periodic xyz --axis w
refuses "precision" "float or double" cubic.txt --periodic xyz --precision half

cannot_write cubic.txt --periodic xyz --nodes 6
report
