#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# run.sh [NAME [ARGUMENTS…]]: installs what is missing (Debian), builds the example NAME and runs it. Without arguments:
# primary drainage of the packing that ships with the project. Only the example writes on stdout.
set -euo pipefail
start=$PWD
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
if [ $# -eq 0 ]; then
  set -- primary_drainage "$root/examples/data/beads_10000.txt"
fi
name=$1
shift

cd "$root"
names=$(printf '%s\n' examples/*.cpp | sed -E 's|examples/([0-9]+_)?(.*)\.cpp|\2|')
if ! grep -qxF -- "$name" <<<"$names"; then
  printf "run.sh: no example '%s'; there are:\n%s\n" "$name" "$names" >&2
  exit 2
fi
{
  .ci/packages.sh build
  cmake --preset release
  cmake --build build/release --target "example_$name" -j "$(nproc)"
} >&2
cd "$start"
exec "$root/build/release/examples/$name" "$@"
