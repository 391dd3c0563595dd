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
  double bound = 1e-6;  ///< of the error over the largest force
  double rupture_bound = 1e-10;
};

}  // namespace

// At 30° the bridges of little liquid end at a fold and those of much liquid lopsided, right before it: where the one
// gives way to the other the force is not smooth in the volume, and the table states 1.2e-5.
TEST_CASE("a table of exact bridges is built to 1e-6 of the largest force, and keeps its error between its nodes") {
  for (const material& m :
       {material{1, 0, 0, 0}, material{1, 0, 0, 0.01}, material{1, 30, 30, 0, 2e-5, 1e-8}, material{1, 40, 40, 0},
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
    CHECK(report.error < m.bound);
    CHECK(report.rupture_error < m.rupture_bound);
    const tabulated<table_8> law{t.get()};
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> uniform(0, 1);
    const double largest =
        exact.bridge(edge<double>{1, m.radius2, -m.overlap, {}}, given_volume<double>{4e-4}).value.force;
    double worst = 0;
    for (int i = 0; i < 2000; ++i) {
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
    MESSAGE("stated " << report.error << ", worst of 2,000 " << worst);
  }
}

TEST_CASE("a table around each stable row of a volume in bridge_stable.csv answers it to 1e-6") {
  const csv_table t(test_file("truth/bridge_stable.csv"));
  double worst = 0;
  double worst_stated = 0;
  int rows = 0;
  auto table = std::make_unique<bridge_table<1>>();
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t.text(i, "control") != "V") {
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
