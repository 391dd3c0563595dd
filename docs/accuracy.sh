#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# accuracy.sh: measures every law against the tables of truth that ship with the project and writes docs/accuracy.md.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
.ci/packages.sh build
{
  cmake --preset release
  cmake --build build/release --target truth_check -j "$(nproc)"
} >&2

page=$(mktemp)
{
  cat <<'EOF'
# Measured accuracy {#accuracy}

Written by `docs/accuracy.sh`; do not edit. Each law against tables of independent truth (`tests/truth/README.md` says where
they come from), over all rows that the law's columns appear in. *refused* counts answers with a reason instead of a value;
*wrong* counts answers with another status than the table, refusals inside the law's stated domain, and errors above its
stated accuracy, and is 0 for a law that keeps its word. Errors are relative; times are of one core.
EOF
  for table in tests/truth/*.csv; do
    known=0
    lines=$(build/release/tests/truth_check "$table" 2>/dev/null) || known=$?
    [ "$known" -ne 2 ] || continue  # a table of another kind
    printf '\n## %s\n\n' "$(basename "$table")"
    awk '
      /^law=/ {
        ++laws
        for (i = 1; i <= NF; ++i) {
          key = substr($i, 1, index($i, "=") - 1)
          if (!(key in seen)) { seen[key] = 1; keys[++columns] = key }
          value[laws, key] = substr($i, index($i, "=") + 1)
        }
      }
      END {
        for (c = 1; c <= columns; ++c) { head = head "| " keys[c] " "; rule = rule "|---" }
        gsub(/_/, " ", head)
        print head "|"; print rule "|"
        for (l = 1; l <= laws; ++l) {
          for (c = 1; c <= columns; ++c) { printf "| %s ", value[l, keys[c]] }
          print "|"
        }
      }' <<<"$lines"
  done
} >"$page"
cp "$page" docs/accuracy.md
rm "$page"
echo docs/accuracy.md >&2
