// SPDX-License-Identifier: BSD-3-Clause
#include "support/condition.hpp"
#include "support/openings.hpp"
#include "support/shared_data.hpp"
#include "tetrapore/law/entry.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace openings;

namespace {

double error_of(double computed, double truth) { return std::abs(computed / truth - 1); }

mayer_stowe_princen at(double degrees_of_contact) {
  return {.surface_tension = 1.0, .contact_angle = degrees(degrees_of_contact)};
}

opening<double> shape(const std::string& name) {
  const auto sides = [&] {
    return static_cast<std::size_t>(std::atoi(name.c_str() + (name.rfind("reg", 0) == 0 ? 8 : 0)));
  };
  if (name.rfind("regular_", 0) == 0) {
    return regular_polygon(sides(), 1.0).value;
  }
  if (name == "2_touching_rods_on_plate") {
    return two_discs_on_plate(1.0, 0.0).value;
  }
  if (name.rfind("3_rods_equal_gap_", 0) == 0) {
    return ring_of_discs(3, 1.0, std::atof(name.c_str() + 17)).value;
  }
  return ring_of_discs(sides(), 1.0, 0.0).value;
}

}  // namespace

TEST_CASE("every row of open_msp.csv has its status, and its curvature to 1e-10") {
  const csv_table t(test_file("truth/open_msp.csv"));
  REQUIRE(t.size() == 312);
  double worst = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    CAPTURE(i);
    const auto o = from_row(t, i);
    REQUIRE(o.ok());
    const auto law = at(t.number(i, "theta_deg"));
    const auto answer = law.entry_pressure(o.value);
    CHECK(name_of(answer.reason) == t.text(i, "status"));
    const double least = t.number(i, "r_gap_min");
    const auto limit = law.first_arc_lost(o.value);
    CHECK(limit.ok());
    CHECK(std::abs(1 / limit.value.pressure - least) <= 1e-14 * (1 + least));
    if (answer.ok()) {
      const bool near_limit = std::abs(t.number(i, "r_msp") / least - 1) < 1e-4;
      const double e = error_of(answer.value, t.number(i, "C_msp"));
      CHECK(e < (near_limit ? 5e-9 : 1e-10));
      CHECK(e <= mayer_stowe_princen::stated_accuracy * condition(law, o.value));
      worst = std::max(worst, e);
      const auto m = law.meniscus(o.value);
      CHECK(m.reason == answer.reason);
      CHECK(error_of(m.value.radius, t.number(i, "r_msp")) < (near_limit ? 5e-9 : 1e-10));
      CHECK(error_of(m.value.area, t.number(i, "A_nw")) < 5e-9);
      CHECK(error_of(m.value.wetted_length, t.number(i, "L_ns")) < 5e-9);
      CHECK(std::abs(m.value.meniscus_length - t.number(i, "L_nw")) < 5e-9 * t.number(i, "L_ns"));
    } else {
      CHECK(std::isnan(answer.value) != (answer.reason == entry_status::closed));
    }
    if (answer.reason == entry_status::closed) {
      CHECK(answer.value == infinity<double>);
    }
  }
  MESSAGE("worst relative error of the curvature: " << worst);
}

TEST_CASE("the inscribed circle has the radius of open_msp.csv where it is positive") {
  const csv_table t(test_file("truth/open_msp.csv"));
  for (std::size_t i = 0; i < t.size(); ++i) {
    CAPTURE(i);
    const auto o = from_row(t, i);
    const double r = t.number(i, "r_ins");
    const inscribed_circle law{.surface_tension = 0.5};
    const auto answer = law.entry_pressure(o.value);
    if (r > 0) {
      CHECK(answer.ok());
      CHECK(error_of(1 / answer.value, r) <= inscribed_circle::stated_accuracy * condition(law, o.value));
    } else {
      CHECK(answer.reason == (r < 0 ? entry_status::closed : entry_status::no_hole));
    }
  }
}

TEST_CASE("closed_forms.csv: polygons, rings of rods and rods on a plate of 3 to 8 sides to 1e-13") {
  const csv_table t(test_file("truth/closed_forms.csv"));
  std::size_t checked = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const std::string name = t.text(i, "shape");
    if (name == "circle" || name == "regular_12_gon") {
      continue;  // no opening of 3 to 8 sides
    }
    CAPTURE(name);
    CAPTURE(t.number(i, "theta_deg"));
    const auto o = shape(name);
    const auto answer = at(t.number(i, "theta_deg")).entry_pressure(o);
    ++checked;
    if (t.text(i, "C_msp") == "nan") {
      CHECK(answer.reason == entry_status::gap_limited);
      continue;
    }
    const double near_limit = name == "3_rods_equal_gap_0.585" ? 100 : 1;
    CHECK(answer.ok());
    CHECK(error_of(answer.value, t.number(i, "C_msp")) < 1e-13 * near_limit);
    if (o.count == 3) {
      const auto inscribed =
          inscribed_circle{.surface_tension = 1.0, .contact_angle = degrees(t.number(i, "theta_deg"))}.entry_pressure(
              o);
      const double factor = name.rfind("regular", 0) == 0 ? 1.0 : std::cos(degrees(t.number(i, "theta_deg")));
      CHECK(error_of(inscribed.value, t.number(i, "C_inscribed_2_over_r") * factor) < 1e-13);
    }
  }
  CHECK(checked == 97);
}

TEST_CASE("slivers 1:1:x down to 1e-5, and dry corners, agree with 40 digits to 1e-10") {
  const csv_table t(test_file("truth/entry_hard.csv"));
  REQUIRE(t.size() == 44);
  for (std::size_t i = 0; i < t.size(); ++i) {
    CAPTURE(i);
    const auto o = from_row(t, i);
    const auto law = at(t.number(i, "theta_deg"));
    const auto answer = law.entry_pressure(o.value);
    const bool sliver = t.text(i, "category") == "sliver";
    CHECK(name_of(answer.reason) == (sliver ? "ok" : "dry_corner"));
    CHECK(error_of(answer.value, t.number(i, "C")) < (sliver ? 1e-10 : 1e-12));
    const auto m = law.meniscus(o.value);
    CHECK(error_of(m.value.area, t.number(i, "A_nw")) < 1e-9);
    CHECK(error_of(m.value.wetted_length, t.number(i, "L_ns")) < 1e-9);
    CHECK(std::abs(m.value.meniscus_length - t.number(i, "L_nw")) < 1e-9 * t.number(i, "L_ns"));
  }
}

TEST_CASE("rings of 3 to 8 discs and lines agree with the erosion form in 40 digits to 1e-12") {
  const csv_table t(test_file("truth/entry_rings.csv"));
  REQUIRE(t.size() > 100);
  for (std::size_t i = 0; i < t.size(); ++i) {
    CAPTURE(i);
    CAPTURE(t.text(i, "category"));
    const auto answer = at(t.number(i, "theta_deg")).entry_pressure(from_sides(t.text(i, "sides")));
    CHECK(name_of(answer.reason) == "ok");
    CHECK(error_of(answer.value, t.number(i, "C")) < 1e-12);
  }
}

TEST_CASE("se_results.csv: both plane branches to the table's digits, and mirror_sided takes the lesser") {
  const csv_table t(test_file("truth/se_results.csv"));
  for (std::size_t i = 0; i < t.size(); ++i) {
    CAPTURE(i);
    const double gap = t.number(i, "gap_over_R");
    const auto law = at(t.number(i, "theta_deg"));
    const double msp = law.entry_pressure(ring_of_discs(3, 1.0, gap).value).value;
    const double open = law.entry_pressure(ring_of_discs(3, 1.0, gap, gap_state::open).value).value;
    const auto half_unit = [&](const char* column) {
      const std::string digits = t.text(i, column);
      const auto dot = digits.find('.');
      return 0.6 * std::pow(10.0, -static_cast<double>(digits.size() - dot - 1));
    };
    CHECK(std::abs(msp - t.number(i, "C_msp_2D")) < half_unit("C_msp_2D"));
    CHECK(std::abs(open - t.number(i, "C_open_2D")) < half_unit("C_open_2D"));
    const auto both = mirror_sided{law}.entry_pressure(ring_of_discs(3, 1.0, gap).value);
    CHECK(both.ok());
    CHECK(both.value <= std::min(msp, gap > 0 ? open : msp));
    // The table took the lesser of the two extremes; a single open gap between them is never lower for equal gaps.
    CHECK(both.value == doctest::Approx(std::min(msp, gap > 0 ? open : msp)).epsilon(1e-12));
    CHECK(t.number(i, "C3D_over_best2D") == doctest::Approx(t.number(i, "C3D_estimate") / both.value).epsilon(0.006));
  }
}
