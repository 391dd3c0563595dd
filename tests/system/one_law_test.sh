#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# one_law_test.sh FOLDER: runs FOLDER/one_law and checks its numbers against those known for three touching circles.
source "$(dirname "$(realpath "${BASH_SOURCE[0]}")")/common.sh"
"$binary" >stdout || fail "exit code $?"
# C R = 11.3198 by Mayer-Stowe-Princen, 2 / (2 / sqrt(3) - 1) = 12.9282 by the inscribed circle; sigma / R = 144 Pa
row() { grep -m 1 "$1" stdout | sed -E 's/.* ([0-9.]+) Pa.*/\1/'; }
[ "$(row Mayer-Stowe-Princen)" = 1630.1 ] || fail "Mayer-Stowe-Princen: $(row Mayer)"
[ "$(row "inscribed circle")" = 1861.7 ] || fail "inscribed circle: $(row inscribed)"
grep -q "refused: the widest gap loses its arc" stdout || fail "no refusal"
grep -q "absent: closed" stdout || fail "no closed throat"
report
