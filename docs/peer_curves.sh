#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# peer_curves.sh [SHARED]: drains the packings that Yade drained too, with each model of a wide gap, and writes
# docs/peer_curves.md and docs/pictures/peer_*.svg. SHARED holds packings and Yade's curves (default ../shared).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
shared=${1:-../shared}/data
[ -d "$shared" ] || { echo "peer_curves.sh: no folder $shared" >&2; exit 2; }
.ci/packages.sh build report
{
  cmake --preset release
  cmake --build build/release --target example_primary_drainage -j "$(nproc)"
} >&2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p docs/pictures

value() { sed -n "s/^$2=//p" "$1"; }
# peer FILE RADIUS COLUMN: p_c <r>/σ at S = .9 .7 .5 .3, and the last saturation, as a row
peer() {
  awk -F, -v r="$2" -v c="$3" '
    NR > 1 && $c != "" {
      s = $c; p = $2 * r; last = s
      for (i = 1; i <= 4; ++i) { t = 1.1 - 0.2 * i; if (!(i in at) && s <= t) at[i] = p }
    }
    END { for (i = 1; i <= 4; ++i) printf "| %s ", (i in at) ? sprintf("%.3f", at[i]) : "–"; printf "| %.4f | %.4f ", last, last }' "$1"
}
# last FILE COLUMN: the last number of a column
last() { awk -F, -v c="$2" 'NR > 1 && $c != "" { s = $c } END { printf "%.4f", s }' "$1"; }

# moved LOG: "asked / moved" from what the program says of merging
moved() {
  local told
  told=$(sed -n 's/^merged: \([0-9]*\) asked, \([0-9]*\) moved$/\1 \/ \2/p' "$1")
  echo "${told:-–}"
}

page=$scratch/page.md
cat >"$page" <<'EOF'
# Curves beside Yade's {#peer_curves}

Written by `docs/peer_curves.sh`; do not edit. The same packings, gas from y_max, outlet at y_min, θ = 0, trapping on; p_c times
mean radius over surface tension at four saturations of all pores that are not reservoir; the share of them that is trapped;
where the curve ends, with trapping and without.
Yade's radius of a wide gap is clamped to half the gap; `lost_arc` names the same pressure, `merged` lets the two facets at
the gap share a meniscus, `refused` keeps such throats shut. Facet by facet the entry radii of the two codes are equal away
from walls. At a wall Yade takes σ over the inscribed radius, without the factor 2 of a meniscus: about half the pressure at
which gas enters there, so its curve lies lower. It also tests trapping after each sweep of the pressure, ours at every event,
which is why more is trapped here. [Why is my curve different from Yade's](yade.md) takes the difference apart.
*Asked, moved*: how many facets whose widest gap gives way first came within reach of the gas, and for how many of these the
threshold was told again with another value, because it depends on the state.
EOF
for packing in open_1000 open_10000; do
  radius=$(awk '!/^#/ { s += $4; ++n } END { printf "%.17g", s / n }' "$shared/packings/$packing.txt")
  {
    printf '\n## %s\n\n| model | S = 0.9 | 0.7 | 0.5 | 0.3 | trapped | S at the end | without trapping | asked / moved |\n|---|---|---|---|---|---|---|---|---|\n' "$packing"
    printf '| Yade '
    peer "$shared/peer_yade/${packing}_drainage_pore.csv" "$radius" 4
    if [ -e "$shared/peer_yade/${packing}_drainage_pore_notrap.csv" ]; then
      printf '| %s | – |\n' "$(last "$shared/peer_yade/${packing}_drainage_pore_notrap.csv" 4)"
    else
      printf '| – | – |\n'
    fi
  } >>"$page"
  for model in lost_arc merged refused; do
    build/release/examples/primary_drainage "$shared/packings/$packing.txt" --surface-tension 1 --gap-limited $model \
      --out "$scratch/$packing-$model" >"$scratch/$packing-$model.txt" 2>"$scratch/$packing-$model.log"
    build/release/examples/primary_drainage "$shared/packings/$packing.txt" --surface-tension 1 --gap-limited $model \
      --no-trapping --out "$scratch/$packing-$model-free" >/dev/null 2>&1
    keys=$scratch/$packing-$model.txt
    {
      printf '| %s ' "$model"
      for s in 90 70 50 30; do
        v=$(value "$keys" pc_s$s)
        case $v in [0-9]*) printf '| %.3f ' "$v" ;; *) printf '| – ' ;; esac
      done
      printf '| %.4f | %s | %s | %s |\n' "$(value "$keys" residual_saturation)" \
        "$(last "$scratch/$packing-$model/retention.csv" 3)" "$(last "$scratch/$packing-$model-free/retention.csv" 3)" "$(moved "$scratch/$packing-$model.log")"
    } >>"$page"
  done
  lost=$scratch/$packing-lost_arc.txt
  merged=$scratch/$packing-merged.txt
  {
    printf '\nReplacing the clamp by the right status and the merged throat moves p_c at S = 0.5 by '
    awk -v a="$(value "$lost" pc_s50)" -v b="$(value "$merged" pc_s50)" 'BEGIN { printf "%+.1f %%", 100 * (b / a - 1) }'
    printf ' and the residual by '
    awk -v a="$(value "$lost" residual_saturation)" -v b="$(value "$merged" residual_saturation)" 'BEGIN { printf "%+.4f", b - a }'
    printf '. Facets whose widest gap gives way first: %s of %s; merged on the way: %s.\n' \
      "$(value "$merged" entry_gap_limited)" "$(value "$merged" throats)" "$(value "$merged" entry_merged)"
    printf '\n![%s](pictures/peer_%s.svg)\n' "$packing" "$packing"
  } >>"$page"
  gnuplot <<EOF
set terminal svg size 760,500 font "sans,13" background "white"
set output "docs/pictures/peer_$packing.svg"
set datafile separator ","
set title "Primary drainage of $packing, beside Yade" noenhanced
set xlabel "saturation of the wetting phase S [–]"
set ylabel "capillary pressure p_c × mean radius / σ [–]" noenhanced
set xrange [0:1]
set yrange [0:8]
set grid
set key top right noenhanced
plot "$shared/peer_yade/${packing}_drainage_pore.csv" every ::1 using 4:(\$2*$radius) with lines lw 2 lc rgb "#222222" title "Yade", \
  "$scratch/$packing-lost_arc/retention.csv" every ::1 using 3:2 with lines lw 2 lc rgb "#2a6fc9" title "tetrapore, lost_arc", \
  "$scratch/$packing-merged/retention.csv" every ::1 using 3:2 with lines lw 2 lc rgb "#e8912d" title "tetrapore, merged", \
  "$scratch/$packing-refused/retention.csv" every ::1 using 3:2 with lines lw 2 dt 2 lc rgb "#3a9d6b" title "tetrapore, refused"
EOF
done
cp "$page" docs/peer_curves.md
echo docs/peer_curves.md >&2
