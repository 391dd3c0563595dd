#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# primary_drainage_test.sh FOLDER: runs the main job, the program FOLDER/primary_drainage, on small packings with every
# option and every bad input, and checks the keys on stdout, the files, the messages and the exit codes.
source "$(dirname "$(realpath "${BASH_SOURCE[0]}")")/common.sh"

keys="grains pores throats hidden porosity volume_defect entry_ok entry_gap_limited entry_merged entry_no_hole entry_dry \
entry_closed entry_refused pc_s90 pc_s70 pc_s50 pc_s30 residual_saturation residual_interior trapped_clusters \
van_genuchten_alpha van_genuchten_n fit_rms seconds_read seconds_tessellation seconds_laws seconds_invasion seconds_write \
peak_rss_mb"
files="events.csv grains.vtp phases phases.pvd phases_s40.png pores.vtu retention.csv retention.svg sizes.csv"

every_run() {
  expect volume_defect "< 1e-12"
  local throats
  throats=$(grep -c '^throat,.*,\(ok\|dry_corner\|gap_limited\|no_hole\|closed\|not_covered\|invalid_input\|not_converged\)$' out/sizes.csv)
  expect entry_ok "+ $(value entry_gap_limited) + $(value entry_no_hole) + $(value entry_dry) + $(value entry_closed) + $(value entry_refused) == $throats"
  [ "$(grep -c '^pore,' out/sizes.csv)" = "$(value pores)" ] || fail "$title: sizes.csv has another number of pores"
  # the curve never falls back, and ends where the events do
  awk -F, 'NR > 2 && ($1 < p || $3 > s) { exit 1 } { p = $1; s = $3 }' out/retention.csv || fail "$title: the curve is not monotonic"
  [ "$(tail -n 1 out/retention.csv | cut -d, -f5)" = "$(($(wc -l <out/events.csv) - 1))" ] || fail "$title: events and curve differ"
  [ "$(head -c 8 out/phases_s40.png | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ] || fail "$title: no PNG"
  for listed in $(sed -n 's/.*file="\([^"]*\)".*/\1/p' out/phases.pvd); do
    [ -s "out/$listed" ] || fail "$title: phases.pvd lists $listed, which is not there"
  done
}

# every option ---------------------------------------------------------------------------------------------------------

"$binary" --help >/dev/null  # the first start of a program waits for the disk, which its own seconds do not tell
runs "defaults" beads.txt
[ "$(value grains)" = 343 ] || fail "grains=$(value grains)"
[ "$(value hidden)" = 0 ] || fail "hidden=$(value hidden)"
expect residual_saturation "> 0"
expect pc_s50 "> 1"
sum=$(awk -F= '/^seconds_/ { s += $2 } END { print s }' stdout)
holds "$sum" "< $wall" && holds "$sum" "> 0.95 * $wall - 0.02" || fail "seconds add up to $sum of $wall"
base=$(value pc_s50)

runs "tension" beads.txt --surface-tension 0.036
[ "$(value pc_s50)" = "$base" ] || fail "p_c r/sigma depends on sigma: $(value pc_s50), $base"
# What has no unit is the same in metres and in millimetres, to the last printed digit: 0.001 is no power of two, so
# every coordinate is rounded anew.
without_unit() { grep -E '^(grains|pores|throats|hidden|porosity|entry_.*|pc_.*|residual_.*|trapped_clusters)=' "$1"; }
for gap in lost_arc merged; do
  runs "unit of length, $gap" beads.txt --gap-limited $gap
  without_unit stdout >in_metres
  runs "scale, $gap" beads.txt --gap-limited $gap --scale 0.001
  without_unit stdout >in_millimetres
  [ "$(wc -l <in_metres)" = 19 ] || fail "$title: $(wc -l <in_metres) keys without a unit, expected 19"
  changed=$(diff in_metres in_millimetres) || fail "$title: depends on the unit of length: $changed"
done
runs "angle" beads.txt --contact-angle 30
expect pc_s50 "< $base"
runs "inscribed" beads.txt --entry inscribed
expect entry_gap_limited "== 0"
expect pc_s50 "> $base"
runs "merged" beads.txt --gap-limited merged
expect pc_s50 ">= $base"
runs "refused" beads.txt --gap-limited refused
runs "no trapping" beads.txt --no-trapping
expect residual_saturation "== 0"
expect trapped_clusters "== 0"
runs "faces" beads.txt --inlet z_min --outlet z_max
runs "periodic" beads.txt --periodic xz
expect pores "> 0"
runs "no walls" beads.txt --no-walls
runs "no box" no_box.txt
grep -q "walls touch the outermost grains" stderr || fail "the tight box is not mentioned"
keys=${keys/trapped_clusters/trapped_clusters bond_number}
runs "density, small" beads.txt --density 1000 --scale 1e-5
expect bond_number "> 0"
! grep -q "gravity matters" stderr || fail "gravity does not matter for grains of a micrometre"
runs "density, large" beads.txt --density 1000
grep -q "gravity matters" stderr || fail "gravity matters for grains of centimetres"

helps --surface-tension --contact-angle --entry --gap-limited --inlet --outlet --periodic --no-walls --no-trapping --scale --density --out

# every bad command line -----------------------------------------------------------------------------------------------

refuses "unknown option" "surprise" beads.txt --surprise
refuses "missing value" "--surface-tension" beads.txt --surface-tension
refuses "no number" "--surface-tension: found \"water\", expected a number above 0" beads.txt --surface-tension water
refuses "zero tension" "--surface-tension: found \"0\"" beads.txt --surface-tension 0
refuses "angle of 90" "--contact-angle: found \"90\", expected a number from 0 to below 90" beads.txt --contact-angle 90
refuses "angle below 0" "--contact-angle: found \"-1\"" beads.txt --contact-angle=-1
refuses "NaN" "--contact-angle: found \"nan\"" beads.txt --contact-angle nan
refuses "law" "--entry: found \"mps\", expected one of msp, inscribed" beads.txt --entry mps
refuses "gap" "--gap-limited: found \"clamp\"" beads.txt --gap-limited clamp
refuses "face" "--inlet: found \"top\", expected one of x_min" beads.txt --inlet top
refuses "inlet = outlet" "--outlet: found \"y_max\", expected another face than the inlet" beads.txt --outlet y_max
refuses "axes" "--periodic: found \"xw\"" beads.txt --periodic xw
refuses "inlet on a periodic axis" "--inlet: found \"y_max\", expected a face across which" beads.txt --periodic y
refuses "periodic without a box" "periodic axes and no box" no_box.txt --periodic x
refuses "scale" "--scale: found \"0\"" beads.txt --scale 0
refuses "density" "--density: found \"-1\"" beads.txt --density=-1
refuses "out is a file" "--out: found \"beads.txt\"" beads.txt --out beads.txt

# every bad packing ----------------------------------------------------------------------------------------------------

bad() { # bad TITLE MESSAGE < file
  cat >bad.txt
  refuses "$1" "$2" bad.txt
}
refuses "missing file" "absent.txt: found .*No such file" absent.txt
refuses "a folder" "\.: found" .
bad "empty file" "bad.txt:1: found an empty file, expected at least one sphere" </dev/null
sed '9s/.*/0.1 0.2 abc 0.01/' beads.txt | bad "text for a number" "bad.txt:9: found .*abc"
sed '9s/.*/0.1 nan 0.3 0.01/' beads.txt | bad "NaN" "bad.txt:9: found"
sed '9s/.*/0.1 inf 0.3 0.01/' beads.txt | bad "infinity" "bad.txt:9: found"
sed '9s/[^ ]*$/0/' beads.txt | bad "radius 0" "bad.txt:9: found radius 0"
sed '9s/[^ ]*$/-0.1/' beads.txt | bad "negative radius" "bad.txt:9: found radius -0.1"
sed '9s/ [^ ]*$//' beads.txt | bad "a column missing" "bad.txt:9: found"
head -n 4 beads.txt | bad "three grains" "found 3, expected at least 4"
awk '{ if (NR > 1) $3 = 0.5; print }' beads.txt | bad "coplanar" "grains: found all centres in one plane .*expected centres that span a volume"
sed '9s/^[^ ]*/1.5/' beads.txt | bad "centre outside" "grain 7: found centre x = 1.5, expected a centre inside the box"
# Line 9 is grain 7; its copy comes after the 343 others.
place=$(awk 'NR == 9 { print $1 }' beads.txt)
{ cat beads.txt; sed -n 9p beads.txt; } |
  bad "duplicate" "grain 343: found centre \\(${place%?????}[0-9]*, .*\\), that of grain 7, expected grains at different places"
sed '1s/.*/# box 1 0 0 1 0 1/' beads.txt |
  bad "box inverted" "bad.txt:1: found a box from 1\\.?0* to 0\\.?0* along x, expected finite bounds, the lower one first"
{ head -n 5 beads.txt; head -c 100000000 /dev/zero | tr '\0' '1'; } | bad "a line of 100 MB" "bad.txt:6: found"
head -c 100 /dev/zero >cut.xyzd
refuses "truncated binary" "cut.xyzd" cut.xyzd

# a place that cannot be written ---------------------------------------------------------------------------------------

cannot_write beads.txt

report
