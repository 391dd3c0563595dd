#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# report.sh [JSON…]: speed against error. Runs every benchmark of build/release (or takes the JSON files of an earlier
# run), and writes docs/benchmarks.md and, for each program, docs/benchmarks/NAME.svg: worst error on x, time on y, both
# logarithmic, with the front of the rows that nothing beats in both. Needs jq and gnuplot, and installs them on Debian.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
.ci/packages.sh build report

json=("$@")
if [ ${#json[@]} -eq 0 ]; then
  cmake --preset release >&2
  cmake --build build/release -j "$(nproc)" >&2
  mkdir -p build/release/benchmarks/json
  for program in build/release/benchmarks/*_benchmark; do
    out=build/release/benchmarks/json/$(basename "$program").json
    "$program" --benchmark_out="$out" --benchmark_out_format=json >&2
    json+=("$out")
  done
fi

page=docs/benchmarks.md
pictures=docs/benchmarks
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT
mkdir -p "$pictures"

cpu=$(sed -n 's/^model name[ \t]*: //p' /proc/cpuinfo | head -n 1)
compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' build/release/CMakeCache.txt 2>/dev/null || true)
{
  echo "# Speed against error {#benchmarks}"
  echo
  echo "Written by \`benchmarks/report.sh\`; do not edit. Times are real time of one core; they move by some 30 % from run"
  echo "to run, so compare rows of one table. \`error\` is the worst error of the row against its reference (relative,"
  echo "unless the row's name says otherwise), \`failed\` the number of hard cases that it got wrong."
  echo
  echo "Processor: ${cpu:-unknown}. Compiler: $("${compiler:-g++}" --version | head -n 1), \`-O3 -DNDEBUG\`. Version:" \
    "$(git describe --always --dirty 2>/dev/null || echo unknown)."
} >"$scratch/page"

for file in "${json[@]}"; do
  name=$(basename "$file" _benchmark.json)
  # row: series, name, seconds per iteration, error, failed, other counters
  jq -r '
    def seconds: .real_time * {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1}[.time_unit];
    ["name","family_index","per_family_instance_index","run_name","run_type","repetitions","repetition_index",
     "threads","iterations","real_time","cpu_time","time_unit","label","error","failed","aggregate_name",
     "aggregate_unit","per_pore","per_grain"] as $known
    | .benchmarks[] | select(.run_type == "iteration")
    | if .error_occurred then error("\(.name): \(.error_message)") else . end
    | if has("error") and has("failed") then . else error("\(.name) reports no error or no failed cases") end
    | [(.name | split("/")[0]), .name + (if .label then " (" + .label + ")" else "" end), seconds, .error, .failed,
       ([to_entries[] | select(.key as $k | $known | index($k) | not)
         | "\(.key) \(.value | if type == "number" then (. * 1000 | round / 1000) else . end)"]
        + (if .pores then ["\(1e9 * seconds / .pores | round) ns per pore"] else [] end) | join(", ")),
       (.pores // "")]
    | @tsv' "$file" >"$scratch/rows"

  {
    printf '\n## %s\n\n' "${name//_/ }"
    echo '| row | time | error | failed | also |'
    echo '|---|---|---|---|---|'
    awk -F '\t' '
      function human(s) {
        if (s < 1e-6) return sprintf("%.3g ns", s * 1e9)
        if (s < 1e-3) return sprintf("%.3g µs", s * 1e6)
        if (s < 1) return sprintf("%.3g ms", s * 1e3)
        return sprintf("%.3g s", s)
      }
      { printf "| %s | %s | %s | %d | %s |\n", $2, human($3), ($4 == 0 ? "0" : sprintf("%.1e", $4)), $5, $6 }
    ' "$scratch/rows"
    printf '\n![Time against worst error of the rows above](benchmarks/%s.svg)\n' "$name"
  } >>"$scratch/page"

  # Where rows say how many pores they work on: what one costs, against their number.
  awk -F '\t' '$7 != "" { print $1 "\t" $7 "\t" $3 / $7 * 1e6 }' "$scratch/rows" >"$scratch/sizes"
  if [ -s "$scratch/sizes" ]; then
    printf '\n![Cost of a pore against the number of pores](benchmarks/%s_size.svg)\n' "$name" >>"$scratch/page"
    {
      echo "set terminal svg size 800,560 font 'sans,13' background 'white' rounded"
      echo "set output '$pictures/${name}_size.svg'"
      echo "set title '${name//_/ }: cost of a pore against their number' noenhanced"
      echo "set logscale xy; set format x '10^{%T}'; set grid lw 0.5 lc rgb '#dddddd'"
      echo "set xlabel 'pores'; set ylabel 'time per pore [µs]'"
      echo "set key outside bottom center horizontal noenhanced; set offsets graph 0.08, graph 0.08, graph 0.08, graph 0.08"
      printf 'plot '
      while IFS= read -r one; do
        awk -F '\t' -v s="$one" '$1 == s { print $2 "\t" $3 }' "$scratch/sizes" | sort -g >"$scratch/size_${#one}_$one"
        printf "'%s' with linespoints pt 7 ps 0.7 title '%s', " "$scratch/size_${#one}_$one" "${one//\'/}"
      done < <(cut -f1 "$scratch/sizes" | sort -u) | sed 's/, $//'
      echo
    } >"$scratch/size.gp"
    gnuplot "$scratch/size.gp"
  fi

  # An error of 0 has no logarithm: such rows stand at 1e-17, left of what a double can tell.
  # What is built once for many calls is no call.
  awk -F '\t' '$1 !~ /^build_/ { e = $4 < 1e-17 ? 1e-17 : $4; printf "%s\t%s\t%.6g\t%.6g\n", $1, $2, e, $3 }' "$scratch/rows" |
    sort -t "$(printf '\t')" -k4,4g >"$scratch/points"
  awk -F '\t' 'NR == 1 || $3 < best { best = $3; print $3 "\t" $4 }' "$scratch/points" >"$scratch/front"
  series=()
  while IFS= read -r one; do
    awk -F '\t' -v s="$one" '$1 == s { print $3 "\t" $4 }' "$scratch/points" >"$scratch/series_${#series[@]}"
    series+=("$one")
  done < <(cut -f1 "$scratch/points" | sort -u)
  {
    echo "set terminal svg size 800,560 font 'sans,13' background 'white' rounded"
    echo "set output '$pictures/$name.svg'"
    echo "set title '${name//_/ }: speed against error' noenhanced"
    echo "set logscale xy; set format '10^{%T}'; set grid lw 0.5 lc rgb '#dddddd'"
    echo "set xlabel 'worst error (rows without any stand at 10^{-17})'; set ylabel 'time of one call [s]'"
    echo "set key outside bottom center horizontal noenhanced; set offsets graph 0.08, graph 0.08, graph 0.08, graph 0.08"
    printf "plot '%s' with steps lw 1.5 dt 2 lc rgb '#888888' title 'nothing is both faster and more exact'" "$scratch/front"
    for k in "${!series[@]}"; do
      printf ", '%s' with points pt 7 ps 0.9 lc %d title '%s'" "$scratch/series_$k" $((k + 1)) "${series[$k]//\'/}"
    done
    echo
  } >"$scratch/plot.gp"
  gnuplot "$scratch/plot.gp"
done
cp "$scratch/page" "$page"
echo "$page and $(find "$pictures" -name '*.svg' | wc -l) plots in $pictures" >&2
