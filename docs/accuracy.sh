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
stated accuracy, and is 0 for a law that keeps its word. Errors are relative.
EOF
  for table in tests/truth/*.csv; do
    lines=$(build/release/tests/truth_check "$table") || { [ $? -eq 2 ] && continue || exit 1; }
    printf '\n## %s\n\n' "$(basename "$table")"
    awk '
      /^law=/ {
        n = split($0, fields, " ")
        if (!head++) {
          row = "|"; rule = "|"
          for (i = 1; i <= n; ++i) { key = fields[i]; sub(/=.*/, "", key); gsub(/_/, " ", key); row = row " " key " |"; rule = rule "---|" }
          print row; print rule
        }
        row = "|"
        for (i = 1; i <= n; ++i) { value = fields[i]; sub(/^[^=]*=/, "", value); row = row " " value " |" }
        print row
      }' <<<"$lines"
  done
} >"$page"
cp "$page" docs/accuracy.md
rm "$page"
echo docs/accuracy.md >&2
