// SPDX-License-Identifier: BSD-3-Clause
#include "support/csv_table.hpp"
#include "support/shared_data.hpp"
#include "tetrapore/law/bridge/table.hpp"
#include "tetrapore/law/bridge/young_laplace.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

using namespace tetrapore;

namespace {

constexpr double degree = pi<double> / 180;
using table_8 = bridge_table<8>;

struct material {
  double radius2, angle1, angle2, overlap;
};

}  // namespace

// At 30° the bridges of little liquid end at a fold and those of much liquid lopsided, right before it; those of a pair
// that is not quite equal always at a fold, but right before it they bend as if they were to go lopsided.
TEST_CASE("a table of exact bridges is built to 1e-6 of the largest force, and keeps its error between its nodes") {
  for (const material& m : {material{1, 0, 0, 0}, material{1, 0, 0, 0.01}, material{1, 30, 30, 0},
                            material{1, 45, 45, 0}, material{0.99, 30, 30, 0}, material{0.999, 40, 40, 0},
                            material{0.5, 0, 0, 0}, material{infinity<double>, 10, 10, 0}, material{1, 20, 50, 0}}) {
    CAPTURE(m.radius2);
    CAPTURE(m.angle1);
    CAPTURE(m.angle2);
    const young_laplace<> exact{1.0, m.angle1 * degree, m.angle2 * degree};
    auto t = std::make_unique<table_8>();
    const table_report report = t->build(exact, {.radius1 = 1.0,
                                                 .radius2 = m.radius2,
                                                 .least_volume = 4e-4,
                                                 .largest_volume = 0.1,
                                                 .deepest_overlap = m.overlap});
    REQUIRE(report.reason == bridge_status::ok);
    CHECK(report.error < 1e-6);
    CHECK(report.rupture_error < 1e-10);
    const tabulated<table_8> law{t.get()};
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> uniform(0, 1);
    const double largest =
        exact.bridge(edge<double>{1, m.radius2, -m.overlap, {}}, given_volume<double>{4e-4}).value.force;
    double worst = 0;
    for (int i = 0; i < 1000; ++i) {
      const given_volume<double> liquid{4e-4 * std::pow(250, 0.999999 * uniform(random))};
      edge<double> e{1, m.radius2, 0, {0, 0, 1}};
      const auto limit = exact.rupture_gap(e, liquid);
      REQUIRE(limit.ok());
      const double u = uniform(random);
      const double rest = i % 4 == 0 ? std::pow(10, -7 * u) : u;
      e.gap = i % 4 == 1 ? -m.overlap * u : limit.value.gap * (1 - rest);
      const auto a = law.bridge(e, liquid);
      const auto b = exact.bridge(e, liquid);
      REQUIRE(b.ok());
      REQUIRE(a.ok());
      worst = std::max(worst, std::abs(a.value.force - b.value.force) / largest);
      e.gap = limit.value.gap * (1 + 1e-9);
      const auto beyond = law.bridge(e, liquid);
      CHECK(beyond.kind() == verdict::absent);
      CHECK(beyond.value.force == 0);
    }
    CHECK(worst < 1.3 * report.error);
    MESSAGE("stated " << report.error << ", worst of 1,000 " << worst);
  }
}

TEST_CASE("a table around each stable row of a volume in open_bridge.csv answers it to 1e-6") {
  const csv_table t(test_file("truth/open_bridge.csv"));
  double worst = 0;
  double worst_stated = 0;
  int rows = 0;
  auto table = std::make_unique<bridge_table<1>>();
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t.text(i, "control") != "V" || t.text(i, "stable_V") != "1") {
      continue;
    }
    CAPTURE(i);
    const double volume = t.number(i, "V");
    const double gap = t.number(i, "D");
    const double radius2 = t.text(i, "R2") == "inf" ? infinity<double> : t.number(i, "R2");
    const auto report =
        table->build(young_laplace<>{1.0, t.number(i, "theta1_deg") * degree, t.number(i, "theta2_deg") * degree},
                     {.radius1 = 1.0,
                      .radius2 = radius2,
                      .least_volume = volume / 1.1,
                      .largest_volume = volume * 1.1,
                      .deepest_overlap = gap < 0 ? -1.001 * gap : 0});
    CHECK(report.reason == bridge_status::ok);
    CHECK(report.error < 1e-6);
    if (report.reason != bridge_status::ok) {
      continue;
    }
    const edge<double> e{1, radius2, gap, {0, 0, 1}};
    const auto a = tabulated<bridge_table<1>>{table.get()}.bridge(e, given_volume<double>{volume});
    CHECK(a.ok());
    const double off = std::abs(a.value.force - t.number(i, "F")) / (2 * pi<double> * detail::derjaguin_radius(e));
    CHECK(off < 1e-6);
    worst = std::max(worst, off);
    worst_stated = std::max(worst_stated, report.error);
    ++rows;
  }
  CHECK(rows == 221);
  MESSAGE("worst of " << rows << " rows: " << worst << " of 2 pi R sigma, stated by their tables " << worst_stated);
}

TEST_CASE("a table of a million to one in volume is built for any contact angle") {
  auto t = std::make_unique<bridge_table<>>();
  for (const double angle : {0.0, 28.5, 30.0, 31.0, 60.0}) {
    CAPTURE(angle);
    const table_report report = t->build(
        young_laplace<>{1.0, angle * degree, angle * degree},
        {.radius1 = 1.0, .radius2 = 1.0, .least_volume = 1e-6, .largest_volume = 0.5, .deepest_overlap = 1e-4});
    CHECK(report.reason == bridge_status::ok);
    CHECK(report.error < 1e-6);
    CHECK(report.rupture_error < 1e-10);
  }
}

TEST_CASE("next to the volume where bridges begin to go lopsided the table keeps 1e-6, and knows which end it is") {
  const young_laplace<> exact{1.0, 30 * degree, 30 * degree};
  const auto end_of = [&](double volume) {
    const auto limit = exact.rupture_gap(edge<double>{1, 1, 0, {}}, given_volume<double>{volume});
    REQUIRE(limit.ok());
    return limit.value;
  };
  double folds = 0.005;
  double slides = 0.02;
  while (slides - folds > 1e-9 * folds) {
    const double middle = (folds + slides) / 2;
    (end_of(middle).end == bridge_end::fold ? folds : slides) = middle;
  }
  auto t = std::make_unique<table_8>();
  REQUIRE(t->build(exact, {.radius1 = 1.0, .radius2 = 1.0, .least_volume = 4e-4, .largest_volume = 0.1}).reason ==
          bridge_status::ok);
  const tabulated<table_8> law{t.get()};
  double worst = 0;
  for (const double away : {1e-6, 1e-4, 1e-3, 0.01, 0.03, 0.1}) {
    for (const double side : {-away, away}) {
      const given_volume<double> liquid{folds * (1 + side)};
      CAPTURE(liquid.value);
      const auto limit = end_of(liquid.value);
      for (const double rest : {1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1}) {
        const edge<double> e{1, 1, limit.gap * (1 - rest), {0, 0, 1}};
        const auto a = law.bridge(e, liquid);
        const auto b = exact.bridge(e, liquid);
        REQUIRE(a.ok());
        REQUIRE(b.ok());
        worst = std::max(worst, std::abs(a.value.force - b.value.force) / (2 * pi<double>));
      }
      const auto beyond = law.bridge(edge<double>{1, 1, limit.gap * (1 + 1e-9), {0, 0, 1}}, liquid).reason;
      CHECK(beyond == (side < 0 ? bridge_status::ruptured : bridge_status::lopsided));
    }
  }
  CHECK(worst < 1e-6);
  MESSAGE("worst " << worst);
}

TEST_CASE("asked in long double a table agrees with the exact law in long double to the error it states") {
  auto t = std::make_unique<table_8>();
  for (const double angle : {0.0, 30.0}) {
    for (const double radius2 : {1.0, 0.5, infinity<double>}) {
      CAPTURE(angle);
      CAPTURE(radius2);
      const young_laplace<20> exact{1.0, angle * degree, angle * degree};
      const table_report report =
          t->build(young_laplace<>{1.0, angle * degree, angle * degree},
                   {.radius1 = 1.0, .radius2 = radius2, .least_volume = 4e-4, .largest_volume = 0.1});
      REQUIRE(report.reason == bridge_status::ok);
      const tabulated<table_8> law{t.get()};
      const long double other = radius2;
      const long double largest =
          exact.bridge(edge<long double>{1, other, 0, {}}, given_volume<long double>{4e-4L}).value.force;
      std::mt19937_64 random(4);
      std::uniform_real_distribution<double> uniform(0, 1);
      long double worst = 0;
      for (int i = 0; i < 80; ++i) {
        const given_volume<long double> liquid{4e-4L * std::pow(250.0L, 0.999999L * uniform(random))};
        edge<long double> e{1, other, 0, {0, 0, 1}};
        e.gap = exact.rupture_gap(e, liquid).value.gap * (1 - static_cast<long double>(uniform(random)));
        const auto a = law.bridge(e, liquid);
        const auto b = exact.bridge(e, liquid);
        REQUIRE(a.ok());
        REQUIRE(b.ok());
        worst = std::max(worst, std::abs(a.value.force - b.value.force) / largest);
      }
      CHECK(worst < 1.3L * report.error);
    }
  }
}

TEST_CASE("a table of a plane and a sphere is the table of that sphere and the plane") {
  auto first = std::make_unique<table_8>();
  auto second = std::make_unique<table_8>();
  const given_volume<double> liquid{0.01};
  const auto build = [&](table_8& t, double one, double two, double angle1, double angle2) {
    return t.build(young_laplace<>{1.0, angle1 * degree, angle2 * degree},
                   {.radius1 = one, .radius2 = two, .least_volume = 4e-4, .largest_volume = 0.1});
  };
  const double plane = infinity<double>;
  for (const double of_plane : {20.0, 50.0}) {
    CAPTURE(of_plane);
    REQUIRE(build(*first, 1, plane, 20, of_plane).reason == bridge_status::ok);
    REQUIRE(build(*second, plane, 1, of_plane, 20).reason == bridge_status::ok);
    const edge<double> e{1, plane, 0.1, {0, 0, 1}};
    const edge<double> back{plane, 1, 0.1, {0, 0, -1}};
    const auto a = tabulated<table_8>{first.get()}.bridge(e, liquid);
    const auto b = tabulated<table_8>{second.get()}.bridge(back, liquid);
    REQUIRE(a.ok());
    REQUIRE(b.ok());
    CHECK(a.value.force == doctest::Approx(b.value.force).epsilon(1e-12));
    // from its other end the pair is the same if both of its angles are
    const bool same = of_plane == 20;
    const auto turned = tabulated<table_8>{first.get()}.bridge(back, liquid);
    CHECK(turned.reason == (same ? bridge_status::ok : bridge_status::not_covered));
    CHECK((same ? turned.value.force == a.value.force : std::isnan(turned.value.force)));
  }
}
