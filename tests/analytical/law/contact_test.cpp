// SPDX-License-Identifier: BSD-3-Clause
// A film in series with elastic grains, against what is known in closed form.

#include "tetrapore/law/contact.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

using namespace tetrapore;

namespace {

constexpr vec3<double> up{0, 0, 1};
constexpr double radius = 1e-3;
constexpr double viscosity = 1e-2;
constexpr double drag = 1.5 * std::numbers::pi * viscosity * radius * radius;  // ν of equal grains

struct flight {
  double rate, stored, dissipated, deepest, work;
};

/// Two grains fly at each other from a gap, and back to it or to rest: symplectic Euler for them, the law's step for
/// the film.
flight collide(const wet_contact<>& law, double mass, double gap, double rate, double time, int steps) {
  edge<double> e{radius, radius, gap, up};
  auto state = law.start(e);
  flight f{rate, 0, 0, gap, 0};
  for (int k = 0; k < steps; ++k) {
    pair_motion<double> m{};
    m.velocity2 = up * f.rate;
    e.gap += f.rate * time;
    const auto answer = law.step(e, m, time, state);
    REQUIRE(answer.ok());
    f.work += answer.value.pull * f.rate * time;
    f.rate -= answer.value.pull / mass * time;
    f.dissipated += answer.value.dissipated;
    f.stored = answer.value.stored;
    f.deepest = std::min(f.deepest, e.gap);
    if (e.gap > gap) {
      break;
    }
  }
  return f;
}

}  // namespace

TEST_CASE("stiff grains approach as rigid ones: m v + ν ln h is constant") {
  const double mass = 5e-6;  // reduced
  const wet_contact<> law{
      .film = {.viscosity = viscosity}, .normal_stiffness = 1e7, .shear_stiffness = 1e7, .friction = 0};
  edge<double> e{radius, radius, 1e-4, up};
  auto state = law.start(e);
  double v = -0.05;
  const double kept = mass * v + drag * std::log(e.gap);
  const double time = 2e-8;
  for (int k = 0; k < 200000 && e.gap > 2e-5; ++k) {
    pair_motion<double> m{};
    m.velocity2 = up * v;
    e.gap += v * time;
    v -= law.step(e, m, time, state).value.pull / mass * time;
  }
  CHECK(e.gap < 2.1e-5);
  CHECK(mass * v + drag * std::log(e.gap) == doctest::Approx(kept).epsilon(1e-3));
  CHECK(v == doctest::Approx((kept - drag * std::log(e.gap)) / mass).epsilon(1e-3));
}

TEST_CASE("a wet collision: what the grains lose is what the film dissipates and the springs keep") {
  const double mass = 5e-6;
  const wet_contact<> law{.film = {.viscosity = viscosity},
                          .normal_stiffness = 1e4,
                          .shear_stiffness = 1e4,
                          .friction = 0,
                          .asperity_height = 1e-7,
                          .asperity_stiffness = 1e4};
  double last = 1;
  for (const double speed : {0.01, 0.1, 1.0}) {
    const double before = 0.5 * mass * speed * speed;
    std::vector<double> defects;
    flight f{};
    for (const double time : {4e-8, 2e-8}) {
      f = collide(law, mass, 1e-5, -speed, time, 400000);
      defects.push_back((before - 0.5 * mass * f.rate * f.rate - f.dissipated - f.stored) / before);
    }
    CHECK(std::abs(defects[1]) < 0.02);
    CHECK(std::abs(defects[1]) < 0.7 * std::abs(defects[0]));  // of the first order in the step
    if (speed == 0.01) {
      CHECK(std::abs(f.rate) < 1e-3);  // the film stops a slow grain: no rebound
      CHECK(f.deepest > 0);
    }
    if (speed == 1.0) {
      CHECK(f.rate > 0.5);  // and hardly a fast one
      CHECK(f.rate < 1.0);
      CHECK(f.deepest < 0);
    }
    const double lost = f.dissipated / before;
    CHECK(lost < last + 0.01);
    last = lost;
  }
}

TEST_CASE("without viscosity to speak of, two springs in series carry an overlap") {
  const wet_contact<> law{.film = {.viscosity = 1e-12},
                          .normal_stiffness = 1e4,
                          .shear_stiffness = 1e4,
                          .friction = 0,
                          .asperity_height = 1e-6,
                          .asperity_stiffness = 3e4};
  edge<double> e{radius, radius, 1e-5, up};
  auto state = law.start(e);
  e.gap = -1e-6;
  contact_forces<double> f{};
  for (int k = 0; k < 10; ++k) {
    f = law.step(e, {}, 1e-3, state).value;
  }
  // in µm: u (u + 1) = 3 (1 − u), u = √7 − 2
  const double u = std::sqrt(7.0) - 2;
  CHECK(f.thickness == doctest::Approx(u * 1e-6).epsilon(1e-6));
  CHECK(f.pull == doctest::Approx(-1e-2 * (1 + u)).epsilon(1e-6));
  CHECK(f.asperities == doctest::Approx(3e-2 * (1 - u) / u).epsilon(1e-6));
  CHECK(f.stored == doctest::Approx(0.5e-8 * (1 + u) * (1 + u) + 3e-8 * (-std::log(u) - (1 - u))).epsilon(1e-6));
}

TEST_CASE("a dry collision gives back what it took") {
  const dry_contact law{.normal_stiffness = 1e4, .shear_stiffness = 1e4, .friction = 0.3};
  edge<double> e{radius, radius, 1e-9, up};
  auto state = law.start(e);
  double v = -0.1;
  const double mass = 5e-6;
  const double time = 1e-9;
  double deepest = 0;
  for (int k = 0; k < 10000000 && e.gap < 2e-9; ++k) {
    pair_motion<double> m{};
    m.velocity2 = up * v;
    e.gap += v * time;
    v -= law.step(e, m, time, state).value.pull / mass * time;
    deepest = std::min(deepest, e.gap);
  }
  CHECK(v == doctest::Approx(0.1).epsilon(1e-4));
  CHECK(deepest == doctest::Approx(-0.1 * std::sqrt(mass / 1e4)).epsilon(1e-3));
}
