// SPDX-License-Identifier: BSD-3-Clause
#include "../../../examples/support/oedometer.hpp"
#include "support/compiled_triangulation.hpp"

#include <doctest/doctest.h>

#include <cmath>

TEST_CASE("Terzaghi's series: known values, and the pressure that is left is the settlement that is missing") {
  using namespace support;
  CHECK(terzaghi::settlement(0) == 0);
  CHECK(terzaghi::settlement(0.197) == doctest::Approx(0.5).epsilon(2e-3));  // the T50 and T90 of every textbook
  CHECK(terzaghi::settlement(0.848) == doctest::Approx(0.9).epsilon(1e-3));
  for (const double time : {1e-4, 1e-3, 1e-2}) {  // before the base knows of the drain: U = 2 √(T/π), p = erf(z/√4T)
    CHECK(terzaghi::settlement(time) == doctest::Approx(2 * std::sqrt(time / 3.14159265358979324)).epsilon(1e-9));
    CHECK(terzaghi::pressure(time, 0.1) == doctest::Approx(std::erf(0.1 / std::sqrt(4 * time))).epsilon(1e-9));
  }
  double left = 0;
  for (int k = 0; k < 1000; ++k) {
    left += terzaghi::pressure(0.3, (k + 0.5) / 1000) / 1000;
  }
  CHECK(1 - left == doctest::Approx(terzaghi::settlement(0.3)).epsilon(1e-6));
}

TEST_CASE("the grains of the small simulator carry the load, keep their momentum, and rest") {
  support::oedometer_options o;
  o.grains = 100;
  o.slenderness = 2;
  support::dem column = support::settled_column(support::loose_column(o), o);
  CHECK(column.piston_force == doctest::Approx(column.load).epsilon(1e-6));
  CHECK(column.base_force() == doctest::Approx(column.load).epsilon(1e-6));
  CHECK(column.unbalanced() < 1e-6);
  const double height = column.height();
  for (int step = 0; step < 500; ++step) {
    column.push();
    column.move(column.time_step());
  }
  CHECK(column.height() == doctest::Approx(height).epsilon(1e-9));
}

TEST_CASE("a saturated column consolidates as Terzaghi says, within what one layer of its grains can tell") {
  support::oedometer_options o;
  o.grains = 300;
  o.slenderness = 4;
  o.seed = 3;
  o.end = 0.55;
  o.rebuild_every = 500;
  support::dem column = support::settled_column(support::loose_column(o), o);
  const support::consolidation c = support::consolidate(column, o, compiled_triangulation{});
  const double layer = 2 * o.radius / c.ground.height;
  MESSAGE("settlement " << c.settlement_error << ", pressure " << c.pressure_error << ", one layer " << layer);
  CHECK(c.settlement_error < layer);
  CHECK(c.pressure_error < 1.5 * layer);
  CHECK(c.initial_pressure == doctest::Approx(1).epsilon(0.06));
  CHECK(c.mass_defect < 1e-13);
  CHECK(c.rebuilds > 3);
  CHECK(c.unsolved == 0);
}
