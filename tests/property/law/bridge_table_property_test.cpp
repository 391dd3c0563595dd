// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/law/bridge/table.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

using namespace tetrapore;

namespace {

/// A law with a fold of known place: the table must not need Young and Laplace to be right.
struct folding_law {
  double tension = 1;
  bridge_status beyond = bridge_status::ruptured;

  struct limit {
    double gap;
  };

  static double reduced_gap(double v) { return std::cbrt(v) * (1 + 0.1 * std::cbrt(v)); }

  [[nodiscard]] outcome<bridge_pull<double>, bridge_status> bridge(const edge<double>& e,
                                                                   given_volume<double> liquid) const noexcept {
    const double radius = detail::derjaguin_radius(e);
    const double v = liquid.value / (radius * radius * radius);
    const double gap = e.gap / radius;
    const double rest = 1 - gap / reduced_gap(v);
    if (!(rest >= 0)) {
      return detail::no_pull<double>(beyond);
    }
    const double s = gap / (2 * std::sqrt(v));
    const double f = s > -0.1 ? 1 / (1 + (2.1 + 10 * s) * s) : 1.2 - 2 * s;  // any law: overlaps go their own way
    return {{2 * pi<double> * radius * tension * (f + 0.09 * (std::sqrt(rest) - 1))}, bridge_status::ok};
  }
  [[nodiscard]] outcome<limit, bridge_status> rupture_gap(const edge<double>& e,
                                                          given_volume<double> liquid) const noexcept {
    const double radius = detail::derjaguin_radius(e);
    return {{radius * reduced_gap(liquid.value / (radius * radius * radius))}, bridge_status::ok};
  }
};
static_assert(tabulable<folding_law>);

/// The same with liquid that slides to one side before the bridge folds, from a volume on or up to it.
struct sliding_law {
  static constexpr double turn = 0.0097;  // v = V/R³ where it begins
  bool with_much = true;

  [[nodiscard]] double widest(double v) const {
    const double x = std::log(v / turn);
    return folding_law::reduced_gap(v) * (1 - ((x > 0) == with_much ? 0.02 * x * x : 0));
  }
  [[nodiscard]] outcome<bridge_pull<double>, bridge_status> bridge(const edge<double>& e,
                                                                   given_volume<double> liquid) const noexcept {
    const double radius = detail::derjaguin_radius(e);
    const double v = liquid.value / (radius * radius * radius);
    const bool slides = (v > turn) == with_much;
    return slides && e.gap > radius * widest(v) ? detail::no_pull<double>(bridge_status::lopsided)
                                                : folding_law{}.bridge(e, liquid);
  }
  [[nodiscard]] outcome<folding_law::limit, bridge_status> rupture_gap(const edge<double>& e,
                                                                       given_volume<double> liquid) const noexcept {
    const double radius = detail::derjaguin_radius(e);
    return {{radius * widest(liquid.value / (radius * radius * radius))}, bridge_status::ok};
  }
};
static_assert(tabulable<sliding_law>);

/// The same where a plane may be the first surface: then its sphere is wetted less.
struct one_sided_law {
  double of_plane_first = 1;

  [[nodiscard]] static edge<double> plane_last(const edge<double>& e) noexcept {
    return e.radius1 < infinity<double> ? e : edge<double>{e.radius2, e.radius1, e.gap, e.normal};
  }
  [[nodiscard]] outcome<bridge_pull<double>, bridge_status> bridge(const edge<double>& e,
                                                                   given_volume<double> liquid) const noexcept {
    auto a = folding_law{}.bridge(plane_last(e), liquid);
    a.value.force *= e.radius1 < infinity<double> ? 1 : of_plane_first;
    return a;
  }
  [[nodiscard]] outcome<folding_law::limit, bridge_status> rupture_gap(const edge<double>& e,
                                                                       given_volume<double> liquid) const noexcept {
    return folding_law{}.rupture_gap(plane_last(e), liquid);
  }
};
static_assert(tabulable<one_sided_law>);

using table_10 = bridge_table<10>;
using look_up = tabulated<table_10>;

/// One table for the tests: equal spheres of radius 2, v = V/R³ from 1e-4 to 0.09.
const table_10& table() {
  static const auto made = [] {
    auto t = std::make_unique<table_10>();
    const table_report r =
        t->build(folding_law{}, {.radius1 = 2.0, .radius2 = 2.0, .least_volume = 8e-4, .largest_volume = 0.72});
    CHECK(r.reason == bridge_status::ok);
    CHECK(r.error < 1e-6);
    CHECK(r.rupture_error < 1e-10);
    return t;
  }();
  return *made;
}

edge<double> pair_of(double radius1, double radius2, double gap) { return {radius1, radius2, gap, {0, 0, 1}}; }

}  // namespace

TEST_CASE("the table keeps its measured error between its nodes, up to 1e-9 of the rupture gap") {
  auto t = std::make_unique<table_10>();
  const table_report report =
      t->build(folding_law{}, {.radius1 = 2.0, .radius2 = 2.0, .least_volume = 8e-4, .largest_volume = 0.72});
  REQUIRE(report.reason == bridge_status::ok);
  const look_up law{t.get()};
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    const given_volume<double> liquid{8e-4 * std::pow(900, uniform(random)) * (1 - 1e-12)};
    if (liquid.value < 8e-4) {
      continue;
    }
    const double rupture = folding_law{}.rupture_gap(pair_of(2, 2, 0), liquid).value.gap;
    const double u = uniform(random);
    const double rest = uniform(random) < 0.3 ? std::pow(10, -9 * u) : u;
    const auto e = pair_of(2, 2, rupture * (1 - rest));
    const auto a = law.bridge(e, liquid);
    REQUIRE(a.ok());
    worst = std::max(worst, std::abs(a.value.force - folding_law{}.bridge(e, liquid).value.force));
  }
  const double largest = 4 * pi<double>;
  CHECK(worst / largest < 1.5 * report.error);
  MESSAGE("stated " << report.error << ", worst of 100,000 " << worst / largest);
}

TEST_CASE("the table does not jump from cell to cell") {
  const look_up law{&table()};
  const auto force = [&](double gap, double volume) {
    const auto a = law.bridge(pair_of(2, 2, gap), given_volume<double>{volume});
    REQUIRE(a.ok());
    return a.value.force;
  };
  double jump = 0;
  for (int k = 1; k < 36; ++k) {  // the ends of the rows
    const double volume = 8e-4 * std::ldexp(1 + (k % 4) * 0.25, k / 4);
    for (const double part : {0.0, 0.1, 0.5, 0.9, 0.99}) {
      const double gap = part * 2 * folding_law::reduced_gap(volume / 8);
      jump = std::max(jump, std::abs(force(gap, volume * (1 + 1e-14)) - force(gap, volume * (1 - 1e-14))));
    }
  }
  for (int k = 0; k < 200000; ++k) {  // no step along the gap steeper than the law
    const double gap = 2e-6 * k * folding_law::reduced_gap(0.01 / 8) * 4.9;
    jump = std::max(jump, force(gap, 0.01) - force(gap * (1 - 1e-13), 0.01));
  }
  CHECK(jump < 1e-10);
}

TEST_CASE("the table holds for pairs of its shape at any size, from either end") {
  auto t = std::make_unique<table_10>();
  const table_report report =
      t->build(folding_law{}, {.radius1 = 2.0, .radius2 = 1.0, .least_volume = 1e-3, .largest_volume = 0.5});
  REQUIRE(report.reason == bridge_status::ok);
  const look_up law{t.get()};
  const auto one = law.bridge(pair_of(2, 1, 0.03), given_volume<double>{0.02});
  REQUIRE(one.ok());
  CHECK(law.bridge(pair_of(1, 2, 0.03), given_volume<double>{0.02}).value.force ==
        doctest::Approx(one.value.force).epsilon(1e-14));
  CHECK(law.bridge(pair_of(2e-3, 1e-3, 3e-5), given_volume<double>{2e-11}).value.force ==
        doctest::Approx(1e-3 * one.value.force).epsilon(1e-12));
  CHECK(law.bridge(pair_of(2, 1.001, 0.03), given_volume<double>{0.02}).reason == bridge_status::not_covered);
  CHECK(law.bridge(pair_of(2, infinity<double>, 0.03), given_volume<double>{0.02}).reason ==
        bridge_status::not_covered);
  const edge<float> small{2.0F, 1.0F, 0.03F, {}};
  CHECK(law.bridge(small, given_volume<float>{0.02F}).value.force == doctest::Approx(one.value.force).epsilon(1e-5));
}

TEST_CASE("a table of a sphere before a plane answers for planes alone") {
  auto t = std::make_unique<table_10>();
  const table_report report = t->build(
      folding_law{}, {.radius1 = 1.0, .radius2 = infinity<double>, .least_volume = 1e-3, .largest_volume = 0.5});
  REQUIRE(report.reason == bridge_status::ok);
  const look_up law{t.get()};
  const auto e = pair_of(1, infinity<double>, 0.05);
  CHECK(law.bridge(e, given_volume<double>{0.02}).value.force ==
        doctest::Approx(folding_law{}.bridge(e, given_volume<double>{0.02}).value.force).epsilon(1e-5));
  CHECK(law.bridge(pair_of(1, 1e6, 0.05), given_volume<double>{0.02}).reason == bridge_status::not_covered);
}

TEST_CASE("outside of the table each way out has its status") {
  const look_up law{&table()};
  const double nan = quiet_nan<double>;
  const auto reason = [&](double r1, double r2, double gap, double volume) {
    const auto a = law.bridge(pair_of(r1, r2, gap), given_volume<double>{volume});
    CHECK((a.kind() == verdict::absent ? a.value.force == 0 : a.ok() || std::isnan(a.value.force)));
    return a.reason;
  };
  CHECK(reason(2, 2, 0.01, 0.01) == bridge_status::ok);
  CHECK(reason(2, 2, 0.01, 0) == bridge_status::no_liquid);
  CHECK(reason(2, 2, 0.01, 7.9e-4) == bridge_status::not_covered);
  CHECK(reason(2, 2, 0.01, 1.0) == bridge_status::not_covered);
  CHECK(reason(2, 2, 0.5, 0.01) == bridge_status::ruptured);
  CHECK(reason(2, 2, -0.01, 0.01) == bridge_status::not_covered);
  CHECK(reason(2, 2, -2, 0.01) == bridge_status::invalid_input);
  CHECK(reason(2, 2, nan, 0.01) == bridge_status::invalid_input);
  CHECK(reason(2, 2, infinity<double>, 0.01) == bridge_status::invalid_input);
  for (const double bad : {nan, -1.0, infinity<double>}) {
    CHECK(reason(2, 2, 0.01, bad) == bridge_status::invalid_input);
  }
  for (const double bad : {nan, 0.0, -2.0}) {
    CHECK(reason(bad, 2, 0.01, 0.01) == bridge_status::invalid_input);
    CHECK(reason(2, bad, 0.01, 0.01) == bridge_status::invalid_input);
  }
}

TEST_CASE("beyond the rupture gap the table says what its law says") {
  auto t = std::make_unique<table_10>();
  REQUIRE(t->build(folding_law{1, bridge_status::lopsided},
                   {.radius1 = 1.0, .radius2 = 1.0, .least_volume = 1e-3, .largest_volume = 0.1})
              .reason == bridge_status::ok);
  CHECK(look_up{t.get()}.bridge(pair_of(1, 1, 0.3), given_volume<double>{0.01}).reason == bridge_status::lopsided);
}

TEST_CASE("where sliding liquid and the fold meet the table keeps its error, and tells one end from the other") {
  for (const bool with_much : {true, false}) {
    CAPTURE(with_much);
    const sliding_law exact{with_much};
    auto t = std::make_unique<table_10>();
    const table_report report =
        t->build(exact, {.radius1 = 1.0, .radius2 = 1.0, .least_volume = 1e-3, .largest_volume = 0.1});
    REQUIRE(report.reason == bridge_status::ok);
    CHECK(report.error < 1e-6);
    CHECK(report.rupture_error < 1e-9);
    const look_up law{t.get()};
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> uniform(0, 1);
    double worst = 0;
    for (int i = 0; i < 20000; ++i) {
      const double part = 2 * uniform(random) - 1;
      const double near = i % 2 == 0 ? std::pow(10, -8 * uniform(random)) : 1;
      const double v = sliding_law::turn * std::exp(2.2 * part * near);
      const given_volume<double> liquid{v};
      const double u = uniform(random);
      const double rest = i % 3 == 0 ? std::pow(10, -7 * u) : u;
      const auto e = pair_of(1, 1, exact.widest(v) * (1 - rest));
      const auto a = law.bridge(e, liquid);
      REQUIRE(a.ok());
      worst = std::max(worst, std::abs(a.value.force - exact.bridge(e, liquid).value.force) / (2 * pi<double>));
      const auto wider = pair_of(1, 1, exact.widest(v) * (1 + 1e-8));
      CHECK(law.bridge(wider, liquid).reason == exact.bridge(wider, liquid).reason);
    }
    CHECK(worst < 1.5 * report.error);
    MESSAGE("stated " << report.error << ", worst of 20,000 " << worst);
  }
}

TEST_CASE("a plane may be the first surface: the same bridge seen from its other end") {
  const given_volume<double> liquid{0.02};
  const auto before = pair_of(1, infinity<double>, 0.05);
  const auto behind = pair_of(infinity<double>, 1, 0.05);
  auto t = std::make_unique<table_10>();
  const look_up law{t.get()};
  for (const double of_plane_first : {1.0, 0.5}) {
    const one_sided_law exact{of_plane_first};
    const bool same = of_plane_first == 1;
    for (const bool built_first : {false, true}) {
      CAPTURE(built_first);
      const double one = built_first ? infinity<double> : 1;
      const double two = built_first ? 1 : infinity<double>;
      REQUIRE(t->build(exact, {.radius1 = one, .radius2 = two, .least_volume = 1e-3, .largest_volume = 0.5}).reason ==
              bridge_status::ok);
      const auto straight = law.bridge(built_first ? behind : before, liquid);
      CHECK(straight.value.force ==
            doctest::Approx(exact.bridge(built_first ? behind : before, liquid).value.force).epsilon(1e-6));
      const auto turned = law.bridge(built_first ? before : behind, liquid);
      CHECK(turned.reason == (same ? bridge_status::ok : bridge_status::not_covered));
      CHECK((same ? turned.value.force == straight.value.force : std::isnan(turned.value.force)));
      CHECK(law.bridge(pair_of(infinity<double>, infinity<double>, 0.05), liquid).reason ==
            bridge_status::invalid_input);
      CHECK(law.bridge(pair_of(1, 1, 0.05), liquid).reason == bridge_status::not_covered);
      CHECK(law.bridge(pair_of(one, two, -1), liquid).reason == bridge_status::invalid_input);
      CHECK(law.bridge(pair_of(one, two, -0.1), liquid).reason == bridge_status::not_covered);
    }
  }
}

TEST_CASE("radii in float belong to the ratio that they round, those in double to theirs alone") {
  auto t = std::make_unique<table_10>();
  REQUIRE(
      t->build(folding_law{}, {.radius1 = 0.3, .radius2 = 0.1, .least_volume = 1e-5, .largest_volume = 1e-3}).reason ==
      bridge_status::ok);
  const look_up law{t.get()};
  const auto exact = law.bridge(pair_of(0.3, 0.1, 0.003), given_volume<double>{1e-4});
  REQUIRE(exact.ok());
  for (const edge<float>& e : {edge<float>{0.3F, 0.1F, 0.003F, {}}, edge<float>{0.1F, 0.3F, 0.003F, {}}}) {
    const auto a = law.bridge(e, given_volume<float>{1e-4F});
    REQUIRE(a.ok());
    CHECK(a.value.force == doctest::Approx(exact.value.force).epsilon(1e-5));
  }
  CHECK(law.bridge(pair_of(0.3, 0.1 * (1 + 1e-8), 0.003), given_volume<double>{1e-4}).reason ==
        bridge_status::not_covered);
}

TEST_CASE("every scalar gets the status of its input") {
  const look_up law{&table()};
  const auto check = [&](auto zero) {
    using T = decltype(zero);
    const auto reason = [&](T radius, T gap, T volume) {
      const auto a = law.bridge(edge<T>{radius, radius, gap, {}}, given_volume<T>{volume});
      CHECK((a.ok()                        ? a.value.force > 0
             : a.kind() == verdict::absent ? a.value.force == 0
                                           : a.value.force != a.value.force));
      return a.reason;
    };
    const T nan = quiet_nan<T>;
    const T inf = infinity<T>;
    CHECK(reason(T(2), T(0.01), T(0.01)) == bridge_status::ok);
    CHECK(reason(T(2), T(1), T(0.01)) == bridge_status::ruptured);
    CHECK(reason(T(2), T(0.01), T(0)) == bridge_status::no_liquid);
    CHECK(reason(T(2), T(0.01), T(5)) == bridge_status::not_covered);
    for (const T bad : {nan, inf, -inf}) {
      CHECK(reason(T(2), bad, T(0.01)) == bridge_status::invalid_input);
      CHECK(reason(T(2), T(0.01), bad) == bridge_status::invalid_input);
      CHECK(reason(bad, T(0.01), T(0.01)) == bridge_status::invalid_input);
    }
  };
  check(0.0F);
  check(0.0);
  check(0.0L);
}

TEST_CASE("an empty table covers nothing, and a refused build leaves it empty") {
  auto t = std::make_unique<table_10>();
  const look_up law{t.get()};
  const given_volume<double> liquid{0.01};
  CHECK(law.bridge(pair_of(1, 1, 0.01), liquid).reason == bridge_status::not_covered);
  const auto reason = [&](double r1, double r2, double least, double largest, double overlap) {
    return t->build(folding_law{}, {r1, r2, least, largest, overlap}).reason;
  };
  CHECK(reason(1, 1, 1e-3, 1.1, 0) == bridge_status::not_covered);  // more than 10 octaves
  CHECK(reason(1, 1, 0, 1, 0) == bridge_status::invalid_input);
  CHECK(reason(1, 1, 1e-3, 1e-4, 0) == bridge_status::invalid_input);
  CHECK(reason(-1, 1, 1e-3, 1e-2, 0) == bridge_status::invalid_input);
  CHECK(reason(1, quiet_nan<double>, 1e-3, 1e-2, 0) == bridge_status::invalid_input);
  CHECK(reason(1, 1, 1e-3, infinity<double>, 0) == bridge_status::invalid_input);
  CHECK(reason(1, 1, 1e-3, 1e-2, -0.1) == bridge_status::invalid_input);
  CHECK(reason(1, 1, 1e-3, 1e-2, 1) == bridge_status::invalid_input);
  CHECK(law.bridge(pair_of(1, 1, 0.01), liquid).reason == bridge_status::not_covered);
}
