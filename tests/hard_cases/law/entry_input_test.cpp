// SPDX-License-Identifier: BSD-3-Clause
#include "support/openings.hpp"
#include "tetrapore/law/entry.hpp"

#include <doctest/doctest.h>

using namespace openings;

namespace {

const double not_a_number = quiet_nan<double>;
const double inf = infinity<double>;

opening<double> rods() { return ring_of_discs(3, 1.0, 0.1).value; }

template <class Law>
void check_all(const Law& law, const opening<double>& o, entry_status expected) {
  const auto answer = law.entry_pressure(o);
  CHECK(name_of(answer.reason) == name_of(expected));
  CHECK((answer.ok() || std::isnan(answer.value) || answer.value == inf));
}

}  // namespace

TEST_CASE("a surface tension or contact angle outside the domain is invalid_input") {
  for (const double tension : {0.0, -1.0, not_a_number, inf}) {
    check_all(mayer_stowe_princen{.surface_tension = tension}, rods(), entry_status::invalid_input);
    check_all(inscribed_circle{.surface_tension = tension}, rods(), entry_status::invalid_input);
    check_all(lost_arc{mayer_stowe_princen{.surface_tension = tension}}, rods(), entry_status::invalid_input);
    check_all(mirror_sided{mayer_stowe_princen{.surface_tension = tension}}, rods(), entry_status::invalid_input);
  }
  for (const double angle : {-0.1, pi<double> / 2, 2.0, not_a_number, inf}) {
    const mayer_stowe_princen law{.surface_tension = 1.0, .contact_angle = angle};
    check_all(law, rods(), entry_status::invalid_input);
    check_all(inscribed_circle{.surface_tension = 1.0, .contact_angle = angle}, rods(), entry_status::invalid_input);
    CHECK(law.first_arc_lost(rods()).reason == entry_status::invalid_input);
    CHECK(law.meniscus(rods()).reason == entry_status::invalid_input);
    CHECK(law.derivative(rods()).reason == entry_status::invalid_input);
  }
}

TEST_CASE("NaN, infinite, zero or negative numbers in an opening are invalid_input") {
  const mayer_stowe_princen msp{.surface_tension = 1.0};
  const inscribed_circle inscribed{.surface_tension = 1.0};
  for (std::size_t k = 0; k < 3; ++k) {
    for (const double bad : {not_a_number, inf, -inf}) {
      auto o = rods();
      o.sides[k].point.x = bad;
      check_all(msp, o, entry_status::invalid_input);
      check_all(inscribed, o, entry_status::invalid_input);
      o = rods();
      o.sides[k].point.y = bad;
      check_all(msp, o, entry_status::invalid_input);
      check_all(inscribed, o, entry_status::invalid_input);
      o = two_discs_on_plate(1.0, 0.1).value;
      o.sides[2].normal.x = bad;
      check_all(msp, o, entry_status::invalid_input);
      check_all(inscribed, o, entry_status::invalid_input);
    }
    for (const double bad : {not_a_number, inf, -inf, -1.0, 0.0}) {
      auto o = rods();
      o.sides[k].radius = bad;
      check_all(msp, o, entry_status::invalid_input);
      check_all(inscribed, o, entry_status::invalid_input);
      CHECK(msp.first_arc_lost(o).reason == entry_status::invalid_input);
    }
  }
  auto stretched = two_discs_on_plate(1.0, 0.1).value;
  stretched.sides[2].normal = {0, 2};
  check_all(msp, stretched, entry_status::invalid_input);
}

TEST_CASE("fewer than three or more than eight sides are invalid_input") {
  const mayer_stowe_princen msp{.surface_tension = 1.0};
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{9}}) {
    auto o = rods();
    o.count = count;
    check_all(msp, o, entry_status::invalid_input);
    check_all(lost_arc{msp}, o, entry_status::invalid_input);
    check_all(mirror_sided{msp}, o, entry_status::invalid_input);
    CHECK(msp.meniscus(o).reason == entry_status::invalid_input);
  }
  check_all(inscribed_circle{.surface_tension = 1.0}, ring_of_discs(4, 1.0, 0.1).value, entry_status::not_covered);
}

TEST_CASE("discs that cover their triangle are closed; without contact angle the pressure grows without bound before") {
  const mayer_stowe_princen msp{.surface_tension = 1.0};
  const double covers = std::sqrt(3.0) - 2;  // three equal discs meet in one point
  double last = 0;
  for (const double more : {1e-1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10}) {
    const auto answer = msp.entry_pressure(ring_of_discs(3, 1.0, covers + more).value);
    CHECK(answer.reason == entry_status::ok);
    CHECK(answer.value > last);
    CHECK(answer.value > 1 / more);
    last = answer.value;
  }
  for (const double less : {1e-9, 1e-2, 0.3}) {
    const auto answer = msp.entry_pressure(ring_of_discs(3, 1.0, covers - less).value);
    CHECK(answer.reason == entry_status::closed);
    CHECK(answer.value == inf);
    CHECK(msp.meniscus(ring_of_discs(3, 1.0, covers - less).value).value.area == 0);
  }
}

TEST_CASE("a disc inside another, coincident and collinear discs are no_hole") {
  const mayer_stowe_princen msp{.surface_tension = 1.0};
  auto inside = rods();
  inside.sides[1].radius = 0.01;
  inside.sides[1].point = inside.sides[0].point + vec2<double>{0.1, 0.0};
  check_all(msp, inside, entry_status::no_hole);
  inside.sides[1].point = inside.sides[0].point;
  check_all(msp, inside, entry_status::no_hole);
  opening<double> row;
  row.add_disc({0, 0}, 1);
  row.add_disc({2.1, 0}, 1);
  row.add_disc({4.3, 0}, 1);
  check_all(msp, row, entry_status::no_hole);
  check_all(inscribed_circle{.surface_tension = 1.0}, row, entry_status::no_hole);
  check_all(lost_arc{msp}, row, entry_status::lost_arc);
}

TEST_CASE(
    "gap_limited becomes lost_arc at 2 σ / gap for θ = 0, and the limit of equal rods is where the sheet has it") {
  const mayer_stowe_princen msp{.surface_tension = 1.0};
  const double limit = 0.58584625664443371;
  CHECK(msp.entry_pressure(ring_of_discs(3, 1.0, limit * (1 - 1e-12)).value).reason == entry_status::ok);
  const auto beyond = ring_of_discs(3, 1.0, limit * (1 + 1e-12)).value;
  CHECK(msp.entry_pressure(beyond).reason == entry_status::gap_limited);
  const auto arc = lost_arc{msp}.entry_pressure(beyond);
  CHECK(arc.reason == entry_status::lost_arc);
  CHECK(arc.value == doctest::Approx(2 / limit).epsilon(1e-11));
  // The value is continuous there.
  CHECK(msp.entry_pressure(ring_of_discs(3, 1.0, limit * (1 - 1e-12)).value).value ==
        doctest::Approx(arc.value).epsilon(1e-9));
}

TEST_CASE("touching everywhere, no gap ever loses its arc") {
  const mayer_stowe_princen msp{.surface_tension = 1.0};
  CHECK(msp.first_arc_lost(regular_polygon(5, 1.0).value).value.pressure == inf);
  const auto touching = msp.first_arc_lost(two_discs_on_plate(1.0, 0.0).value);
  CHECK(touching.ok());
  CHECK(touching.value.pressure == inf);
}

TEST_CASE("parallel walls that follow each other, and walls that meet in a ridge, are not covered") {
  const mayer_stowe_princen msp{.surface_tension = 1.0};
  opening<double> slot;
  slot.add_line({0, 0}, {0, 1});
  slot.add_line({0, 2}, {0, -1});
  slot.add_disc({-3, 1}, 1);
  check_all(msp, slot, entry_status::not_covered);
}

TEST_CASE("radii 1 : 1000 and openings as small as a nanometre or as large as a kilometre answer") {
  for (const double angle : {0.0, 0.7}) {
    const mayer_stowe_princen law{.surface_tension = 1.0, .contact_angle = angle};
    for (const double small : {1.0, 1e-3}) {
      const auto o = opening_from_distances(1.0, 1.0, small, 2.0, 1 + small, 1 + small).value;
      const auto one = law.entry_pressure(o);
      CHECK(one.ok());
      for (const double scale : {1e-9, 1e3, 1e-60, 1e60}) {
        CHECK(law.entry_pressure(scaled(o, scale)).value * scale == doctest::Approx(one.value).epsilon(1e-12));
      }
    }
  }
}

TEST_CASE("a side that the meniscus does not reach is left out of a ring") {
  // A pin deep in the corner between two of three rods: the four-sided ring has the pressure of the three.
  const mayer_stowe_princen msp{.surface_tension = 1.0};
  const auto three = ring_of_discs(3, 1.0, 0.0).value;
  opening<double> four;
  four.add_disc(three.sides[0].point, 1);
  four.add_disc(three.sides[0].point + vec2<double>{1.0, 0.05}, 0.01);
  four.add_disc(three.sides[1].point, 1);
  four.add_disc(three.sides[2].point, 1);
  const auto answer = msp.entry_pressure(four);
  CHECK(answer.ok());
  CHECK(answer.value == doctest::Approx(msp.entry_pressure(three).value).epsilon(1e-13));
  const auto m = msp.meniscus(four);
  CHECK(m.value.count == 3);
  CHECK(m.value.side[1] == 2);
  const auto slope = msp.derivative(four);
  CHECK(slope.value.by_radius[1] == 0);
  CHECK(slope.value.by_radius[0] > 0);
}

TEST_CASE("the arc of an edge is lost where the opening that has the gap loses it, and never where grains touch") {
  for (const double angle : {0.0, 0.4, 1.2}) {
    const mayer_stowe_princen law{.surface_tension = 0.07, .contact_angle = angle};
    for (const double r2 : {0.01, 0.5, 1.0, 30.0}) {
      for (const double gap : {1e-6, 0.1, 2.0}) {
        const edge<double> e{1.0, r2, gap, {1, 0, 0}};
        const auto lost = law.arc_lost(e);
        REQUIRE(lost.ok());
        // ρ₁ + ρ₂ is the distance of the centres
        const double r = 0.07 / lost.value;
        const auto rho = [&](double grain) {
          return std::sqrt(grain * grain + r * r + 2 * grain * r * std::cos(angle));
        };
        CHECK(rho(1.0) + rho(r2) == doctest::Approx(1.0 + r2 + gap).epsilon(1e-14));
        if (angle == 0.0) {
          CHECK(lost.value == doctest::Approx(2 * 0.07 / gap).epsilon(1e-9));
        }
        const edge<double> back{r2, 1.0, gap, {-1, 0, 0}};
        CHECK(law.arc_lost(back).value == lost.value);
      }
    }
    const edge<double> plate{1.0, inf, 0.3, {0, 0, 1}};
    const double r = 0.07 / law.arc_lost(plate).value;
    CHECK(std::sqrt(1 + r * r + 2 * r * std::cos(angle)) + r * std::cos(angle) == doctest::Approx(1.3).epsilon(1e-14));
    CHECK(law.arc_lost(edge<double>{1.0, 2.0, 0.0, {1, 0, 0}}).value == inf);
    CHECK(law.arc_lost(edge<double>{1.0, 2.0, -0.1, {1, 0, 0}}).value == inf);
    CHECK(law.arc_lost(edge<double>{1.0, -2.0, 0.1, {1, 0, 0}}).reason == entry_status::invalid_input);
    CHECK(law.arc_lost(edge<double>{not_a_number, 2.0, 0.1, {1, 0, 0}}).reason == entry_status::invalid_input);
    CHECK(law.arc_lost(edge<double>{1.0, 2.0, not_a_number, {1, 0, 0}}).reason == entry_status::invalid_input);
  }
}
