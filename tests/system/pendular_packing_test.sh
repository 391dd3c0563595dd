#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# pendular_packing_test.sh FOLDER: runs the program FOLDER/pendular_packing on small packings with every option and bad
# input, and checks the keys on stdout, the files, the messages and the exit codes.
source "$(dirname "$(realpath "${BASH_SOURCE[0]}")")/common.sh"

keys="grains porosity reach pairs pairs_in_overlap tables pairs_without_table table_error steps bridges ruptured refused_flooded refused_not_covered refused_invalid_input \
refused_not_converged overlapping liquid_volume liquid_content saturation mean_force stress_xx stress_yy stress_zz \
stress_yz stress_xz stress_xy mean_stress rumpf_strength wettest_saturation wettest_overlapping \
pendular_limit_saturation pendular_limit_volume seconds_read seconds_pairs seconds_tables seconds_laws seconds_states seconds_write \
ns_per_pair ns_per_bridge peak_rss_mb"
files="bridges.csv bridges.vtp content.svg grains.vtp states.csv strength.svg"

every_run() {
  expect refused_not_converged "== 0"
  expect refused_invalid_input "== 0"
  local known
  known=$(awk -F= '/^(bridges|ruptured|refused_[a-z_]*)=/ { n += $2 } END { print n }' stdout)
  [ "$(value pairs)" = "$known" ] || fail "$title: $(value pairs) pairs, $known answers"
  [ "$(wc -l <out/bridges.csv)" = "$(($(value pairs) + 1))" ] || fail "$title: bridges.csv has another number of pairs"
  [ "$(wc -l <out/states.csv)" = "$(($(value steps) + 1))" ] || fail "$title: states.csv has another number of steps"
  grep -aq "NumberOfStrips=\"$(value bridges)\"" out/bridges.vtp || fail "$title: bridges.vtp has another number of tubes"
}
# same KEY VALUE: equal to 1e-8, what ten printed digits can tell.
same() { awk -v a="$(value "$1")" -v b="$2" 'BEGIN { d = a - b; exit !(d * d <= 1e-16 * b * b) }' || fail "$title: $1=$(value "$1"), expected $2"; }
times() { awk -v a="$1" -v b="$2" 'BEGIN { printf "%.12g", a * b }'; }

# 27 touching spheres of diameter 1 that repeat along all axes: three bridges for each, and F/d² is the stress.
awk 'BEGIN {
  print "# box 0 3 0 3 0 3"
  for (i = 0; i < 3; ++i) for (j = 0; j < 3; ++j) for (k = 0; k < 3; ++k) print i + 0.5, j + 0.5, k + 0.5, 0.5
}' >cubic.txt

runs "touching lattice" cubic.txt --periodic xyz --suction 1
[ "$(value bridges)" = 81 ] || fail "$title: $(value bridges) bridges"
same porosity "$(awk 'BEGIN { printf "%.15g", 1 - atan2(0, -1) / 6 }')"
force=$(value mean_force)
volume=$(awk -F, 'NR == 2 { print $9 }' out/bridges.csv)
same stress_xx "$force"
same stress_yy "$force"
same stress_zz "$force"
same rumpf_strength "$force"  # exact for equal spheres that touch
for shear in yz xz xy; do
  holds "$(value stress_$shear)" "< 1e-12 * $force" || fail "$title: stress_$shear=$(value stress_$shear)"
done
same liquid_volume "$(times 81 "$volume")"
stress=$(value stress_xx)

# the same pressed together by a thousandth of the radius: pulls and stress as at contact, whatever the suction
awk 'NR == 1 { print } NR > 1 { print $1, $2, $3, 0.5005 }' cubic.txt >pressed.txt
runs "pressed lattice" pressed.txt --periodic xyz --suction 1000
[ "$(value pairs_in_overlap)" = 81 ] || fail "$title: pairs_in_overlap=$(value pairs_in_overlap)"
expect saturation "> 0"
pressed=$(value mean_force)
runs "touching lattice, the same suction" cubic.txt --periodic xyz --suction 1000
[ "$(value pairs_in_overlap)" = 0 ] || fail "$title: pairs_in_overlap=$(value pairs_in_overlap)"
holds "$pressed" "> 0.998 * $(value mean_force)" && holds "$pressed" "< 1.003 * $(value mean_force)" ||
  fail "$title: mean_force=$(value mean_force), pressed together $pressed"

runs "the volume of these bridges" cubic.txt --periodic xyz --volume "$volume"
same mean_force "$force"
runs "units" cubic.txt --periodic xyz --suction 1000 --scale 0.001
same mean_force "$(times 0.001 "$force")"
same stress_xx "$(times 1000 "$stress")"
same saturation "$(times 3 "$volume" | awk '{ printf "%.12g", $1 / (1 - atan2(0, -1) / 6) }')"
runs "surface tension" cubic.txt --periodic xyz --volume "$volume" --surface-tension 0.144
same mean_force "$(times 2 "$force")"
runs "contact angle" cubic.txt --periodic xyz --volume "$volume" --contact-angle 40
holds "$(value mean_force)" "< 0.9 * $force" || fail "$title: mean_force=$(value mean_force)"
runs "toroid" cubic.txt --periodic xyz --suction 1 --law toroid
holds "$(value mean_force)" "> 0.95 * $force" && holds "$(value mean_force)" "< 1.05 * $force" ||
  fail "$title: mean_force=$(value mean_force), exact $force"

# Reduced volume 0.01: inside the range of every fit.
runs "exact, a volume" cubic.txt --periodic xyz --volume 1.25e-3
force=$(value mean_force)
for law in willett willett_small lambert rabinovich soulie weigert_ripperger mikami table; do
  runs "law $law" cubic.txt --periodic xyz --volume 1.25e-3 --law $law
  [ "$(value bridges)" = 81 ] || fail "$title: $(value bridges) bridges"
  holds "$(value mean_force)" "> 0.7 * $force" && holds "$(value mean_force)" "< 1.3 * $force" ||
    fail "$title: mean_force=$(value mean_force), exact $force"
done

runs "a rising suction" beads.txt --suction 2:200:8
expect wettest_overlapping "> 0"
grep -q "beyond the pendular limit" stderr || fail "$title: no warning that bridges touch"
expect overlapping "== 0"
expect ruptured "> 0"
expect pendular_limit_saturation "> $(value saturation)"
# pairs without a bridge take the exact law many times as long, and count in the one time alone
expect ns_per_bridge "> 0"
expect ns_per_pair "> $(value ns_per_bridge)"
awk -F, 'NR > 2 && !($1 > p && $10 < s && $2 <= n) { exit 1 } { p = $1; s = $10; n = $2 }' out/states.csv ||
  fail "$title: as the suction rises, saturation and bridges must fall"
runs "walls or not" beads.txt --periodic xyz --suction 2:200:8
! grep -q "_min\|_max" out/bridges.csv || fail "$title: bridges to walls that are not there"
runs "volumes" beads.txt --volume 1e-8:1e-6:5
expect overlapping "== 0"
runs "a fit on unequal spheres" beads.txt --volume 1e-6 --law weigert_ripperger
expect refused_not_covered "> 0"
force=$(value mean_force)
runs "tables for some pairs" beads.txt --volume 1e-6 --law table
expect tables "== 64"
expect pairs_without_table "> 0"
expect table_error "< 1e-6"
runs "no box" no_box.txt --suction 50
helps --surface-tension --contact-angle --suction --volume --law --periodic --scale --out

refuses "neither" "--suction and --volume: found neither" beads.txt
refuses "both" "--suction and --volume: found both" beads.txt --suction 1 --volume 1e-6
refuses "unknown option" "surprise" beads.txt --suction 1 --surprise
refuses "no number" "--suction: found \"wet\", expected a number above 0" beads.txt --suction wet
refuses "NaN" "--suction: found \"nan\"" beads.txt --suction nan
refuses "zero" "--suction: found \"0\"" beads.txt --suction 0
refuses "negative volume" "--volume: found \"-1\"" beads.txt --volume=-1
refuses "falling" "--suction: found \"9:3:4\"" beads.txt --suction 9:3:4
refuses "one step" "--suction: found \"3:9:1\"" beads.txt --suction 3:9:1
refuses "half a step" "--suction: found \"3:9:2.5\"" beads.txt --suction 3:9:2.5
refuses "two parts" "--suction: found \"3:9\"" beads.txt --suction 3:9
refuses "four parts" "--suction: found \"3:9:4:5\"" beads.txt --suction 3:9:4:5
refuses "tension" "--surface-tension: found \"-1\"" beads.txt --suction 1 --surface-tension=-1
refuses "angle" "--contact-angle: found \"90\", expected a number from 0 to below 90" beads.txt --suction 1 --contact-angle 90
refuses "law" "--law: found \"glue\", expected one of exact, table" beads.txt --suction 1 --law glue
refuses "a fit of volume alone" "--law: found \"willett\", expected with --suction a law" beads.txt --suction 1 --law willett
refuses "a fit of perfect wetting" "--law: found \"mikami\", expected with a contact angle" beads.txt --volume 1e-6 --contact-angle 20 --law mikami
refuses "too wide for a table" "--law: found \"table\", expected volumes" cubic.txt --volume 1e-12:1e-2:5 --law table
refuses "missing file" "absent.txt: found .*No such file" absent.txt --suction 1
cannot_write beads.txt --suction 50
report
