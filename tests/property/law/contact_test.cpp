// SPDX-License-Identifier: BSD-3-Clause
// What the prose of contact_law promises, for every model, on random histories of a pair.

#include "tetrapore/law/contact.hpp"

#include "tetrapore/law/lubrication/rough.hpp"
#include "tetrapore/law/lubrication/two_spheres.hpp"

#include "support/pairs.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace tetrapore;

namespace {

/// A pair of moving grains, followed step by step.
struct walk {
  vec3<double> centre1, centre2;
  double radius1, radius2;

  [[nodiscard]] edge<double> pair() const {
    const vec3<double> apart = centre2 - centre1;
    const double distance = norm(apart);
    return {radius1, radius2, distance - radius1 - radius2, apart / distance};
  }
};

template <class Test>
void every_model(const Test& test) {
  pairs::random_pairs random(21);
  for (int k = 0; k < 300; ++k) {
    const double normal = random.between_logs(1e2, 1e5);
    const double shear = normal * random.between_logs(0.1, 1);
    const double friction = random.between(0, 1);
    const double height = random.between_logs(1e-7, 1e-5);
    const double asperities = normal * random.between_logs(0.1, 10);
    test(random, dry_contact{.normal_stiffness = normal, .shear_stiffness = shear, .friction = friction});
    test(random, wet_contact<>{.film = {.viscosity = 1e-2},
                               .normal_stiffness = normal,
                               .shear_stiffness = shear,
                               .friction = friction,
                               .asperity_height = height,
                               .asperity_stiffness = asperities});
    test(random, wet_contact<rough<two_spheres>>{.film = {.law = {.viscosity = 1e-2}, .height = height},
                                                 .normal_stiffness = normal,
                                                 .shear_stiffness = shear,
                                                 .friction = friction,
                                                 .asperity_height = height,
                                                 .asperity_stiffness = asperities});
  }
}

walk start(pairs::random_pairs& random) {
  const double a = 1e-3;
  const double b = a * random.between(0.3, 1);
  const vec3<double> n = random.direction();
  return {{0, 0, 0}, n * (a + b + 1e-5 * random.between(0.2, 1)), a, b};
}

pair_motion<double> motion(pairs::random_pairs& random, const walk& w) {
  // mostly to and fro along the normal, so that grains touch and part
  const vec3<double> n = w.pair().normal;
  const double pull = w.pair().gap > 2e-5 ? -1 : w.pair().gap < -1e-5 ? 1 : random.between(-1, 1);
  return {random.vector() * 1e-2, random.vector() * 10, random.vector() * 1e-2 + n * (0.05 * pull),
          random.vector() * 10};
}

void move(walk& w, const pair_motion<double>& m, double time) {
  w.centre1 += m.velocity1 * time;
  w.centre2 += m.velocity2 * time;
}

}  // namespace

TEST_CASE("forces are opposite, torques balance, and no step dissipates less than nothing") {
  int contacts = 0;
  int slid = 0;
  double worst = 0;
  every_model([&](pairs::random_pairs& random, const auto& law) {
    walk w = start(random);
    auto state = law.start(w.pair());
    const double time = random.between_logs(1e-7, 1e-4);
    for (int k = 0; k < 100; ++k) {
      const pair_motion<double> m = motion(random, w);
      move(w, m, time);
      const edge<double> e = w.pair();
      const auto answer = law.step(e, m, time, state);
      if (answer.reason == contact_status::apart) {
        continue;
      }
      REQUIRE(answer.ok());
      const contact_forces<double>& f = answer.value;
      CHECK(f.dissipated >= -1e-14 * (f.stored + std::abs(f.dissipated)));
      CHECK(f.asperities >= 0);
      const vec3<double> total = f.on.torque1 + f.on.torque2 + cross(w.centre2 - w.centre1, f.on.force2);
      const double size = norm(f.on.torque1) + norm(f.on.torque2) + norm(w.centre2 - w.centre1) * norm(f.on.force2);
      CHECK(f.on.force1 == -f.on.force2);
      worst = std::max(worst, norm(total) / (size + 1e-300));
      contacts += f.asperities > 0 ? 1 : 0;
      slid += f.asperities > 0 && f.sliding ? 1 : 0;
    }
  });
  CHECK(worst < 1e-14);
  CHECK(contacts > 1000);
  CHECK(slid > 100);
}

TEST_CASE("over one step the work on the pair covers what is stored and dissipated, whatever the step") {
  double worst = 0;
  every_model([&](pairs::random_pairs& random, const auto& law) {
    walk w = start(random);
    // along one line: the edge keeps its normal, so that the work of the last force is exact
    auto state = law.start(w.pair());
    const vec3<double> n = w.pair().normal;
    const double time = random.between_logs(1e-7, 1e-2);
    double stored = 0;
    double gap = w.pair().gap;
    bool touched = false;
    for (int k = 0; k < 60; ++k) {
      const double opening = (gap > 2e-5 ? -1 : gap < -1e-5 ? 1 : random.between(-1, 1)) * 3e-6 / time;
      gap += opening * time;
      edge<double> e = w.pair();
      e.normal = n;
      e.gap = gap;
      pair_motion<double> m{};
      m.velocity2 = n * opening + cross(n, random.vector()) * (1e-6 / time);
      m.spin1 = cross(n, random.vector()) * (1e-3 / time);
      const auto answer = law.step(e, m, time, state);
      if (answer.reason == contact_status::apart) {
        stored = 0;
        touched = false;
        continue;
      }
      REQUIRE(answer.ok());
      const double work = -pairs::work(answer.value.on, m) * time;
      const double spent = answer.value.stored - stored + answer.value.dissipated;
      const double size = std::abs(work) + answer.value.stored + stored + answer.value.dissipated;
      if (touched) {
        worst = std::max(worst, (spent - work) / size);
      }
      stored = answer.value.stored;
      touched = true;
    }
  });
  CHECK(worst < 1e-12);
}

TEST_CASE("a pair that turns as a whole keeps its forces, turned with it") {
  double worst = 0;
  every_model([&](pairs::random_pairs& random, const auto& law) {
    walk w = start(random);
    edge<double> e = w.pair();
    e.gap = -2e-6;
    auto state = law.start(e);
    if constexpr (requires { state.thickness; }) {
      state.thickness = 1e-7;
    }
    pair_motion<double> m{};
    m.velocity2 = cross(e.normal, random.vector()) * 1e-3;
    contact_forces<double> before{};
    for (int k = 0; k < 400; ++k) {  // to rest: film and asperities in balance
      before = law.step(e, k < 3 ? m : pair_motion<double>{}, 1e-2, state).value;
    }
    // a quarter turn in small steps, about an axis across, then about the normal
    const vec3<double> axis = random.direction();
    const int steps = 4000;
    const double angle = 1.5 / steps;
    vec3<double> shear = before.shear;
    contact_forces<double> after{};
    for (int k = 0; k < steps; ++k) {
      const auto turn = [&](const vec3<double>& v) {
        return v * std::cos(angle) + cross(axis, v) * std::sin(angle) + axis * (dot(axis, v) * (1 - std::cos(angle)));
      };
      const vec3<double> middle = e.normal;
      e.normal = turn(e.normal);
      const vec3<double> along = (middle + e.normal) * 0.5;
      shear = turn(shear);
      const double a1 = e.radius1 + e.gap / 2;
      const double a2 = e.radius2 + e.gap / 2;
      const vec3<double> spin = axis * (angle / 1e-2);
      after = law.step(e, {-cross(spin, along * a1), spin, cross(spin, along * a2), spin}, 1e-2, state).value;
    }
    CHECK(after.pull == doctest::Approx(before.pull).epsilon(1e-6));
    worst = std::max(worst, norm(after.shear - shear) / (norm(shear) + 1e-3 * std::abs(before.pull)));
  });
  CHECK(worst < 4e-3);  // of the second order in the angle of a step
}
