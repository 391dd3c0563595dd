// SPDX-License-Identifier: BSD-3-Clause
// A law answers with a reason, never with a bare number.
// expect: entry_pressure\(o\). does not satisfy return-type-requirement|same_as<double, outcome<double, entry_status> >
#include "tetrapore/law/entry/concept.hpp"

struct mine {
  tetrapore::outcome<double, tetrapore::entry_status> at(double p) const noexcept {
    return {p, tetrapore::entry_status::ok};
  }
  auto entry_pressure(const tetrapore::opening<double>&) const noexcept { return at(1.0).value; }
};
static_assert(tetrapore::entry_law<mine>);
