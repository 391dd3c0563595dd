#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the site into build/docs/html with Debian's doxygen; a warning is an error.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
mkdir -p build/docs
part() { sed -n "s/^#define TETRAPORE_VERSION_$1 *//p" include/tetrapore/core/version.hpp; }
{
  cat docs/Doxyfile
  echo "PROJECT_NUMBER = $(part MAJOR).$(part MINOR).$(part PATCH)"
  echo "OUTPUT_DIRECTORY = build/docs"
} | doxygen -
echo "build/docs/html/index.html"
