// SPDX-License-Identifier: BSD-3-Clause

#include "tetrapore/law/contact.hpp"
#include "tetrapore/law/lubrication.hpp"

#include "support/pairs.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace tetrapore;

namespace {

constexpr vec3<double> up{0, 0, 1};

template <class T>
void every_step_length() {
  pairs::random_pairs random(11);
  int refused = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    // natural time ν/(k u)
    const T u(static_cast<T>(random.between_logs(1e-3, 1e3)));
    const T gap(static_cast<T>(random.between(-2, 2)) * u);
    const elastic_film<T> film{static_cast<T>(random.between_logs(1e-3, 1e3)),
                               static_cast<T>(random.between_logs(1e-3, 1e3)),
                               static_cast<T>(random.between(0, 1) < 0.5 ? 0 : random.between_logs(1e-3, 10)) * u,
                               static_cast<T>(random.between_logs(1e-3, 1e3))};
    const T natural = film.drag / (film.stiffness * u);
    for (int power = -12; power <= 12; ++power) {
      const T time = natural * static_cast<T>(std::pow(10.0, power));
      const auto backward = step_film(film, u, gap, gap, time);
      CHECK(backward.ok());
      CHECK(backward.value > T(0));
      CHECK(backward.value < T(1e30));
      for (const film_scheme& s : {film_scheme{film_variable::thickness, 0.5}, film_scheme{film_variable::logarithm, 1},
                                   film_scheme{film_variable::logarithm, 0.5}}) {
        const auto other = step_film(film, u, gap, gap, time, s);
        if (other.ok()) {
          CHECK(other.value > T(0));
        } else {
          CHECK(other.reason == film_status::step_too_long);
          CHECK(std::isnan(other.value));
          CHECK(power >= 0);  // only a step beyond the natural time can be too long
          ++refused;
        }
      }
    }
  }
  CHECK(refused > 0);
}

}  // namespace

TEST_CASE("the film stays positive for steps of 1e-12 to 1e12 of its natural time, in double") {
  every_step_length<double>();
}
TEST_CASE("the film stays positive for steps of 1e-12 to 1e12 of its natural time, in float") {
  every_step_length<float>();
}

TEST_CASE("a long step of backward Euler reaches equilibrium, a short one hardly moves") {
  const elastic_film<double> film{1, 1};
  CHECK(step_film(film, 1.0, 0.3, 0.3, 1e12).value == doctest::Approx(0.3).epsilon(1e-10));
  CHECK(step_film(film, 1.0, 0.3, 0.3, 1e-12).value == doctest::Approx(1 - 0.7e-12).epsilon(1e-15));
  // in an overlap it thins as ν u/(k |gap| Δt)
  CHECK(step_film(film, 1.0, -0.5, -0.5, 1e12).value == doctest::Approx(2e-12).epsilon(1e-10));
}

TEST_CASE("two masses approach for steps of any length without touching, and Newton's iteration ends") {
  pairs::random_pairs random(5);
  for (int trial = 0; trial < 20000; ++trial) {
    const approach<double> at{random.between_logs(1e-6, 1), random.between(-1, 1) * random.between_logs(1e-6, 1e3)};
    const double mass = random.between_logs(1e-6, 1e3);
    const double drag = random.between_logs(1e-6, 1e3);
    const double natural = mass * at.gap / drag;
    const double time = natural * random.between_logs(1e-12, 1e12);
    const auto thickness = step_approach(at, mass, drag, 0.0, time, film_variable::thickness);
    CHECK(thickness.ok());
    CHECK(thickness.value.gap > 0);
    const auto logarithm = step_approach(at, mass, drag, 0.0, time);
    if (logarithm.ok()) {
      CHECK(logarithm.value.gap > 0);
      if (logarithm.value.gap < 1e-300) {
        continue;  // a gap with fewer digits has a logarithm with fewer digits
      }
      CHECK(std::abs(mass * (logarithm.value.rate - at.rate) + drag * std::log(logarithm.value.gap / at.gap)) <=
            1e-13 * (mass * std::abs(at.rate) + drag * (1 + std::abs(std::log(at.gap)))));
    } else {
      // e^(m v/ν) is not a number
      CHECK(std::abs(mass * at.rate / drag) > 600);
    }
  }
}

TEST_CASE("the equation of the logarithm is solved to rounding, wherever it lies") {
  pairs::random_pairs random(9);
  for (int trial = 0; trial < 200000; ++trial) {
    const double a = random.between_logs(1e-15, 1e15);
    const double b = random.between(0, 1) < 0.5 ? 0 : random.between_logs(1e-15, 1e15);
    const double c = random.between(-1, 1) * random.between_logs(1e-15, 600);
    const double y = detail::logarithmic_growth(a, b, c);
    const double left = y + a * std::expm1(y) - b * std::expm1(-y);
    const double size = std::abs(y) + std::abs(a * std::expm1(y)) + std::abs(b * std::expm1(-y)) + std::abs(c);
    // the rounding of the terms, and of y times the slope
    CHECK(std::abs(left - c) <= 5e-16 * (size + std::abs(y) * (1 + a * std::exp(y) + b * std::exp(-y))));
  }
}

TEST_CASE("laws answer at gaps of 1e-12 of the radius and for grains of micrometres and kilometres alike") {
  const leading_order leading{.viscosity = 1e-3};
  const two_spheres resolved{.viscosity = 1e-3};
  for (const double size : {1e-9, 1e-6, 1.0, 1e6}) {
    for (const double gap : {1e-12, 1e-6, 1e-2}) {
      const edge<double> e{size, 0.4 * size, gap * size, up};
      CHECK(leading.resistance(e).ok());
      CHECK(resolved.resistance(e).ok());
      CHECK(resolved.resistance(e).value.squeeze >= leading.resistance(e).value.squeeze);
      CHECK(resolved.resistance(e).value.roll >= leading.resistance(e).value.roll);
    }
  }
}

TEST_CASE("a wet contact takes steps of 1e-12 to 1e12 of its natural time") {
  const wet_contact<> law{.film = {.viscosity = 1e-3},
                          .normal_stiffness = 1e4,
                          .shear_stiffness = 1e4,
                          .friction = 0.5,
                          .asperity_height = 1e-6,
                          .asperity_stiffness = 1e4};
  const double natural = 1.5 * 3.14159 * 1e-3 * 1e-6 / (1e4 * 1e-5);
  for (const double gap : {1e-5, 1e-7, 0.0, -1e-6, -1e-4}) {
    for (int power = -12; power <= 12; ++power) {
      edge<double> e{1e-3, 1e-3, 1e-5, up};
      auto state = law.start(e);
      e.gap = gap;
      for (int k = 0; k < 5; ++k) {
        const auto f = law.step(e, {{0.01, 0, 0}, {0, 3, 1}, {}, {}}, natural * std::pow(10.0, power), state);
        CHECK(f.ok());
        CHECK(state.thickness > 0);
        CHECK(f.value.dissipated >= 0);
        CHECK(std::isfinite(norm(f.value.on.force1)));
        CHECK(std::isfinite(norm(f.value.on.torque2)));
      }
    }
  }
}
