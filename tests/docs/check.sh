#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# check.sh COMPILER FLAGS…: every block ```cpp of README.md and docs/*.md must compile, each alone.
set -u
root=$(cd "$(dirname "$0")/../.." && pwd)
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT
awk -v to="$scratch" '
  FNR == 1 { page = FILENAME; sub(/.*\//, "", page); block = 0 }
  /^```cpp/ { ++block; out = to "/" page "." block ".cpp"; printf "#line %d \"%s\"\n", FNR + 1, FILENAME > out; next }
  /^```/ { out = "" }
  out != "" { print > out }
' "$root/README.md" "$root"/docs/*.md
failures=0
for block in "$scratch"/*.cpp; do
  [ -f "$block" ] || continue
  "$@" -fsyntax-only "$block" || failures=$((failures + 1))
done
[ "$failures" -eq 0 ]
