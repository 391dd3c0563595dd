// SPDX-License-Identifier: BSD-3-Clause
// What the prose of lubrication_law and apply promises, for every model.

#include "tetrapore/law/lubrication.hpp"

#include "support/pairs.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace tetrapore;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Sizes that the parts of the answer may have cancelled from.
struct sizes {
  double force;
  double torque;
  double power;
};

sizes sizes_of(const pair_resistance<double>& r, const pair_motion<double>& m) {
  const double arms = r.arm1 + r.arm2;
  const double speed = norm(m.velocity1) + norm(m.velocity2) + arms * (norm(m.spin1) + norm(m.spin2));
  const double spin = norm(m.spin1) + norm(m.spin2);
  const double force = (r.squeeze + r.shear) * speed + std::abs(r.coupling) * spin;
  const double torque = arms * force + std::abs(r.coupling) * speed + (r.roll + r.twist) * spin;
  return {force, torque, force * speed + torque * spin};
}

template <class Draw>
void every_model(int count, const Draw& test) {
  pairs::random_pairs random(7);
  const leading_order leading{.viscosity = 1e-3};
  const two_spheres resolved{.viscosity = 1e-3};
  const sphere_plane wall{.viscosity = 1e-3};
  const rough<leading_order> rugged{.law = leading, .height = 1e-3};
  for (int k = 0; k < count; ++k) {
    edge<double> e = random.pair(1000, 1e-9, 10);
    test(random, leading, e);
    test(random, rugged, e);
    test(random, resolved, random.pair(10, 1e-9, 1));
    e.radius2 = std::numeric_limits<double>::infinity();
    e.gap = e.radius1 * random.between_logs(1e-9, 2);
    test(random, wall, e);
    test(random, leading, e);
  }
}

[[nodiscard]] vec3<double> rotated(const vec3<double>& v, const vec3<double>& axis, double angle) {
  return v * std::cos(angle) + cross(axis, v) * std::sin(angle) + axis * (dot(axis, v) * (1 - std::cos(angle)));
}

}  // namespace

TEST_CASE("no model ever feeds energy: a million random motions, radii to 1 : 1000") {
  int fed = 0;
  double worst = 0;
  int answers = 0;
  every_model(200000, [&](pairs::random_pairs& random, const auto& law, const edge<double>& e) {
    const auto answer = law.resistance(e);
    const auto& r = answer.value;
    const pair_motion<double> m = random.motion(std::min(e.radius1, e.radius2));
    const double lost = power(r, m);
    const double size = sizes_of(r, m).power;
    answers += answer.ok() ? 1 : 0;
    fed += lost >= -64 * eps * size ? 0 : 1;
    // the forces do what the quadratic form says
    worst = std::max(worst, std::abs(lost + pairs::work(apply(r, m), m)) / (eps * size));
  });
  CHECK(answers == 1000000);
  CHECK(fed == 0);
  CHECK(worst < 64);
}

TEST_CASE("the form is positive semi-definite in the numbers themselves, with room to spare") {
  double narrowest = 1;
  double smallest = 1;
  every_model(20000, [&](pairs::random_pairs&, const auto& law, const edge<double>& e) {
    const auto r = law.resistance(e).value;
    smallest = std::min({smallest, r.squeeze, r.shear, r.roll});
    narrowest = std::min(narrowest, 1 - r.coupling * r.coupling / (r.shear * r.roll));
    CHECK_MESSAGE(r.twist >= 0, e.radius1, " ", e.radius2, " ", e.gap);
  });
  CHECK(smallest > 0);
  CHECK(narrowest > 0.15);
}

TEST_CASE("a rigid motion of the pair costs nothing") {
  double worst = 0;
  every_model(20000, [&](pairs::random_pairs& random, const auto& law, const edge<double>& e) {
    const auto r = law.resistance(e).value;
    const vec3<double> shift = random.vector();
    const vec3<double> turn = random.vector() * (1 / (r.arm1 + r.arm2));
    const pair_motion<double> m{shift - cross(turn, r.normal * r.arm1), turn, shift + cross(turn, r.normal * r.arm2),
                                turn};
    const pair_forces<double> f = apply(r, m);
    const sizes s = sizes_of(r, m);
    worst = std::max({worst, norm(f.force1) / s.force, norm(f.torque1) / s.torque, norm(f.torque2) / s.torque});
  });
  CHECK(worst < 16 * eps);
}

TEST_CASE("forces are opposite and the torques balance about any point") {
  double worst = 0;
  bool opposite = true;
  every_model(20000, [&](pairs::random_pairs& random, const auto& law, const edge<double>& e) {
    const auto r = law.resistance(e).value;
    const pair_motion<double> m = random.motion(e.radius1);
    const pair_forces<double> f = apply(r, m);
    opposite = opposite && f.force1 == -f.force2;
    const double distance = r.arm1 + r.arm2;
    const vec3<double> about = random.vector() * distance;
    const vec3<double> total =
        f.torque1 + f.torque2 + cross(-about, f.force1) + cross(r.normal * distance - about, f.force2);
    worst = std::max(worst, norm(total) / sizes_of(r, m).torque);
    // the arms add up to the distance of the centres; of a plane: of its foot point
    const double centres = e.with_plane() ? e.radius1 + e.gap : e.radius1 + e.radius2 + e.gap;
    CHECK(std::abs(distance - centres) <= 4 * eps * centres);
  });
  CHECK(opposite);
  CHECK(worst < 16 * eps);
}

TEST_CASE("the forces of one motion do the same work on another as the other way round") {
  double worst = 0;
  every_model(20000, [&](pairs::random_pairs& random, const auto& law, const edge<double>& e) {
    const auto r = law.resistance(e).value;
    const pair_motion<double> m = random.motion(e.radius1);
    const pair_motion<double> n = random.motion(e.radius1);
    const double size = std::sqrt(sizes_of(r, m).power) * std::sqrt(sizes_of(r, n).power);
    worst = std::max(worst, std::abs(pairs::work(apply(r, m), n) - pairs::work(apply(r, n), m)) / size);
  });
  CHECK(worst < 16 * eps);
}

TEST_CASE("the forces are linear in the motion and turn with the pair") {
  double worst = 0;
  every_model(20000, [&](pairs::random_pairs& random, const auto& law, const edge<double>& e) {
    const auto r = law.resistance(e).value;
    const pair_motion<double> m = random.motion(e.radius1);
    const pair_motion<double> n = random.motion(e.radius1);
    const double by = random.between(-2, 2);
    const pair_motion<double> both{m.velocity1 + n.velocity1 * by, m.spin1 + n.spin1 * by,
                                   m.velocity2 + n.velocity2 * by, m.spin2 + n.spin2 * by};
    const pair_forces<double> f = apply(r, m);
    const pair_forces<double> g = apply(r, n);
    const pair_forces<double> h = apply(r, both);
    const sizes s = sizes_of(r, m);
    const sizes t = sizes_of(r, n);
    worst = std::max(worst, norm(h.force1 - f.force1 - g.force1 * by) / (s.force + 2 * t.force));
    worst = std::max(worst, norm(h.torque2 - f.torque2 - g.torque2 * by) / (s.torque + 2 * t.torque));

    const vec3<double> axis = random.direction();
    const double angle = random.between(-3, 3);
    edge<double> turned = e;
    turned.normal = rotated(e.normal, axis, angle);
    const pair_motion<double> with{rotated(m.velocity1, axis, angle), rotated(m.spin1, axis, angle),
                                   rotated(m.velocity2, axis, angle), rotated(m.spin2, axis, angle)};
    const pair_forces<double> k = apply(law.resistance(turned).value, with);
    worst = std::max(worst, norm(k.force1 - rotated(f.force1, axis, angle)) / s.force);
    worst = std::max(worst, norm(k.torque1 - rotated(f.torque1, axis, angle)) / s.torque);
  });
  CHECK(worst < 64 * eps);
}

TEST_CASE("the same pair seen from its other end has the same forces") {
  double worst = 0;
  every_model(20000, [&](pairs::random_pairs& random, const auto& law, const edge<double>& e) {
    if (e.with_plane()) {
      return;
    }
    const auto r = law.resistance(e).value;
    const pair_motion<double> m = random.motion(e.radius1);
    const pair_forces<double> f = apply(r, m);
    const pair_forces<double> g = apply(law.resistance(pairs::swapped(e)).value, pairs::swapped(m));
    const sizes s = sizes_of(r, m);
    worst = std::max({worst, norm(f.force1 - g.force2) / s.force, norm(f.torque1 - g.torque2) / s.torque,
                      norm(f.torque2 - g.torque1) / s.torque});
  });
  CHECK(worst < 512 * eps);
}

TEST_CASE("the resistance scales with the lengths and the viscosity") {
  double worst = 0;
  every_model(5000, [&](pairs::random_pairs&, const auto& law, const edge<double>& e) {
    if constexpr (requires { law.viscosity; }) {
      auto thicker = law;
      thicker.viscosity = 1e-3 * 7;
      edge<double> larger = e;
      larger.radius1 *= 3;
      larger.radius2 *= 3;
      larger.gap *= 3;
      const auto r = law.resistance(e).value;
      const auto v = thicker.resistance(e).value;
      const auto l = law.resistance(larger).value;
      worst = std::max({worst, std::abs(v.squeeze / (7 * r.squeeze) - 1), std::abs(v.roll / (7 * r.roll) - 1),
                        std::abs(l.squeeze / (3 * r.squeeze) - 1), std::abs(l.shear / (3 * r.shear) - 1),
                        std::abs(l.coupling - 9 * r.coupling) / (9 * std::sqrt(r.shear * r.roll)),
                        std::abs(l.roll / (27 * r.roll) - 1)});
    }
  });
  CHECK(worst < 2e-12);
}
