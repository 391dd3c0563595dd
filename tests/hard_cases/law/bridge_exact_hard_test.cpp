// SPDX-License-Identifier: BSD-3-Clause
#include "support/bridges.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <random>

using namespace bridges;

namespace {

constexpr vec3<double> up{0, 0, 1};

auto at(double theta1, double theta2, double r2, double gap, double volume) {
  return law_of(radians(theta1), radians(theta2)).bridge(edge<double>{1.0, r2, gap, up}, given_volume<double>{volume});
}

auto by_suction(double theta1, double theta2, double r2, double gap, double suction) {
  return law_of(radians(theta1), radians(theta2))
      .bridge(edge<double>{1.0, r2, gap, up}, given_suction<double>{suction});
}

}  // namespace

TEST_CASE("at contact the force of a vanishing bridge is 2πR_eff σ (cos θ₁ + cos θ₂), from V/R³ = 1e-6 to 1e-18") {
  for (const double r2 : {1.0, 0.3, 0.01, infinity<double>}) {
    const double effective = 1 / (1 + 1 / r2);
    for (const double theta2 : {0.0, 40.0, 89.0}) {
      double before = 1;
      for (const double volume : {1e-6, 1e-9, 1e-12, 1e-18}) {
        CAPTURE(r2);
        CAPTURE(theta2);
        CAPTURE(volume);
        const auto b = at(20, theta2, r2, 0.0, volume * effective * effective * effective);
        REQUIRE(b.ok());
        const double limit = 2 * pi<double> * effective * (std::cos(radians(20)) + std::cos(radians(theta2)));
        const double off = std::abs(b.value.force / limit - 1);
        CHECK(off < before);
        before = off;
      }
      CHECK(before < 1e-3);
    }
  }
}

TEST_CASE("on both sides of the fold, one part in 1e10 away: the stable bridge, and none") {
  for (const double r2 : {1.0, 0.5, 0.01, infinity<double>}) {
    for (const double theta : {0.0, 20.0, 50.0}) {
      for (const double volume : {1e-9, 1e-3, 0.1}) {
        CAPTURE(r2);
        CAPTURE(theta);
        CAPTURE(volume);
        const double small = std::min(1.0, r2);
        const double v = volume * small * small * small;
        const auto law = law_of(radians(theta), radians(theta));
        const auto limit = law.rupture_gap(edge<double>{1.0, r2, 0.0, up}, given_volume<double>{v});
        REQUIRE(limit.ok());
        const auto before = at(theta, theta, r2, limit.value.gap * (1 - 1e-10), v);
        CHECK(before.reason == bridge_status::ok);
        const auto after = at(theta, theta, r2, limit.value.gap * (1 + 1e-10), v);
        CHECK(after.reason ==
              (limit.value.end == bridge_end::fold ? bridge_status::ruptured : bridge_status::lopsided));
        CHECK(after.value.force == 0);
        // the bridge nears the last one as the root of the distance
        CHECK(std::abs(before.value.force / limit.value.last.force - 1) < 1e-3);
        const double far = at(theta, theta, r2, limit.value.gap * 3, v).value.force;
        CHECK(far == 0);
      }
    }
  }
}

TEST_CASE("the fold of equal spheres at θ = 0 lies where it was found in 12 digits or more") {
  const double anchors[][2] = {{1e-6, 0.0100379895474649},
                               {1e-4, 0.0466534729206},
                               {1e-3, 0.100780963518334},
                               {1e-2, 0.219048821985724},
                               {0.1, 0.487990153832194}};
  for (const auto& a : anchors) {
    const auto limit = law_of(0, 0).rupture_gap(edge<double>{1.0, 1.0, 0.0, up}, given_volume<double>{a[0]});
    REQUIRE(limit.ok());
    CHECK(std::abs(limit.value.gap / a[1] - 1) < 1e-11);
  }
}

TEST_CASE("through the catenoid: suctions of ±1e-8 and 0 lie on one line") {
  for (const double r2 : {1.0, 0.1, infinity<double>}) {
    CAPTURE(r2);
    const double gap = 0.05 * std::min(1.0, r2);
    const auto b = by_suction(30, 10, r2, gap, 0.0);
    const auto above = by_suction(30, 10, r2, gap, 1e-8);
    const auto below = by_suction(30, 10, r2, gap, -1e-8);
    REQUIRE(b.ok());
    REQUIRE(above.ok());
    REQUIRE(below.ok());
    CHECK(b.value.suction == 0);
    CHECK(std::abs(b.value.force - 0.5 * (above.value.force + below.value.force)) < 1e-13 * b.value.force);
    const auto s = law_of(radians(30), radians(10)).stiffness(edge<double>{1.0, r2, gap, up}, b.value);
    CHECK(std::abs((above.value.volume - below.value.volume) / 2e-8 / s.volume_by_suction - 1) < 1e-5);
    // F = 2πσ r0 at the gorge of a catenoid, real or virtual
    CHECK(std::abs(b.value.force / (2 * pi<double> * b.value.extent) - 1) < 1e-14);
  }
}

TEST_CASE("cylinders: r = cos θ on equal spheres at p = σ/r, any gap, with force πσr and its volume") {
  for (const double theta : {20.0, 40.0, 60.0, 85.0}) {
    const double r = std::cos(radians(theta));
    const double gap = 0.4 * r;
    // δ = 90° − θ: caps of height 1 − sin θ
    const double h = 1 - std::sin(radians(theta));
    const double volume = pi<double> * r * r * (gap + 2 * h) - 2 * pi<double> / 3 * h * h * (3 - h);
    CAPTURE(theta);
    const auto b = at(theta, theta, 1.0, gap, volume);
    REQUIRE(b.ok());
    CHECK(std::abs(b.value.force / (pi<double> * r) - 1) < 1e-11);
    CHECK(std::abs(b.value.suction * r + 1) < 1e-11);
    CHECK(std::abs(b.value.neck / r - 1) < 1e-10);
    const auto a = law_of(radians(theta), radians(theta)).areas(edge<double>{1.0, 1.0, gap, up}, b.value);
    CHECK(std::abs(a.liquid_gas / (2 * pi<double> * r * (gap + 2 * h)) - 1) < 1e-10);
  }
}

TEST_CASE("bulging bridges of much liquid push, and are a sphere's zone where their pressure is 2σ/r") {
  const auto b = at(85, 85, 1.0, 0.0, 0.3);
  REQUIRE(b.ok());
  CHECK(b.value.force < 0);
  CHECK(b.value.suction < 0);
  CHECK(b.value.neck == b.value.contact1);
}

TEST_CASE("every angle up to 89.9°, any pair of angles, radii 1 : 1e-6 to a plane") {
  for (const double r2 : {1.0, 0.01, 1e-6, 1e6, infinity<double>}) {
    const double small = std::min(1.0, r2);
    for (const double theta1 : {0.0, 45.0, 89.0, 89.9}) {
      for (const double theta2 : {0.0, 60.0, 89.9}) {
        for (const double volume : {1e-9, 1e-4}) {
          CAPTURE(r2);
          CAPTURE(theta1);
          CAPTURE(theta2);
          CAPTURE(volume);
          const double v = volume * small * small * small;
          const auto touching = at(theta1, theta2, r2, 0.0, v);
          CHECK(touching.reason == bridge_status::ok);
          const auto apart = at(theta1, theta2, r2, 0.2 * std::cbrt(v), v);
          CHECK(apart.reason == bridge_status::ok);
          const auto overlap = at(theta1, theta2, r2, -0.001 * std::cbrt(v), v);
          CHECK(overlap.reason == bridge_status::ok);
          const auto gone = at(theta1, theta2, r2, 4 * std::cbrt(v), v);
          CHECK(gone.kind() == verdict::absent);
        }
      }
    }
  }
}

TEST_CASE("no bridge at a suction: beyond the fold ruptured, too little suction flooded") {
  CHECK(by_suction(0, 0, 1.0, 0.1, 10.0).reason == bridge_status::ruptured);
  CHECK(by_suction(0, 0, 1.0, 0.09, 10.0).reason == bridge_status::ok);
  CHECK(by_suction(40, 40, 1.0, 0.05, -3.0).reason == bridge_status::flooded);
  CHECK(by_suction(40, 40, 1.0, 0.05, -3.0).kind() == verdict::refused);
}

TEST_CASE("no liquid is no bridge; bad input is refused with NaN") {
  const double nan = quiet_nan<double>;
  const double inf = infinity<double>;
  CHECK(at(0, 0, 1.0, 0.1, 0.0).reason == bridge_status::no_liquid);
  CHECK(at(0, 0, 1.0, 0.1, 0.0).value.force == 0);
  const auto refused = [](const auto& b) {
    CHECK(b.reason == bridge_status::invalid_input);
    CHECK(std::isnan(b.value.force));
  };
  refused(at(0, 0, 1.0, 0.1, -1e-9));
  refused(at(0, 0, 1.0, 0.1, nan));
  refused(at(0, 0, 1.0, 0.1, inf));
  refused(at(0, 0, 1.0, nan, 1e-3));
  refused(at(0, 0, 1.0, inf, 1e-3));
  refused(at(0, 0, 1.0, -1.0, 1e-3));
  refused(at(0, 0, 0.1, -0.2, 1e-3));
  refused(at(0, 0, 0.0, 0.1, 1e-3));
  refused(at(0, 0, -1.0, 0.1, 1e-3));
  refused(at(0, 0, nan, 0.1, 1e-3));
  refused(at(90, 0, 1.0, 0.1, 1e-3));
  refused(at(0, 91, 1.0, 0.1, 1e-3));
  refused(at(-1, 0, 1.0, 0.1, 1e-3));
  refused(at(nan, 0, 1.0, 0.1, 1e-3));
  refused(by_suction(0, 0, 1.0, 0.1, nan));
  refused(by_suction(0, 0, 1.0, 0.1, inf));
  const edge<double> planes{inf, inf, 0.1, up};
  refused(law_of(0, 0).bridge(planes, given_volume<double>{1e-3}));
  const edge<double> e{1.0, 1.0, 0.01, up};
  refused(law_of(0, 0, 0.0).bridge(e, given_volume<double>{1e-3}));
  refused(law_of(0, 0, -1.0).bridge(e, given_volume<double>{1e-3}));
  refused(law_of(0, 0, nan).bridge(e, given_volume<double>{1e-3}));
  CHECK(law_of(0, 0).rupture_gap(e, given_volume<double>{-1.0}).reason == bridge_status::invalid_input);
  CHECK(law_of(0, 0).rupture_gap(e, given_volume<double>{0.0}).reason == bridge_status::no_liquid);
}

TEST_CASE("a warm state survives another pair, another law, another control, a rupture and bad input") {
  const auto law = law_of(0.3, 0.3);
  young_laplace<>::warm_state<double> warm;
  const edge<double> near{1.0, 1.0, 0.02, up};
  const edge<double> far{1.0, 1.0, 2.0, up};
  const edge<double> other{1.0, 0.5, 0.02, up};
  const given_volume<double> v{1e-3};
  const auto cold = law.bridge(near, v);
  const auto same = [&](const auto& b, const auto& c) {
    CHECK(b.reason == c.reason);
    CHECK(std::abs(b.value.force - c.value.force) <= 2e-12 * std::abs(c.value.force));
  };
  same(law.bridge(near, v, warm), cold);
  same(law.bridge(far, v, warm), law.bridge(far, v));
  same(law.bridge(near, v, warm), cold);
  same(law.bridge(other, v, warm), law.bridge(other, v));
  same(law_of(0.5, 0.1).bridge(other, v, warm), law_of(0.5, 0.1).bridge(other, v));
  same(law_of(0.5, 0.1, 0.072).bridge(other, v, warm), law_of(0.5, 0.1, 0.072).bridge(other, v));
  const given_suction<double> p{3.0};
  same(law.bridge(near, p, warm), law.bridge(near, p));
  same(law.bridge(near, v, warm), cold);
  CHECK(law.bridge(edge<double>{1.0, 1.0, quiet_nan<double>, up}, v, warm).reason == bridge_status::invalid_input);
  same(law.bridge(near, v, warm), cold);
}

TEST_CASE("bridges form at contact or at a given gap and last until they rupture; shared liquid is conserved") {
  const auto law = law_of(0.2, 0.2);
  const given_volume<double> v{1e-3};
  bridge_presence<double> pair{.creation_gap = 0.01};
  const auto at_gap = [&](double gap) { return pair.bridge(law, edge<double>{1.0, 1.0, gap, up}, v).reason; };
  CHECK(at_gap(0.05) == bridge_status::no_liquid);
  CHECK(at_gap(0.005) == bridge_status::ok);
  CHECK(at_gap(0.05) == bridge_status::ok);
  CHECK(at_gap(0.5) == bridge_status::ruptured);
  CHECK(at_gap(0.05) == bridge_status::no_liquid);
  CHECK(at_gap(0.0) == bridge_status::ok);

  const edge<double> e{1.0, 0.3, 0.01, up};
  const auto b = law_of(0.4, 0.1).bridge(e, given_volume<double>{1e-4});
  const auto sides = law_of(0.4, 0.1).halves(e, b.value);
  CHECK(sides[0] > 0);
  CHECK(sides[1] > 0);
  CHECK(std::abs(sides[0] + sides[1] - 1e-4) < 1e-18);
  double volumes[3] = {1e-3, 3e-3, 0};
  const double weights[3] = {1e-3, 3e-3, 0};
  CHECK(share_liquid(4e-4, volumes, weights, 3));
  CHECK(volumes[0] == doctest::Approx(1.1e-3).epsilon(1e-14));
  CHECK(volumes[1] == doctest::Approx(3.3e-3).epsilon(1e-14));
  CHECK(volumes[2] < 1e-18);
  CHECK(std::abs(volumes[0] + volumes[1] + volumes[2] - 4.4e-3) < 1e-18);
  double empty[2] = {0, 0};
  CHECK(share_liquid(1.0, empty, empty, 2));
  CHECK(empty[0] + empty[1] == 1.0);
  CHECK_FALSE(share_liquid(1.0, empty, empty, 0));
  // what cannot be shared is refused, and nothing changes
  const double nan = quiet_nan<double>;
  double kept[2] = {1, 2};
  const double fair[2] = {1, 1};
  for (const double bad : {-1.0, nan, infinity<double>}) {
    const double skewed[2] = {bad, 2};
    CHECK_FALSE(share_liquid(1.0, kept, skewed, 2));
    CHECK_FALSE(share_liquid(bad, kept, fair, 2));
  }
  CHECK(kept[0] == 1);
  CHECK(kept[1] == 2);
  const young_laplace<> water{.surface_tension = 1.0};
  bridge_presence<double> nowhere{.creation_gap = nan};
  CHECK(nowhere.bridge(water, edge<double>{1, 1, 0.1, {1, 0, 0}}, given_volume<double>{1e-3}).reason ==
        bridge_status::invalid_input);
  CHECK_FALSE(nowhere.present);
  bridge_presence<double> apart{.creation_gap = 0.01};
  CHECK(apart.bridge(water, edge<double>{-1, 1, 0.1, {1, 0, 0}}, given_volume<double>{1e-3}).reason ==
        bridge_status::invalid_input);
  CHECK(apart.bridge(water, edge<double>{1, 1, nan, {1, 0, 0}}, given_volume<double>{1e-3}).reason ==
        bridge_status::invalid_input);
}

TEST_CASE("a plane at θ = 0 floods at a suction of 0 and less, whatever the sphere's angle; above 0 it has a bridge") {
  const double inf = infinity<double>;
  for (const double theta : {0.0, 30.0, 80.0}) {
    for (const double gap : {0.0, 0.05, 3.0, -0.01}) {
      CAPTURE(theta);
      CAPTURE(gap);
      for (const double suction : {0.0, -1e-12, -0.5, -3.0}) {
        CHECK(by_suction(theta, 0, inf, gap, suction).reason == bridge_status::flooded);
        // seen from its other end
        const auto turned =
            law_of(0, radians(theta)).bridge(edge<double>{inf, 1.0, gap, up}, given_suction<double>{suction});
        CHECK(turned.reason == bridge_status::flooded);
      }
    }
    const auto law = law_of(radians(theta), 0);
    const edge<double> e{1.0, inf, 0.0, up};
    CHECK(law.rupture_gap(e, given_suction<double>{0.0}).reason == bridge_status::flooded);
    CHECK(law.rupture_gap(e, given_suction<double>{-1.0}).reason == bridge_status::flooded);
    CHECK(law.bridge(e, given_suction<double>{1e-10}).ok());
  }
  // a plane that is wetted less holds a bridge at a suction of 0
  CHECK(by_suction(0, 30, inf, 0.05, 0.0).ok());
}

TEST_CASE("the highest suction over a plane at θ = 0, where it falls off as exp(−2 gap) from gap to gap of a radius") {
  const double inf = infinity<double>;
  const auto law = law_of(0, 0);
  double before = inf;
  for (const double gap : {0.5, 3.0, 5.0, 8.0, 10.0, 20.0, 100.0}) {
    CAPTURE(gap);
    const edge<double> e{1.0, inf, gap, up};
    const auto highest = law.highest_suction(e);
    REQUIRE(highest.ok());
    CHECK(highest.value < before);
    before = highest.value;
    const auto limit = law.rupture_gap(e, given_suction<double>{highest.value});
    REQUIRE(limit.ok());
    CHECK(std::abs(limit.value.gap / gap - 1) < 1e-11);
    CHECK(law.bridge(e, given_suction<double>{highest.value * (1 - 1e-6)}).ok());
    CHECK(law.bridge(e, given_suction<double>{highest.value * (1 + 1e-6)}).reason == bridge_status::ruptured);
  }
  CHECK(law.highest_suction(edge<double>{1.0, inf, 1e4, up}).reason == bridge_status::ruptured);
}

TEST_CASE("so much liquid that it would close over a grain at contact: from where it opens to the rupture") {
  const double inf = infinity<double>;
  struct {
    double r2, theta1, theta2, volume;
  } const cases[] = {{1, 25.5, 25.5, 47.9}, {1, 60, 60, 300}, {inf, 40, 40, 1e3}, {inf, 40, 40, 63100},
                     {inf, 40, 20, 3e4},    {10, 15, 56, 52}, {3, 1, 30, 200},    {0.2, 50, 20, 10.0},
                     {1, 5, 1, 100},        {1, 10, 70, 5e3}};
  for (const auto& c : cases) {
    CAPTURE(c.r2);
    CAPTURE(c.theta1);
    CAPTURE(c.volume);
    const auto law = law_of(radians(c.theta1), radians(c.theta2));
    const auto given = given_volume<double>{c.volume};
    const auto with = [&](double gap) { return edge<double>{1.0, c.r2, gap, up}; };
    CHECK(law.bridge(with(0.0), given).reason == bridge_status::flooded);
    const auto limit = law.rupture_gap(with(0.0), given);
    REQUIRE(limit.ok());
    const double widest = limit.value.gap;
    const auto last = law.bridge(with(widest * (1 - 1e-9)), given);
    REQUIRE(last.ok());
    CHECK(std::abs(last.value.force / limit.value.last.force - 1) < 1e-3);
    CHECK(law.bridge(with(widest * (1 + 1e-9)), given).reason ==
          (limit.value.end == bridge_end::fold ? bridge_status::ruptured : bridge_status::lopsided));
    // stable by finite elements, and of the law's own force: the slope of the energy
    const double gap = 0.97 * widest;
    const auto b = law.bridge(with(gap), given);
    REQUIRE(b.ok());
    const request asked{with(gap), radians(c.theta1), radians(c.theta2), true, c.volume};
    CHECK(count_negative(asked, b.value).at_volume == 0);
    const double step = 1e-4 * widest;
    const auto energy = [&](double at_gap) {
      const auto beside = law.bridge(with(at_gap), given);
      REQUIRE(beside.ok());
      return law.energy(with(at_gap), beside.value);
    };
    const double slope = (energy(gap + step) - energy(gap - step)) / (2 * step);
    CHECK(std::abs(slope / b.value.force - 1) < 1e-5);
    // down to where it closes, flooded from there on
    double open = gap;
    double shut = 0;
    for (int i = 0; i < 30; ++i) {
      const double middle = 0.5 * (open + shut);
      const auto there = law.bridge(with(middle), given);
      CHECK((there.ok() || there.reason == bridge_status::flooded));
      (there.ok() ? open : shut) = middle;
    }
    CHECK(open < gap);
    CHECK(law.bridge(with(0.9 * shut), given).reason == bridge_status::flooded);
  }
}

TEST_CASE("θ = 0: liquid closes over both grains as a ball about them, and is right until then") {
  double worst = 0;
  for (const double r2 : {1.0, 0.554, 0.1}) {
    for (const double gap : {0.0, 0.3, 2.0}) {
      CAPTURE(r2);
      CAPTURE(gap);
      const double ball = 1 + r2 + gap / 2;
      const double full = 4 * pi<double> / 3 * (ball * ball * ball - 1 - r2 * r2 * r2);
      for (const double share : {0.9, 0.97, 0.999, 0.99999, 0.999999, 1.000001, 1.01, 3.0}) {
        CAPTURE(share);
        const auto b = at(0, 0, r2, gap, share * full);
        if (share > 1) {
          CHECK((b.reason == bridge_status::flooded || b.kind() == verdict::absent));
          continue;
        }
        REQUIRE(b.ok());
        const edge<long double> e{1, static_cast<long double>(r2), static_cast<long double>(gap), {0, 0, 1}};
        const auto truth =
            law_of<40>(0, 0).bridge(e, given_volume<long double>{static_cast<long double>(share * full)});
        REQUIRE(truth.ok());
        const double off = std::abs(static_cast<double>(b.value.force - truth.value.force));
        // gap and volume are what the ball leaves of grains: a rounding of theirs
        const auto s = law_of(0, 0).stiffness(edge<double>{1.0, r2, gap, up}, b.value);
        const double rounding = std::ldexp(2 * ball * std::abs(s.force_by_gap_at_volume) +
                                               4 * ball * ball * ball * std::abs(s.suction_by_gap_at_volume),
                                           -53);
        CHECK(off < 1e-12 * std::abs(b.value.force) + 16 * rounding);
        worst = std::max(worst, off / (1e-12 * std::abs(b.value.force) + 16 * rounding));
      }
    }
  }
  MESSAGE("worst error ", worst, " of that");
}

TEST_CASE("no bridge is taken for out of reach, and none out of reach is named otherwise than by its whole curve") {
  std::mt19937_64 random(20);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  int early = 0;
  int asked = 0;
  for (int i = 0; i < 4000; ++i) {
    const double kind = uniform(0, 1);
    const double r2 = kind < 0.4   ? 1.0
                      : kind < 0.5 ? infinity<double>
                                   : std::pow(10.0, kind < 0.8 ? uniform(0, 0.5) : uniform(0.5, 4));
    const double theta1 = uniform(0, 1) < 0.15 ? 0.0 : uniform(0, 89.9);
    const double theta2 = uniform(0, 1) < 0.6 ? theta1 : uniform(0, 89.9);
    const bool by_volume = i % 2 == 0;
    const double value = std::pow(10.0, by_volume ? uniform(-12, 3) : uniform(-2, 5));
    CAPTURE(r2);
    CAPTURE(theta1);
    CAPTURE(theta2);
    CAPTURE(value);
    const auto law = law_of(radians(theta1), radians(theta2));
    const auto with = [&](double gap) { return edge<double>{1.0, r2, gap, up}; };
    const auto limit = by_volume ? law.rupture_gap(with(0.0), given_volume<double>{value})
                                 : law.rupture_gap(with(0.0), given_suction<double>{value});
    REQUIRE(limit.ok());
    const detail::surface_pair<double> pair{{{{1.0, std::cos(radians(theta1)), std::sin(radians(theta1))},
                                              {1.0 / r2, std::cos(radians(theta2)), std::sin(radians(theta2))}}},
                                            r2 == 1.0 && theta1 == theta2};
    detail::demand<double> d{0.0, by_volume ? value : 0.5 * value,
                             by_volume ? bridge_control::volume : bridge_control::suction};
    // the bound of a suction is a theorem, that of a volume keeps a margin
    d.gap = limit.value.gap * (by_volume ? 1.03 : 1.0);
    CHECK_FALSE(detail::out_of_reach(pair, d));
    if (i % 4 > 1) {
      continue;
    }
    for (const double share : {1.02, 1.3, 2.0, 10.0}) {
      d.gap = share * limit.value.gap;
      early += detail::out_of_reach(pair, d) ? 1 : 0;
      ++asked;
      const auto b = by_volume ? law.bridge(with(d.gap), given_volume<double>{value})
                               : law.bridge(with(d.gap), given_suction<double>{value});
      CHECK(b.reason == (limit.value.end == bridge_end::fold ? bridge_status::ruptured : bridge_status::lopsided));
    }
  }
  MESSAGE("told without a march: ", early, " of ", asked);
  CHECK(2 * early > asked);
}

TEST_CASE("equal pairs end where the bridge does, on either side of a slide that a step of the march all but meets") {
  const auto ends_at_its_limit = [](double theta, double volume) {
    CAPTURE(theta);
    CAPTURE(volume);
    const auto law = law_of(radians(theta), radians(theta));
    const auto limit = law.rupture_gap(edge<double>{1.0, 1.0, 0.0, up}, given_volume<double>{volume});
    REQUIRE(limit.ok());
    CHECK(limit.value.end == bridge_end::lopsided);
    CHECK(at(theta, theta, 1.0, limit.value.gap * (1 - 1e-12), volume).ok());
    CHECK(at(theta, theta, 1.0, limit.value.gap * (1 + 1e-12), volume).reason == bridge_status::lopsided);
    // next to a cylinder and where a profile has just passed a period, too, to the digits that are stated
    const auto finer = law_of<20>(radians(theta), radians(theta))
                           .rupture_gap(edge<long double>{1, 1, 0, {0, 0, 1}}, given_volume<long double>{volume});
    REQUIRE(finer.ok());
    CHECK(std::abs(limit.value.gap / static_cast<double>(finer.value.gap) - 1) < 2e-13);
  };
  struct {
    double theta, from, to;
  } const windows[] = {{53, 0.6615, 0.6635}, {89, 6.15e-5, 6.25e-5}, {70, 0.4, 0.52}, {0, 9.4, 10}};
  for (const auto& w : windows) {
    for (int i = 0; i <= 40; ++i) {
      ends_at_its_limit(w.theta, w.from + (w.to - w.from) * i / 40);
    }
  }
}
