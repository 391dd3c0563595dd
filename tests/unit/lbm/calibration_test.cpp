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
    CHECK(dissolved.value == doctest::Approx(m.dissolved).epsilon(2e-3).scale(0));
  }
  // the row at 1.8 is not far from the line between 1.6 and 2.0: twice that gap the line is off by less
  const auto at = [](double g) { return calibrated(forcing_kind::velocity_shift, 1, g).value; };
  CHECK((at(1.6).flat_tension + at(2.0).flat_tension) / 2 ==
        doctest::Approx(at(1.8).flat_tension).epsilon(0.01).scale(0));
  CHECK(at(1.7).flat_tension ==
        doctest::Approx((at(1.6).flat_tension + at(1.8).flat_tension) / 2).scale(0).epsilon(1e-14));
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
    CHECK(wettability(m, 60 * degree) == doctest::Approx(m.wettability[6]).scale(0));
    CHECK(wettability(m, 0) == 1);
  }
  CHECK_THROWS_AS(static_cast<void>(wettability(calibrated_mixtures[0], -0.1)), parameter_error);
  CHECK_THROWS_AS(static_cast<void>(wettability(calibrated_mixtures[0], not_a_number)), parameter_error);
}

TEST_CASE("wall densities: of the liquid at 0, alike at a right angle, refused for a mixture that was not measured") {
  constexpr auto shift = forcing_kind::velocity_shift;
  const coexistence pair{1.8, 1.99526, 0.5, 1.003};
  const double dissolved = dissolved_density(pair).value;
  const auto wet = wall_densities(pair, shift, 1, 0);
  CHECK(wet[0] == doctest::Approx(dissolved).scale(0));
  CHECK(wet[1] == doctest::Approx(pair.main).scale(0));
  const auto neutral = wall_densities(pair, shift, 1, pi<double> / 2);
  CHECK(neutral[0] == doctest::Approx(neutral[1]).scale(0));
  CHECK(wall_densities(pair, shift, 1, 60 * degree)[1] > neutral[1]);
  CHECK_THROWS_AS(static_cast<void>(wall_densities({1.8, 1.7, 0.5, 1}, shift, 1, 1.0)), parameter_error);
  CHECK_THROWS_AS(static_cast<void>(wall_densities({0.4, 2, 0.5, 1}, shift, 1, 1.0)), parameter_error);
  CHECK_THROWS_AS(static_cast<void>(wall_densities(pair, shift, 0.9, 1.0)), parameter_error);
}

TEST_CASE("wall densities are those of the forcing and the tau asked for, however near another row's c is") {
  const calibrated_mixture slow = calibrated(forcing_kind::guo, 1, 2.8).value;
  const calibrated_mixture fast = calibrated(forcing_kind::guo, 0.7, 2.8).value;
  REQUIRE(std::abs(slow.factor / fast.factor - 1) < 0.01);
  for (const calibrated_mixture& m : {slow, fast}) {
    const coexistence pair{m.attraction, m.factor, (m.factor - 1) / 2, m.main};
    const auto walls = wall_densities(pair, m.forcing, m.tau, 20 * degree);
    const auto asked = wall_of_wettability(pair.main, dissolved_density(pair).value, m.wettability[2]);
    CHECK(walls[0] == asked[0]);
    CHECK(walls[1] == asked[1]);
  }
  CHECK(slow.wettability[2] != fast.wettability[2]);
}

TEST_CASE("scales: Laplace's law holds in SI as on the lattice, capillary numbers are the same") {
  const calibrated_mixture m = calibrated(forcing_kind::velocity_shift, 1, 1.8).value;
  const physical_fluids water{.surface_tension = 0.072, .viscosity = 1e-3, .density = 998.0};
  const auto s = scales(m, water, {.node = 2e-6, .smallest_radius = 2e-5});
  REQUIRE(s.ok());
  const auto& u = s.value;
  CHECK(u.capillary_pressure * u.pressure == doctest::Approx(2 * 0.072 / 2e-5).scale(0));
  CHECK(u.force == doctest::Approx(u.pressure * u.length * u.length).scale(0));
  CHECK(u.velocity == doctest::Approx(u.length / u.time).scale(0));
  const double lattice_viscosity = (m.main + m.dissolved) * (m.tau - 0.5) / 3;
  CHECK(1e-3 * u.velocity / 0.072 == doctest::Approx(lattice_viscosity / u.surface_tension).scale(0));
  // mass: pressure is density × velocity²
  CHECK(u.inertia * 998.0 * u.velocity * u.velocity == doctest::Approx((m.main + m.dissolved) * u.pressure).scale(0));
}

TEST_CASE("scales: a number of mixture, fluids or choice that is none is refused, none becomes a scale") {
  const calibrated_mixture m = calibrated(forcing_kind::velocity_shift, 1, 1.8).value;
  const physical_fluids water{.surface_tension = 0.072, .viscosity = 1e-3, .density = 998.0, .contact_angle = 1};
  const lattice_choice choice{.node = 1e-6, .smallest_radius = 1e-5, .velocity = 0};
  REQUIRE(scales(m, water, choice).ok());
  for (const auto number :
       {&calibrated_mixture::tau, &calibrated_mixture::attraction, &calibrated_mixture::main,
        &calibrated_mixture::dissolved, &calibrated_mixture::factor, &calibrated_mixture::width,
        &calibrated_mixture::flat_tension, &calibrated_mixture::density_exponent, &calibrated_mixture::bubble_tension,
        &calibrated_mixture::curvature, &calibrated_mixture::spurious}) {
    calibrated_mixture bad = m;
    bad.*number = not_a_number;
    const auto s = scales(bad, water, choice);
    CHECK(s.reason == scale_status::invalid_input);
    CHECK(std::isnan(s.value.time));
  }
  physical_fluids bad = water;
  bad.contact_angle = not_a_number;
  CHECK(scales(m, bad, choice).reason == scale_status::invalid_input);
  bad = water;
  bad.viscosity = not_a_number;
  CHECK(scales(m, bad, choice).reason == scale_status::invalid_input);
  lattice_choice none = choice;
  none.velocity = not_a_number;
  CHECK(scales(m, water, none).reason == scale_status::invalid_input);
  none = choice;
  none.node = not_a_number;
  CHECK(scales(m, water, none).reason == scale_status::invalid_input);
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
  physical_fluids partly = water;
  partly.contact_angle = 1;
  CHECK(why(m, water, 1e-6, 1.99e-6) == scale_status::unresolved_film);
  CHECK(why(m, water, 1e-6, 0.999 * m.width * 1e-6) == scale_status::unresolved_interface);
  CHECK(why(m, partly, 1e-6, 1.99e-6) == scale_status::unresolved_interface);
  CHECK(why(m, water, 1e-6, 1.001 * m.width * 1e-6) == scale_status::ok);
  other = m;
  other.bubble_tension *= 2;
  CHECK(why(other, water, 1e-6, 3e-6) == scale_status::dissolving);
  // σ/μ is 72 m/s; on the lattice half a unit: 0.01 of it is slower than spurious currents at 0.0067
  CHECK(why(m, partly, 1e-6, 1e-5, 0.1) == scale_status::drowned_in_spurious);
  CHECK(why(m, partly, 1e-6, 1e-5, 50) == scale_status::too_fast);
  CHECK(why(m, partly, 1e-6, 1e-5, 2) == scale_status::not_quasi_static);
  other = m;
  other.spurious = 1e-4;
  CHECK(why(other, partly, 1e-6, 1e-5, 0.1) == scale_status::ok);
}
