// SPDX-License-Identifier: BSD-3-Clause
// A law that knows its gaps tells the pressure at which the gap of an edge loses its arc.
#include "tetrapore/law/entry/concept.hpp"

struct mine {
  tetrapore::outcome<double, tetrapore::entry_status> entry_pressure(const tetrapore::opening<double>&) const noexcept {
    return {1.0, tetrapore::entry_status::ok};
  }
  tetrapore::outcome<tetrapore::arc_limit<double>, tetrapore::entry_status> first_arc_lost(
      const tetrapore::opening<double>&) const noexcept {
    return {{1.0, 0}, tetrapore::entry_status::ok};
  }
  tetrapore::outcome<double, tetrapore::entry_status> arc_lost(const tetrapore::edge<double>&) const noexcept {
    return {1.0, tetrapore::entry_status::ok};
  }
};
static_assert(tetrapore::gap_aware_entry_law<mine>);
