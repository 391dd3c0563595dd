#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing (Debian), builds everything into build/release and runs the tests.
#   tests/run.sh                  every test that CI runs
#   tests/run.sh --long [REGEX]   the campaigns that do not fit CI, all or those whose name matches; each continues where
#                                 it was interrupted and leaves its results in docs/campaigns/*.json
# TETRAPORE_REQUIRE_SHARED=1 makes a failure of every test that is skipped because its data is absent.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

long=no
case ${1-} in
  "") ;;
  --long) long=yes ;;
  *) sed -n 's/^# \{0,1\}//; 3,7p' "${BASH_SOURCE[0]}" >&2; exit 2 ;;
esac

.ci/packages.sh build
jobs=$(nproc)
cmake --preset release
cmake --build --preset release -j "$jobs"

if [ "$long" = yes ]; then
  cmake --build --preset release -j "$jobs" --target campaigns
  exec ctest --preset long ${2:+-R "$2"}
fi

log=build/release/Testing/tests.log
mkdir -p "$(dirname "$log")"
result=0
ctest --preset release -j "$jobs" 2>&1 | tee "$log" || result=$?

skipped=$(sed -n 's/.*skipped, data is absent: //p' build/release/Testing/Temporary/LastTest.log | sort -u)
if [ -n "$skipped" ]; then
  printf '\nSkipped, because the data is absent:\n%s\n' "$skipped"
  printf '\n%s\n' "$(grep 'tests passed' "$log" | tail -n 1)"
fi
exit "$result"
