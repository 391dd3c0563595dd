// SPDX-License-Identifier: BSD-3-Clause
//
// Fluids at rest: what the shipped table says is measured again for some of its entries.
#include "support/sanitized.hpp"
#include "tetrapore/lbm/calibrate.hpp"
#include "tetrapore/lbm/calibration.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace tetrapore;
using namespace tetrapore::lbm;

namespace {

template <class Forcing>
void flat_interface_is_that_of_the_table(double attraction) {
  const auto row = calibrated(kind_of_forcing<Forcing>, 1, attraction);
  REQUIRE(row.ok());
  const auto f = measure_flat_interface<mixture<d2q9, bgk, Forcing>>({.attraction = attraction});
  REQUIRE(f.rest.end == hold_end::stable);
  CHECK(f.residual < 1e-10);  // momentum is balanced plane by plane
  CHECK(f.main == doctest::Approx(1).epsilon(2e-6));
  CHECK(f.dissolved == doctest::Approx(row.value.dissolved).epsilon(2e-4));  // the table's digits
  CHECK(f.factor == doctest::Approx(row.value.factor).epsilon(1e-5));
  CHECK(f.tension == doctest::Approx(row.value.flat_tension).epsilon(2e-4));
  CHECK(f.width == doctest::Approx(row.value.width).epsilon(2e-3));
}

constexpr double degree = pi<double> / 180;

}  // namespace

TEST_CASE("a flat interface balances its momentum to round-off and is that of the table") {
  flat_interface_is_that_of_the_table<velocity_shift>(1.8);
  if constexpr (!sanitized) {
    flat_interface_is_that_of_the_table<guo>(3.2);
  }
}

TEST_CASE("components that are too weakly opposed to part have no interface: refused, not measured") {
  const auto f = measure_flat_interface<>({.attraction = 0.45});
  CHECK(f.rest.end == hold_end::dissolved);
  CHECK(f.tension == 0);
}

TEST_CASE("the pressure in a disc is the flat tension over its radius, to the lattice's anisotropy of 1 %") {
  const auto b = laplace<mixture<d2q9, bgk>>({.radius = 14, .half_box = 24, .tension = 0.0862});
  REQUIRE(b.rest.end == hold_end::stable);
  CHECK(b.tension == doctest::Approx(0.0862).epsilon(0.015));
  CHECK(b.radius > b.radius_of_one);  // between the components there is a gap
  CHECK(b.spurious < 0.01);
  CHECK(std::abs(b.out_of_round) < 0.01);
}

TEST_CASE("a wall of the table makes its contact angle between plates; at 0 a film covers it") {
  const calibrated_mixture m = calibrated(forcing_kind::velocity_shift, 1, 1.8).value;
  constexpr double angle = 60 * degree;  // more of them: tests/long/lbm
  const auto c = angle_of_wettability<velocity_shift>(m, wettability(m, angle), angle, 16);
  REQUIRE(c.rest.end == hold_end::stable);
  CHECK(std::abs(c.angle - angle) < degree);
  CHECK(c.residual < 0.1);
  const auto film = angle_of_wettability<velocity_shift>(m, wettability(m, 0), 0, 12);
  REQUIRE(film.rest.end == hold_end::stable);
  CHECK(film.driest > 0);
  CHECK(film.cosine > 1);
}
