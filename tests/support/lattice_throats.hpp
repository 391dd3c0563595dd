// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/entry_experiment.hpp"
#include "tetrapore/simplex/make_opening.hpp"

/// \file
/// Throats for the lattice.

namespace lattice_throats {

using namespace tetrapore;
using namespace tetrapore::lbm;

/// Three equal spheres at equal gaps, in units of their radius.
inline entry_set_up equal_spheres(double gap, double inscribed) {
  entry_set_up s;
  s.throat = opening_from_distances<double>(1, 1, 1, 2 + gap, 2 + gap, 2 + gap).value;
  s.nodes_per_length = inscribed / plane_entry_of(s.throat, s.sides).inscribed;
  return s;
}

/// A search from a first bracket that begins and ends at these shares of where the entry pressure is expected: its
/// middle is not what is expected.
inline entry_result found(const entry_set_up& s, double from, double to, double width, double widen) {
  entry_experiment<float> e(s);
  search_options o = e.bracket(1, width);
  const double expected = (o.lower + o.upper) / 2;
  o.lower = from * expected;
  o.upper = to * expected;
  o.widen = widen;
  threshold_search search(o);
  run(e, search);
  return e.result(search);
}

}  // namespace lattice_throats
