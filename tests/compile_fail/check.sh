#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# check.sh CASE.cpp COMPILER FLAGS…: CASE.cpp must be refused with the sentence that its line `// expect: REGEX` gives;
# CASE_ok.cpp, which differs from it in one place, must compile.
set -u
export LC_ALL=C
case_file=$1
shift
twin=${case_file%.cpp}_ok.cpp
fail() {
  printf '%s\n' "$*" >&2
  exit 1
}

expected=$(sed -n 's|^// expect: ||p' "$case_file")
[ -n "$expected" ] || fail "$case_file: no line '// expect: REGEX'"
[ -f "$twin" ] || fail "$case_file: no twin $twin"

tokens() { sed 's|//.*||' "$1" | grep -oE '[A-Za-z_0-9]+|[^A-Za-z_0-9[:space:]]'; }
places=$(diff <(tokens "$case_file") <(tokens "$twin") | grep -cE '^[0-9]')
[ "$places" -eq 1 ] || fail "$case_file and its twin differ in $places places instead of one"

"$@" -fsyntax-only "$twin" || fail "$twin does not compile"
if said=$("$@" -fsyntax-only "$case_file" 2>&1); then
  fail "$case_file compiles"
fi
grep -qE "$expected" <<<"$said" || fail "$case_file: the compiler does not say '$expected' but:
$said"
