// SPDX-License-Identifier: BSD-3-Clause
// A law is noexcept: a driver calls it in the middle of a loop.
// expect: entry_pressure\(o\). (is not .noexcept|may throw)
#include "tetrapore/law/entry/concept.hpp"

struct mine {
  tetrapore::outcome<double, tetrapore::entry_status> entry_pressure(const tetrapore::opening<double>&) const {
    return {1.0, tetrapore::entry_status::ok};
  }
};
static_assert(tetrapore::entry_law<mine>);
