# SPDX-License-Identifier: BSD-3-Clause
# What the tests of programs share. NAME_test.sh FOLDER tests the program FOLDER/NAME in a folder of its own, with small
# packings in it: beads.txt, and no_box.txt, which names no box.
set -uo pipefail
shopt -s lastpipe  # a check at the end of a pipe counts its failures here
program=$(basename "$0" _test.sh)
binary=$(realpath "$1")/$program
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
make_packing box >beads.txt
make_packing none >no_box.txt

value() { sed -n "s/^$1=//p" stdout; }
holds() { awk -v x="$1" "BEGIN { exit !(x $2) }"; }
expect() { holds "$(value "$1")" "$2" || fail "$title: $1=$(value "$1"), expected $2"; }

# runs TITLE ARGUMENTS…: must succeed, with the $keys in their order and all $files; then `every_run ARGUMENTS…` checks
# what always holds.
runs() {
  title=$1
  shift
  rm -rf out
  local begin
  begin=$(date +%s.%N)
  "$binary" "$@" --out out >stdout 2>stderr || fail "$title: exit code $? ($(tail -n 1 stderr))"
  wall=$(awk -v a="$begin" -v b="$(date +%s.%N)" 'BEGIN { print b - a }')
  local found
  found=$(sed -n 's/^\([a-z0-9_]*\)=.*/\1/p' stdout | tr '\n' ' ')
  [ "$(echo $found)" = "$(echo $keys)" ] || fail "$title: keys are: $found"
  [ "$(cd out && echo *)" = "$files" ] || fail "$title: files are: $(cd out && echo *)"
  [ -z "$(find out -name '*.part')" ] || fail "$title: a part was left"
  if command -v xmllint >/dev/null; then
    find out \( -name '*.svg' -o -name '*.pvd' \) -exec xmllint --noout {} + || fail "$title: XML"
  fi
  every_run "$@"
}

# helps OPTIONS…: --help must name them.
helps() {
  title="help"
  local option
  "$binary" --help >stdout 2>stderr || fail "$title: exit code $?"
  for option in "$@"; do
    grep -q -- "$option" stdout || fail "$title: does not name $option"
  done
}

# exits CODE MESSAGE ARGUMENTS…: must say MESSAGE (a regular expression), and nothing on stdout.
exits() {
  local expected=$1 message=$2 code=0
  shift 2
  "$binary" "$@" >stdout 2>stderr || code=$?
  [ "$code" = "$expected" ] || fail "$title: exit code $code, expected $expected"
  grep -Eq -- "$message" stderr || fail "$title: said '$(cat stderr)', expected '$message'"
  [ ! -s stdout ] || fail "$title: wrote on stdout"
}

# refuses TITLE MESSAGE ARGUMENTS…: must exit with 2, say MESSAGE, and write nothing. The folder is that of the default.
refuses() {
  title=$1
  shift
  exits 2 "$@"
  [ ! -e "${program}_out" ] || fail "$title: wrote files"
  rm -rf "${program}_out"
}

# cannot_write ARGUMENTS…: must exit with 1 where there can be no folder, and name it.
cannot_write() {
  title="a folder that cannot be"
  touch taken
  exits 1 taken "$@" --out taken/below
}

report() {
  if [ "$failures" -gt 0 ]; then
    echo "$failures failures"
    exit 1
  fi
  echo "ok"
}
