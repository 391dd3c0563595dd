// SPDX-License-Identifier: BSD-3-Clause

#include "tetrapore/law/contact.hpp"

#include "tetrapore/law/lubrication/rough.hpp"
#include "tetrapore/law/lubrication/two_spheres.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

using namespace tetrapore;

namespace {

constexpr vec3<double> up{0, 0, 1};
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

constexpr wet_contact<> wet{.film = {.viscosity = 1e-3},
                            .normal_stiffness = 1e4,
                            .shear_stiffness = 8e3,
                            .friction = 0.5,
                            .asperity_height = 1e-6,
                            .asperity_stiffness = 1e4};
constexpr dry_contact dry{.normal_stiffness = 1e4, .shear_stiffness = 8e3, .friction = 0.5};

const edge<double> close_pair{1e-3, 1e-3, 1e-5, up};

}  // namespace

TEST_CASE("wet contacts with any lubrication law, and dry ones, are contact laws") {
  static_assert(contact_law<wet_contact<>, double>);
  static_assert(contact_law<wet_contact<two_spheres>, double>);
  static_assert(contact_law<wet_contact<rough<leading_order>>, float>);
  static_assert(contact_law<dry_contact, long double>);
}

TEST_CASE("bad edges, times, parameters and states are refused and leave the state as it was") {
  const auto refuses = [](const auto& law, const edge<double>& e, double time) {
    auto state = law.start(close_pair);
    const auto before = state;
    const auto answer = law.step(e, {}, time, state);
    CHECK(answer.reason == contact_status::invalid_input);
    CHECK(std::isnan(answer.value.pull));
    CHECK(std::isnan(answer.value.on.force1.x));
    CHECK(std::isnan(answer.value.dissipated));
    CHECK(state.shear == before.shear);
    CHECK(state.normal == before.normal);
  };
  const auto all = [&](const auto& law) {
    for (const double bad : {not_a_number, 0.0, -1.0}) {
      refuses(law, {bad, 1e-3, 1e-5, up}, 1e-6);
      refuses(law, {1e-3, bad, 1e-5, up}, 1e-6);
      refuses(law, close_pair, bad);
    }
    refuses(law, {1e-3, 1e-3, -2e-3, up}, 1e-6);
    refuses(law, {1e-3, 1e-3, inf, up}, 1e-6);
    refuses(law, {inf, 1e-3, 1e-5, up}, 1e-6);
    refuses(law, {1e-3, 1e-3, 1e-5, {0, 0, not_a_number}}, 1e-6);
    for (const double bad : {not_a_number, -1.0, inf, 0.0}) {
      auto other = law;
      other.normal_stiffness = bad;
      refuses(other, close_pair, 1e-6);
      other = law;
      other.shear_stiffness = bad;
      refuses(other, close_pair, 1e-6);
      if (bad != 0) {
        other = law;
        other.friction = bad;
        refuses(other, close_pair, 1e-6);
      }
    }
  };
  all(wet);
  all(dry);
  auto state = wet.start(close_pair);
  state.thickness = -1e-6;
  CHECK(wet.step(close_pair, {}, 1e-6, state).reason == contact_status::invalid_input);
  auto thin = wet;
  thin.film.viscosity = -1.0;
  state = thin.start(close_pair);
  CHECK(thin.step(close_pair, {}, 1e-6, state).reason == contact_status::invalid_input);
}

TEST_CASE("where the film's law ends the grains are apart, or the pair is not covered") {
  const wet_contact<two_spheres> law{
      .film = {.viscosity = 1e-3}, .normal_stiffness = 1e4, .shear_stiffness = 1e4, .friction = 0};
  edge<double> e{1e-3, 1e-3, 1.5e-3, up};
  auto state = law.start(e);
  state.shear = {1, 0, 0};
  const auto far = law.step(e, {}, 1e-6, state);
  CHECK(far.reason == contact_status::apart);
  CHECK(far.kind() == verdict::absent);
  CHECK(far.value.on.force1 == vec3<double>{});
  CHECK(state.shear == vec3<double>{});
  CHECK(state.thickness == e.gap);
  e = {1e-3, 1e-5, 1e-5, up};
  state = law.start(e);
  CHECK(law.step(e, {}, 1e-6, state).reason == contact_status::not_covered);
}

TEST_CASE("dry grains that do not overlap are apart, and each status has a sentence of its own") {
  auto state = dry.start(close_pair);
  CHECK(dry.step(close_pair, {}, 1e-6, state).reason == contact_status::apart);
  std::string seen;
  for (int k = 0; k < 6; ++k) {
    const std::string said = std::string("|") + describe(static_cast<contact_status>(k)) + "|";
    CHECK(seen.find(said) == std::string::npos);
    seen += said;
  }
}

TEST_CASE("a dry contact: Hooke's force, a shear spring, and Coulomb's limit") {
  edge<double> e{1e-3, 1e-3, -1e-6, up};
  auto state = dry.start(e);
  // surface 2 slips along x by 0.1 µm a step
  const pair_motion<double> slide{{}, {}, {1e-1, 0, 0}, {}};
  auto f = dry.step(e, slide, 1e-6, state);
  CHECK(f.value.pull == doctest::Approx(-1e-2).epsilon(1e-14));
  CHECK(f.value.shear.x == doctest::Approx(8e3 * 1e-7).epsilon(1e-14));
  CHECK(!f.value.sliding);
  CHECK(f.value.dissipated == 0);
  for (int k = 0; k < 20; ++k) {
    f = dry.step(e, slide, 1e-6, state);
  }
  CHECK(f.value.sliding);
  CHECK(f.value.shear.x == doctest::Approx(5e-3).epsilon(1e-13));
  CHECK(f.value.dissipated == doctest::Approx(5e-3 * 1e-7).epsilon(1e-12));
  CHECK(f.value.on.force1.x == doctest::Approx(5e-3).epsilon(1e-13));
  CHECK(f.value.on.force2.z == doctest::Approx(1e-2).epsilon(1e-13));
}

TEST_CASE("a state can start with a film thinner than the gap, or in an overlap") {
  const auto state = wet.start(edge<double>{1e-3, 1e-3, -1e-6, up}, 2e-7);
  CHECK(state.thickness == 2e-7);
}

TEST_CASE(
    "rough grains that touch or overlap from the start rest on their asperities, and a step at rest keeps them so") {
  for (const double gap : {0.0, -1e-9, -5e-7, -3e-5}) {
    CAPTURE(gap);
    const edge<double> e{1e-3, 1e-3, gap, up};
    auto state = wet.start(e);
    const double u = state.thickness;
    CHECK(u > 0);
    // k (u − u_n) = k_a (u_a − u) u_a/u
    CHECK(1e4 * (u - gap) == doctest::Approx(1e4 * (1e-6 - u) * 1e-6 / u).epsilon(1e-12));
    for (const double time : {1e-9, 1e-6, 1.0}) {
      const auto f = wet.step(e, {}, time, state);
      REQUIRE(f.ok());
      CHECK(f.value.thickness == doctest::Approx(u).epsilon(1e-9));
      CHECK(f.value.pull == doctest::Approx(-f.value.asperities).epsilon(1e-9));
      CHECK(f.value.asperities == doctest::Approx(1e4 * (u - gap)).epsilon(1e-9));
    }
  }
}

TEST_CASE("smooth grains that touch or overlap from the start: a step says no_film until a thickness is given") {
  wet_contact<> flat = wet;
  flat.asperity_height = 0;
  wet_contact<> soft = wet;
  soft.asperity_stiffness = 0;
  for (const auto& law : {flat, soft}) {
    for (const double gap : {0.0, -2e-6}) {
      const edge<double> e{1e-3, 1e-3, gap, up};
      auto state = law.start(e);
      const auto f = law.step(e, {}, 1e-6, state);
      CHECK(f.reason == contact_status::no_film);
      CHECK(f.kind() == verdict::refused);
      CHECK(std::isnan(f.value.pull));
      CHECK(state.thickness == 0);
      CHECK(law.step({1e-3, 1e-3, not_a_number, up}, {}, 1e-6, state).reason == contact_status::invalid_input);
      state = law.start(e, 1e-8);
      CHECK(law.step(e, {}, 1e-6, state).ok());
      CHECK(state.thickness > 0);
    }
  }
  auto state = wet.start(edge<double>{1e-3, 1e-3, not_a_number, up});
  CHECK(wet.step(close_pair, {}, 1e-6, state).reason == contact_status::invalid_input);
}

TEST_CASE("a wet contact held by friction does not slide; without asperities it creeps as a Maxwell element") {
  edge<double> e{1e-3, 1e-3, -2e-6, up};
  wet_contact<> law = wet;
  auto state = law.start(e, 1e-7);
  const pair_motion<double> nudge{{}, {}, {1e-4, 0, 0}, {}};
  auto f = law.step(e, nudge, 1e-4, state);
  CHECK(f.value.asperities > 0);
  CHECK(!f.value.sliding);
  CHECK(f.value.shear.x == doctest::Approx(8e3 * 1e-8).epsilon(1e-12));
  const double held = f.value.shear.x;
  for (int k = 0; k < 10; ++k) {
    f = law.step(e, {}, 1e-4, state);
  }
  CHECK(f.value.shear.x == doctest::Approx(held).epsilon(1e-12));

  law.asperity_height = 0;
  e.gap = 1e-6;
  state = law.start(e);
  f = law.step(e, nudge, 1e-9, state);
  // f' = k_s v − f k_s/S: after many times S/k_s the drag of the film alone
  for (int k = 0; k < 100; ++k) {
    f = law.step(e, nudge, 1e-7, state);
  }
  const auto r = law.film.resistance(e).value;
  CHECK(f.value.shear.x == doctest::Approx(r.shear * 1e-4).epsilon(1e-9));
  CHECK(f.value.sliding);
}
