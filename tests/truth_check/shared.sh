#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# shared.sh TRUTH_CHECK TABLE: checks a table that does not ship with the project. Where it is absent the test is skipped
# (exit code 77); with TETRAPORE_REQUIRE_SHARED=1 that is a failure.
if [ ! -f "$2" ]; then
  echo "data is absent: $2"
  [ "${TETRAPORE_REQUIRE_SHARED-}" = 1 ] && exit 1
  exit 77
fi
exec "$1" "$2"
