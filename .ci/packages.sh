#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# packages.sh GROUP…: installs the Debian packages of these groups that are missing, and names them. All messages go to
# stderr. Groups: build (what a release build of everything needs), checks (what .ci/run needs beside it), report (plots).
set -euo pipefail

packages=()
for group in "$@"; do
  case $group in
    build) packages+=(g++ cmake ninja-build doctest-dev libbenchmark-dev libcgal-dev libeigen3-dev libsuitesparse-dev
      libopenblas-dev libcli11-dev libpng-dev gnuplot-nox) ;;  # OpenBLAS: with the reference BLAS CHOLMOD is 5 × slower
    checks) packages+=(clang-16 clang-tidy-16 clang-format-16 libclang-rt-16-dev doxygen git gnuplot-nox jq) ;;
    report) packages+=(gnuplot-nox jq) ;;
    *) echo "packages.sh: no group '$group'" >&2; exit 2 ;;
  esac
done

if ! command -v apt-get >/dev/null; then
  echo "No apt-get here: assuming that these, or their like, are installed: ${packages[*]}" >&2
  exit 0
fi

missing=()
for package in "${packages[@]}"; do
  if [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)" != installed ]; then
    missing+=("$package")
  fi
done
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "Missing packages, and neither root nor sudo to install them: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

echo "Installing: ${missing[*]}" >&2
install() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install --yes --quiet --no-install-recommends "${missing[@]}" </dev/null >&2
}
if [ -z "$(find /var/lib/apt/lists -name '*_Packages*' -print -quit 2>/dev/null)" ] || ! install; then
  "${as_root[@]}" apt-get update --quiet </dev/null >&2
  install
fi
