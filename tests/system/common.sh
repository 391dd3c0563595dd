# SPDX-License-Identifier: BSD-3-Clause
# What the tests of programs share: a folder of their own, small packings in it, and how failures are told.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# 343 grains on a shaken lattice in the unit box: "box", then x y z r.
make_packing() {
  awk 'BEGIN {
    s = 1; n = 7
    if (ARGV[1] == "box") print "# box 0 1 0 1 0 1"
    for (i = 0; i < n; ++i) for (j = 0; j < n; ++j) for (k = 0; k < n; ++k) {
      for (m = 0; m < 4; ++m) { s = (s * 16807) % 2147483647; u[m] = s / 2147483647 - 0.5 }
      r = 0.46 / n * (1 + 0.2 * u[3])
      printf "%.9f %.9f %.9f %.9f\n", (i + 0.5 + 0.05 * u[0]) / n, (j + 0.5 + 0.05 * u[1]) / n, (k + 0.5 + 0.05 * u[2]) / n, r
    }
  }' "$1" </dev/null
}

value() { sed -n "s/^$1=//p" stdout; }
holds() { awk -v x="$1" "BEGIN { exit !(x $2) }"; }
expect() { holds "$(value "$1")" "$2" || fail "$title: $1=$(value "$1"), expected $2"; }

report() {
  if [ "$failures" -gt 0 ]; then
    echo "$failures failures"
    exit 1
  fi
  echo "ok"
}
