#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# one_law_test.sh FOLDER: runs FOLDER/one_law and checks its numbers against those known for three touching circles.
set -uo pipefail
binary=$(realpath "$1")/one_law
out=$("$binary") || { echo "FAILED: exit code $?"; exit 1; }
# C R = 11.3198 by Mayer-Stowe-Princen, 2 / (2 / sqrt(3) - 1) = 12.9282 by the inscribed circle; sigma / R = 144 Pa
row() { grep -m 1 "$1" <<<"$out" | sed -E 's/.* ([0-9.]+) Pa.*/\1/'; }
code=0
[ "$(row Mayer-Stowe-Princen)" = 1630.1 ] || { echo "FAILED: Mayer-Stowe-Princen: $(row Mayer)"; code=1; }
[ "$(row "inscribed circle")" = 1861.7 ] || { echo "FAILED: inscribed circle: $(row inscribed)"; code=1; }
grep -q "refused: the widest gap loses its arc" <<<"$out" || { echo "FAILED: no refusal"; code=1; }
grep -q "absent: closed" <<<"$out" || { echo "FAILED: no closed throat"; code=1; }
exit $code
