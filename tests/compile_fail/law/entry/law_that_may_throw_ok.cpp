// SPDX-License-Identifier: BSD-3-Clause
// A law is noexcept: a driver calls it in the middle of a loop.
#include "tetrapore/law/entry/concept.hpp"

struct mine {
  tetrapore::outcome<double, tetrapore::entry_status> entry_pressure(const tetrapore::opening<double>&) const noexcept {
    return {1.0, tetrapore::entry_status::ok};
  }
};
static_assert(tetrapore::entry_law<mine>);
