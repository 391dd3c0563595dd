// SPDX-License-Identifier: BSD-3-Clause
// A law answers with a reason, never with a bare number.
#include "tetrapore/law/entry/concept.hpp"

struct mine {
  tetrapore::outcome<double, tetrapore::entry_status> at(double p) const noexcept {
    return {p, tetrapore::entry_status::ok};
  }
  auto entry_pressure(const tetrapore::opening<double>&) const noexcept { return at(1.0); }
};
static_assert(tetrapore::entry_law<mine>);
