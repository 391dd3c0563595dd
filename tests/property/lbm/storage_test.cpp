// SPDX-License-Identifier: BSD-3-Clause
//
// The same numbers in all storages and widths of batches.
#include "support/lattice_states.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

using namespace lattice_states;

TEST_CASE_TEMPLATE("both storages and every width of batch give the same bits", T, double, other_scalar) {
  using model = plain;
  simulation<model, T, storage::in_place> one(repelling<model>(), with_ball({9, 10, 21}));
  simulation<model, T, storage::two_lattices> two(repelling<model>(), with_ball({9, 10, 21}));
  simulation<model, T, storage::in_place, 2> narrow(repelling<model>(), with_ball({9, 10, 21}));
  for (const std::size_t steps : {0U, 1U, 10U, 31U}) {
    stir(one, as_it_is);
    stir(two, as_it_is);
    stir(narrow, as_it_is);
    one.run(steps);
    two.run(steps);
    narrow.run(steps);
    std::size_t differing = 0;
    for (std::size_t n = 0; n < one.sites().size(); ++n) {
      for (std::size_t c = 0; c < 2; ++c) {
        for (std::size_t i = 0; i < 19; ++i) {
          differing += one.population(c, n, i) != two.population(c, n, i) ? 1U : 0U;
          differing += one.population(c, n, i) != narrow.population(c, n, i) ? 1U : 0U;
        }
      }
    }
    CHECK(differing == 0);
  }
}
