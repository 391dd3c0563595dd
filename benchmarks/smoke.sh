#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# smoke.sh BINARY: runs each row once, but those named `large` or sized 100,000 and more, and of several contrasts the
# natural one alone, and refuses a row that does not report its error and its failed hard cases beside its time.
set -euo pipefail
json=$("$1" --benchmark_min_time=0.0001 '--benchmark_filter=-(large|[/:][0-9]{6,}|contrast:[1-4])' --benchmark_format=json)
count() { grep -c "\"$1\":" <<<"$json" || true; }
rows=$(grep -cE '"run_type": "iteration"' <<<"$json" || true)
if [ "$(count error_occurred)" -gt 0 ]; then
  grep -A 1 '"error_occurred": true' <<<"$json" >&2
  exit 1
fi
if [ "$rows" -eq 0 ] || [ "$(count error)" -lt "$rows" ] || [ "$(count failed)" -lt "$rows" ]; then
  echo "$rows rows, of which $(count error) report an error and $(count failed) their failed hard cases" >&2
  exit 1
fi
echo "$rows rows"
