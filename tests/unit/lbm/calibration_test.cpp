// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/lbm/calibration.hpp"
#include "tetrapore/lbm/units.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace tetrapore;
using namespace tetrapore::lbm;

namespace {

constexpr double degree = pi<double> / 180;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("measured mixtures: rows as they are, between rows of one scheme linear, elsewhere refused") {
  for (const calibrated_mixture& m : calibrated_mixtures) {
    const auto again = calibrated(m.forcing, m.tau, m.attraction);
    REQUIRE(again.ok());
    CHECK(again.value.flat_tension == m.flat_tension);
    // what the law of coexistence says of the row's own c, to the digits of the table
    const auto dissolved = dissolved_density({m.attraction, m.factor, 0, m.main});
    REQUIRE(dissolved.ok());
    CHECK(dissolved.value == doctest::Approx(m.dissolved).epsilon(2e-3));
  }
  // the row at 1.8 is not far from the line between 1.6 and 2.0: twice that gap the line is off by less
  const auto at = [](double g) { return calibrated(forcing_kind::velocity_shift, 1, g).value; };
  CHECK((at(1.6).flat_tension + at(2.0).flat_tension) / 2 == doctest::Approx(at(1.8).flat_tension).epsilon(0.01));
  CHECK(at(1.7).flat_tension == doctest::Approx((at(1.6).flat_tension + at(1.8).flat_tension) / 2));
  CHECK(calibrated(forcing_kind::velocity_shift, 1, 1.3).reason == calibration_status::outside);
  CHECK(calibrated(forcing_kind::velocity_shift, 1, 2.5).reason == calibration_status::outside);
  CHECK(calibrated(forcing_kind::velocity_shift, 0.9, 1.8).reason == calibration_status::unknown_scheme);
}

TEST_CASE("wettability falls as the angle grows, is odd about a right angle, and 1 where a film is asked for") {
  for (const calibrated_mixture& m : calibrated_mixtures) {
    double last = 1;
    for (int angle = 0; angle <= 180; angle += 5) {
      const double x = wettability(m, angle * degree);
      CHECK(x <= last);
      CHECK(x == doctest::Approx(-wettability(m, (180 - angle) * degree)).epsilon(1e-12).scale(1));
      last = x;
    }
    CHECK(wettability(m, 60 * degree) == doctest::Approx(m.wettability[6]));
    CHECK(wettability(m, 0) == 1);
  }
  CHECK_THROWS_AS(static_cast<void>(wettability(calibrated_mixtures[0], -0.1)), parameter_error);
  CHECK_THROWS_AS(static_cast<void>(wettability(calibrated_mixtures[0], not_a_number)), parameter_error);
}

TEST_CASE("wall densities: of the liquid at 0, alike at a right angle, refused for a mixture that was not measured") {
  const coexistence pair{1.8, 1.99526, 0.5, 1.003};
  const double dissolved = dissolved_density(pair).value;
  const auto wet = wall_densities(pair, 0);
  CHECK(wet[0] == doctest::Approx(dissolved));
  CHECK(wet[1] == doctest::Approx(pair.main));
  const auto neutral = wall_densities(pair, pi<double> / 2);
  CHECK(neutral[0] == doctest::Approx(neutral[1]));
  CHECK(wall_densities(pair, 60 * degree)[1] > neutral[1]);
  CHECK_THROWS_AS(static_cast<void>(wall_densities({1.8, 1.7, 0.5, 1}, 1.0)), parameter_error);
  CHECK_THROWS_AS(static_cast<void>(wall_densities({0.4, 2, 0.5, 1}, 1.0)), parameter_error);
}

TEST_CASE("scales: Laplace's law holds in SI as on the lattice, capillary numbers are the same") {
  const calibrated_mixture m = calibrated(forcing_kind::velocity_shift, 1, 1.8).value;
  const physical_fluids water{.surface_tension = 0.072, .viscosity = 1e-3, .density = 998.0};
  const auto s = scales(m, water, {.node = 2e-6, .smallest_radius = 2e-5});
  REQUIRE(s.ok());
  const auto& u = s.value;
  CHECK(u.capillary_pressure * u.pressure == doctest::Approx(2 * 0.072 / 2e-5));
  CHECK(u.force == doctest::Approx(u.pressure * u.length * u.length));
  CHECK(u.velocity == doctest::Approx(u.length / u.time));
  const double lattice_viscosity = (m.main + m.dissolved) * (m.tau - 0.5) / 3;
  CHECK(1e-3 * u.velocity / 0.072 == doctest::Approx(lattice_viscosity / u.surface_tension));
  // mass: pressure is density × velocity²
  CHECK(u.inertia * 998.0 * u.velocity * u.velocity == doctest::Approx((m.main + m.dissolved) * u.pressure));
}

TEST_CASE("scales: each choice that a lattice cannot carry is refused with its reason") {
  const calibrated_mixture m = calibrated(forcing_kind::velocity_shift, 1, 1.8).value;
  const physical_fluids water{.surface_tension = 0.072, .viscosity = 1e-3, .density = 998.0};
  const auto why = [&](const calibrated_mixture& mixture, const physical_fluids& f, double node, double radius,
                       double velocity = 0) {
    const auto s = scales(mixture, f, {.node = node, .smallest_radius = radius, .velocity = velocity});
    CHECK(std::isnan(s.value.pressure) == !s.ok());
    return s.reason;
  };
  CHECK(why(m, water, 0, 1e-5) == scale_status::invalid_input);
  CHECK(why(m, physical_fluids{.surface_tension = not_a_number, .viscosity = 1e-3, .density = 998.0}, 1e-6, 1e-5) ==
        scale_status::invalid_input);
  calibrated_mixture other = m;
  other.tau = 0.505;
  CHECK(why(other, water, 1e-6, 1e-5) == scale_status::nearly_inviscid);
  other.tau = 2.5;
  CHECK(why(other, water, 1e-6, 1e-5) == scale_status::over_relaxed);
  CHECK(why(m, water, 1e-6, 1.4e-6) == scale_status::unresolved_interface);
  CHECK(why(m, water, 1e-6, 1.6e-6) == scale_status::unresolved_film);
  physical_fluids partly = water;
  partly.contact_angle = 1;
  CHECK(why(m, partly, 1e-6, 1.6e-6) == scale_status::dissolving);
  // σ/μ is 72 m/s; on the lattice half a unit: 0.01 of it is slower than spurious currents at 0.0067
  CHECK(why(m, partly, 1e-6, 1e-5, 0.1) == scale_status::drowned_in_spurious);
  CHECK(why(m, partly, 1e-6, 1e-5, 50) == scale_status::too_fast);
  CHECK(why(m, partly, 1e-6, 1e-5, 2) == scale_status::not_quasi_static);
  other = m;
  other.spurious = 1e-4;
  CHECK(why(other, partly, 1e-6, 1e-5, 0.1) == scale_status::ok);
}
