// SPDX-License-Identifier: BSD-3-Clause
#include "support/lattice_throats.hpp"
#include "support/sanitized.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace lattice_throats;

TEST_CASE("brackets that start 30 % too low and 30 % too high end overlapping") {
  const entry_set_up s = equal_spheres(0.4, 2);
  const entry_result low = found(s, 0.7, 0.1);
  CHECK(low.end == search_end::converged);
  CHECK(low.upper - low.lower <= 0.1 * (low.upper + low.lower) / 2 * (1 + 1e-9));
  CHECK(low.discretisation == doctest::Approx(0.2));  // 0.05 (4 / 2)²: what was seen at 2 nodes is 0.14
  CHECK(low.updates > 0);
  if (!sanitized) {
    const entry_result high = found(s, 1.3, 0.1);
    CHECK(high.end == search_end::converged);
    CHECK(low.lower < high.upper);
    CHECK(high.lower < low.upper);
  }
}

TEST_CASE("a throat that the lattice does not resolve is refused") {
  CHECK_THROWS_WITH_AS(entry_experiment<float>(equal_spheres(0.4, 1.5)),
                       "throat: found an inscribed circle of 1.5 nodes, expected a radius of 2 or more: films and "
                       "interfaces are as wide",
                       parameter_error);
}

TEST_CASE("reservoirs of densities that do not belong together are named") {
  entry_set_up s = equal_spheres(0.4, 4);
  s.pair.common = 4;  // no densities go with it
  entry_experiment<float> none(s);
  CHECK(none.hold(none.lattice_pressure(none.plane().best)).end == hold_end::dissolved);
  CHECK(std::isnan(entry_error(4, 0.2)));
  entry_set_up wrong = equal_spheres(0.4, 4);
  wrong.pair.factor = 1.9;  // 1.995 was measured
  CHECK_THROWS_AS(entry_experiment<float>{wrong}, parameter_error);
}
