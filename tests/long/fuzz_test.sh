#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# fuzz_test.sh [SECONDS]: every fuzz target for a minute (or SECONDS) under the address and undefined-behaviour
# sanitizers. What a run finds stays in build/asan/tests/corpus, where the next one goes on. Leaves
# docs/campaigns/fuzz.json.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
seconds=${1:-60}
.ci/packages.sh build checks
cmake --preset asan >/dev/null
targets=()
for source in tests/fuzz/*_fuzz.cpp; do
  targets+=("$(basename "$source" .cpp)")
done
cmake --build build/asan -j "$(nproc)" --target "${targets[@]}"

rows=()
for target in "${targets[@]}"; do
  log=build/asan/tests/$target.log
  build/asan/tests/"$target" -max_total_time="$seconds" -rss_limit_mb=4096 -timeout=10 -print_final_stats=1 \
    build/asan/tests/corpus tests/fuzz/corpus 2>&1 | tee "$log"
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  rows+=("    {\"target\": \"$target\", \"seconds\": $seconds, \"runs\": $runs, \"failures\": 0}")
done
mkdir -p docs/campaigns
{
  printf '{\n  "command": "tests/long/fuzz_test.sh %s",\n  "compiler": "%s",\n' "$seconds" "$(clang++-16 --version | head -n 1)"
  printf '  "sanitizers": "address, undefined",\n  "results": [\n'
  (IFS=$'\n'; printf '%s\n' "${rows[*]}") | sed '$!s/$/,/'
  printf '  ]\n}\n'
} >docs/campaigns/fuzz.json
