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
they come from), over the rows that ask something inside the law's domain. *refused* counts answers with a reason instead
of a value; *wrong* counts answers with another status than the table, refusals inside the law's stated domain, and errors
above its stated accuracy, and is 0 for a law that keeps its word. Errors are relative; times are of one core, over the rows
that are not wrong.

What a law states is the error for each unit of *condition*, 32 + κ: κ is how far the pressure moves, relatively, for moves
of the coordinates and radii of the opening relative to its extent, 32 stands for the law's own roundings. A needle of radii
1 : 1 : 1e-5 has κ = 4e5: rounding its distances to double costs more than the law does. So *max rel err* is the error as it
stands, and *max rel err per condition* the one to hold against *stated accuracy*.

Bridges and resistances of a pair have no such condition: the exact bridge is held, for each of its results, to its stated
accuracy times the larger of 1 and 16 κ / 1e-12, κ being what rounding the gap and the given volume or suction does to that result,
*per condition* scaled accordingly. Its derivatives may be off by 1e-10 and 1.8e-15 over the distance to the fold: that is what *max rel
err derivative* shows on the rows next to folds. Many rows stand there or hold much liquid, so the mean time is that of a march, not of
the bridge of a common pair. Held otherwise: an approximation to the relative error of the force that it states, on the rows of the table and on a map over its
domain (equal spheres, 1 : 2, 1 : 10 and a plane; θ to 50°; V/R³ from 1e-6 to 0.1; gaps to 0.9 of the rupture gap), whose truth is the
exact law: *rows of map*, and what the table alone shows is *max rel err of table*. A table of bridges is held to its error in the
largest force that it holds; a resistance to the error of each mode, the leading order's in the unit in which it fades as the gap
closes (*err per unit*). *outside* are rows that a law says it does not cover,
*rows above condition of force* those where a result other than the force is off by more than rounding does to the force.

Where a table prints fewer digits than a double holds, they limit what can be seen: *table digits* is half a unit of the last
printed digit, relatively, the worst of the rows. *max rel err* is then mostly the table's rounding, and *per condition* counts
only what goes beyond it.
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
