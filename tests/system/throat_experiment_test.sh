#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# throat_experiment_test.sh FOLDER: runs the program FOLDER/throat_experiment on a coarse throat, kills it, takes it up
# again, and gives it bad input and bad states; checks keys, files, messages and exit codes.
source "$(dirname "$(realpath "${BASH_SOURCE[0]}")")/common.sh"

keys="end last_hold entry_ratio_msp correction discretisation film entry_ratio_msp_raw entry_ratio_best2d best2d_ratio_msp bracket \
measured_lower entry_pressure_lattice surface_tension_lattice inscribed_nodes retraction_nodes fluid_nodes holds steps \
updates mlups seconds"
coarse="--gaps 0.4 0.4 0.4 --resolution 3 --bracket 0.05 --no-rings"

every_run() {
  [ "$(value end)" = "the bracket is as narrow as asked" ] || fail "$title: end=$(value end)"
  [ "$(value updates)" = "$(($(value steps) * $(value fluid_nodes)))" ] || fail "$title: updates are not steps x nodes"
  [ "$(ls out/meniscus_*.vti | wc -l)" = "$(grep -c DataSet out/meniscus.pvd)" ] || fail "$title: meniscus.pvd lists other files"
  grep -aq 'Name="density_difference"' out/meniscus_000001000.vti || fail "$title: no density difference"
}
files="meniscus.pvd meniscus_000001000.vti meniscus_000002000.vti meniscus_000003000.vti meniscus_000004000.vti"

# The files of a run depend on how long its holds took: `runs` is told what came out.
whole() {
  rm -rf out
  "$binary" "$@" --out out >/dev/null 2>&1 || true
  files=$(cd out && echo *)
}
whole $coarse
runs "three equal spheres" $coarse
expect inscribed_nodes "== 3"
expect best2d_ratio_msp "< 0.78"
expect entry_ratio_msp_raw "> 0.4"
expect entry_ratio_msp_raw "< 0.8"
expect discretisation "> 0.0888"
expect discretisation "< 0.0889"
bracket=$(value bracket)
steps=$(value steps)

wet="--gaps 0.4 0.4 0.4 --resolution 2 --bracket 0.05 --no-rings --sides mirror wetting mirror"
whole $wet
runs "gas that may not cross one gap" $wet
expect best2d_ratio_msp "> 0.83"  # 0.768 between mirrors
expect best2d_ratio_msp "< 0.84"
expect entry_ratio_best2d "> 0.72"  # 0.724 to 0.745 between mirrors
expect entry_ratio_best2d "< 0.8"
[ "$(value correction) $(value discretisation)" = "1 nan" ] || fail "$title: a correction nobody has calibrated"

every_line=$keys
keys="$keys rings_end rings_steps"
for side in 12 23 31; do
  keys="$keys ring_$side ring_${side}_volume ring_${side}_neck ring_${side}_neck_law ring_${side}_suction \
ring_${side}_suction_law"
done
whole --resolution 2 --bracket 0.1
runs "rings that the gas leaves at three contacts" --resolution 2 --bracket 0.1
grep -q "^film=unresolved" stdout || fail "$title: a film at two nodes"
[ "$(head -c 4 out/meniscus.png | tail -c 3)" = PNG ] || fail "$title: no picture"
[ "$(ls out/rings_*.vti | wc -l)" = "$(grep -c DataSet out/rings.pvd)" ] || fail "$title: rings.pvd lists other files"
expect ring_12_neck "> 0.2"
expect ring_12_neck "< 0.5"
keys=$every_line
whole $coarse

title="a finished state answers at once"
"$binary" $coarse --out out >stdout 2>stderr || fail "$title: exit code $?"
[ "$(value bracket) $(value steps)" = "$bracket $steps" ] || fail "$title: $(value bracket) after $(value steps) steps"

title="a finished state with a narrower bracket goes on"
"$binary" ${coarse/0.05/0.02} --out out >stdout 2>stderr || fail "$title: exit code $?"
[ "$(value steps)" -gt "$steps" ] || fail "$title: no step was made"
value bracket | awk -F'\\.\\.' '{ exit !($2 - $1 <= 0.0201 * ($1 + $2) / 2) }' || fail "$title: $(value bracket)"

title="a killed run ends with the same bracket"
rm -rf out
"$binary" $coarse --out out >stdout 2>stderr &
pid=$!
while [ ! -e out/state.bin ] && kill -0 "$pid" 2>/dev/null; do sleep 0.02; done
kill -9 "$pid" 2>/dev/null || fail "$title: it ended before it was killed"
wait "$pid" 2>/dev/null
"$binary" $coarse --out out >stdout 2>stderr || fail "$title: exit code $?"
grep -q "took up out/state.bin" stderr || fail "$title: it began anew"
[ "$(value bracket) $(value steps)" = "$bracket $steps" ] || fail "$title: $(value bracket) after $(value steps) steps"

title="the state of another throat"
exits 2 "found the state of another experiment" --gaps 0.4 0.4 0.4 --resolution 2.1 --out out
title="a damaged state"
printf 'x' | dd of=out/state.bin bs=1 seek=5000 conv=notrunc 2>/dev/null
exits 2 "found a checksum that does not match" $coarse --out out
title="no state"
echo "nothing" >out/state.bin
exits 2 "out/state.bin: found 8 bytes" $coarse --out out

helps --radii --gaps --sides --contact-angle --resolution --retraction --bracket --most-nodes --no-rings --precision --out
refuses "two radii" "--radii" --radii 1 1
refuses "radius" "--radii: found \"0\", expected a number above 0" --radii 1 0 1
refuses "gap" "--gaps: found \"-1\"" --gaps 0 0 -1
refuses "side" "--sides: found \"dry\", expected one of mirror, wetting" --sides mirror dry mirror
refuses "two sides" "--sides" --sides mirror wetting
refuses "no room" "no node for the reservoir" --gaps 0.4 0.4 0.4 --resolution 2 --sides wetting wetting wetting
refuses "angle" "--contact-angle: found \"90\"" --contact-angle 90
refuses "too coarse" "--resolution: found \"1\"" --resolution 1
refuses "too many nodes" "at most 1000 fluid nodes: a coarser resolution or a higher limit" --most-nodes 1000
refuses "precision" "--precision: found \"half\", expected one of float, double" --precision half
refuses "unknown option" "surprise" --surprise
report
