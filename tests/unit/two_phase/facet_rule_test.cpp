// SPDX-License-Identifier: BSD-3-Clause
#include "support/small_networks.hpp"

#include "tetrapore/law/entry/inscribed_circle.hpp"
#include "tetrapore/law/entry/mayer_stowe_princen.hpp"
#include "tetrapore/two_phase/facet_rule.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace {

using namespace tetrapore;
using merged_rule = facet_rule<mayer_stowe_princen, gap_model::merged>;

vertex g(std::size_t i) { return vertex(grain_id(i)); }

/// The cells around the diagonal 0-1 of an octahedron of unit spheres, the sides of its square (in the plane z = 0)
/// `side` long; 2 and 3 are the other corners, 4 and 5 lie above and below.
network octahedron(double side, std::size_t cells = 4) {
  const double h = side / 2;
  const double z = side / std::sqrt(2.0);
  std::vector<sphere<double>> grains{{{-h, -h, 0}, 1}, {{h, h, 0}, 1}, {{h, -h, 0}, 1},
                                     {{-h, h, 0}, 1},  {{0, 0, z}, 1}, {{0, 0, -z}, 1}};
  std::vector<std::array<vertex, 4>> all{
      {g(0), g(1), g(2), g(4)}, {g(0), g(1), g(2), g(5)}, {g(0), g(1), g(3), g(4)}, {g(0), g(1), g(3), g(5)}};
  all.resize(cells);
  return network_of(unbounded(), std::move(grains), all);
}

throat_id between(const network& net, std::size_t a, std::size_t b) {
  for (const throat_id t : net.throats(pore_id(a))) {
    if (net.across(pore_id(a), t) == pore_id(b)) {
      return t;
    }
  }
  return {};
}

/// Equal unit discs at the given points, counter-clockwise.
opening<double> discs(std::initializer_list<vec2<double>> centres) {
  opening<double> o;
  for (const auto& c : centres) {
    o.add_disc(c, 1.0);
  }
  return o;
}

constexpr double four_rods = 4.4924436535119652;  // on a square, touching; σ = R = 1

}  // namespace

TEST_CASE("the opening of a facet names its sides, with the distances of its grains, from either side") {
  const network net = octahedron(2.3);
  for (std::size_t i = 0; i < net.pore_count(); ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      const facet_opening f = facet_opening_at(net, pore_id(i), k);
      REQUIRE(f.ring.count == 3);
      for (std::size_t s = 0; s < 3; ++s) {
        CHECK(f.slots[s] != k);
        const auto a = net.grain_sphere(pore_id(i), f.slots[s]);
        const auto b = net.grain_sphere(pore_id(i), f.slots[(s + 1) % 3]);
        CHECK(norm(f.ring.sides[(s + 1) % 3].point - f.ring.sides[s].point) ==
              doctest::Approx(norm(b.centre - a.centre)).epsilon(1e-14));
      }
    }
  }
}

TEST_CASE("the opening of a facet at walls names its walls, and keeps their distances") {
  const network net = two_grains_in_a_box();
  for (std::size_t i = 0; i < net.pore_count(); ++i) {
    const pore_id p(i);
    for (std::size_t k = 0; k < 4; ++k) {
      if (!net.throats(p)[k].valid()) {
        continue;
      }
      const facet_opening f = facet_opening_at(net, p, k);
      REQUIRE(f.ring.count == 3);
      for (std::size_t s = 0; s < 3; ++s) {
        const vertex v = net.vertices(p)[f.slots[s]];
        const auto& side = f.ring.sides[s];
        CHECK((side.kind == side_kind::line) == v.is_wall());
        if (!v.is_wall()) {
          CHECK(side.radius == net.grain_sphere(p, f.slots[s]).radius);
          continue;
        }
        for (std::size_t other = 0; other < 3; ++other) {
          if (f.ring.sides[other].kind == side_kind::disc) {
            const double distance = net.region().wall(v.wall()).distance(net.grain_sphere(p, f.slots[other]).centre);
            CHECK(dot(side.normal, f.ring.sides[other].point - side.point) == doctest::Approx(distance));
          }
        }
      }
    }
  }
}

TEST_CASE("two facets across the diagonal of a square are one opening: four touching rods") {
  const network net = octahedron(2.0);
  merged_rule rule(net, {1.0});
  two_phase_state state(net);
  // Alone, neither facet has a threshold: where the arc in the diagonal is lost, the third rod touches it.
  const throat_id below2 = between(net, 0, 1);
  const throat_id below3 = between(net, 2, 3);
  CHECK(rule.law_reason(below2) == entry_status::no_hole);
  CHECK(rule.threshold(net, state, below2).kind() == verdict::refused);
  // Gas above the square: the sector ends on the two halves of the square.
  state.mark_gas(pore_id(0));
  state.mark_gas(pore_id(2));
  for (const throat_id t : {below2, below3}) {
    const auto answer = rule.threshold(net, state, t);
    CHECK(answer.reason == entry_status::merged);
    CHECK(answer.value.lo == doctest::Approx(four_rods).epsilon(1e-12));
    CHECK(answer.value.exact());
  }
  CHECK(rule.merges().merged == 2);
  CHECK(rule.merges().by_sides[4] == 2);
  CHECK(rule.merges().at_arc == 0);
}

TEST_CASE("with one gas pore, its two facets at the edge share the meniscus, folded as they are") {
  const network net = octahedron(2.0);
  merged_rule rule(net, {1.0});
  two_phase_state state(net);
  state.mark_gas(pore_id(0));
  // Facets 0 1 2 and 0 1 4 are halves of a square about the same diagonal, at a right angle to each other.
  for (const throat_id t : {between(net, 0, 1), between(net, 0, 2)}) {
    CHECK(rule.threshold(net, state, t).value.lo == doctest::Approx(four_rods).epsilon(1e-12));
  }
  // With three gas pores around the edge, the two facets of the last wet one do.
  state.mark_gas(pore_id(1));
  state.mark_gas(pore_id(2));
  for (const throat_id t : {between(net, 1, 3), between(net, 2, 3)}) {
    CHECK(rule.threshold(net, state, t).value.lo == doctest::Approx(four_rods).epsilon(1e-12));
  }
}

TEST_CASE("when a pore fills, the throats whose ring rested on its facets are named, once") {
  const network net = octahedron(2.0);
  merged_rule rule(net, {1.0});
  two_phase_state state(net);
  state.mark_gas(pore_id(0));
  const throat_id kept = between(net, 0, 1);
  static_cast<void>(rule.threshold(net, state, kept));
  static_cast<void>(rule.threshold(net, state, kept));
  static_cast<void>(rule.threshold(net, state, between(net, 0, 2)));
  std::vector<throat_id> touched;
  state.mark_gas(pore_id(2));
  rule.touched_by(net, state, pore_id(2), touched);
  CHECK(touched == std::vector{kept});
  touched.clear();
  state.mark_gas(pore_id(3));
  rule.touched_by(net, state, pore_id(3), touched);
  CHECK(touched.empty());  // nobody asked since
}

TEST_CASE("where the network ends at the gap, the pressure of the lost arc stands, and is counted") {
  const network net = octahedron(2.0, 2);
  merged_rule rule(net, {1.0});
  two_phase_state state(net);
  state.mark_gas(pore_id(0));
  const auto answer = rule.threshold(net, state, between(net, 0, 1));
  CHECK(answer.reason == entry_status::lost_arc);
  CHECK(answer.value.lo == doctest::Approx(2 / (2 * std::sqrt(2.0) - 2)).epsilon(1e-13));
  CHECK(rule.merges().no_partner == 1);
  CHECK(rule.merges().merged == 0);
}

TEST_CASE("a merged facet is entered at the pressure of the lost arc when its ring alone would be entered before") {
  // A slightly wider square: the diagonal gap still gives way first, and the ring of four rods with their gaps follows.
  const auto law = mayer_stowe_princen{1.0};
  bool at_arc = false;
  bool above = false;
  for (double side = 2.0; side < 3.2; side += 0.05) {
    const network net = octahedron(side);
    merged_rule rule(net, law);
    two_phase_state state(net);
    state.mark_gas(pore_id(0));
    state.mark_gas(pore_id(2));
    const throat_id t = between(net, 0, 1);
    REQUIRE(verdict_of(rule.law_reason(t)) == verdict::refused);
    const double p_arc = 2 / (side * std::sqrt(2.0) - 2);
    const auto square = law.entry_pressure(discs({{0, 0}, {side, 0}, {side, side}, {0, side}}));
    const auto answer = rule.threshold(net, state, t);
    if (square.ok()) {
      CHECK(answer.value.lo == doctest::Approx(std::max(p_arc, square.value)).epsilon(1e-12));
      CHECK(answer.reason == entry_status::merged);
      (square.value > p_arc ? above : at_arc) = true;
    } else {
      // The outer gaps give way next, and beyond them the network ends.
      CHECK(square.reason == entry_status::gap_limited);
      CHECK(answer.reason == entry_status::lost_arc);
      CHECK(answer.value.lo == doctest::Approx(std::max(p_arc, 2 / (side - 2))).epsilon(1e-12));
    }
  }
  CHECK(above);
}

TEST_CASE("facets of equal spheres just beyond the limit of the gap let gas pass when the arc is lost") {
  // A regular tetrahedron full of gas, a wet pore on each side. All gaps are equal; their limit is
  // 0.58584625664443371 R.
  const auto law = mayer_stowe_princen{1.0};
  for (const double gap : {0.586, 0.6, 0.65, 0.7}) {
    const double s = 2 + gap;
    const double e = s / std::sqrt(8.0);
    std::vector<sphere<double>> grains{{{e, e, e}, 1}, {{e, -e, -e}, 1}, {{-e, e, -e}, 1}, {{-e, -e, e}, 1}};
    std::vector<std::array<vertex, 4>> cells{{g(0), g(1), g(2), g(3)}};
    for (std::size_t k = 0; k < 4; ++k) {
      grains.push_back({grains[k].centre * (-5.0 / 3.0), 1});  // the mirror image of corner k beyond its facet
      cells.push_back({g((k + 1) % 4), g((k + 2) % 4), g((k + 3) % 4), g(4 + k)});
    }
    const network net = network_of(unbounded(), grains, cells);
    merged_rule rule(net, law);
    two_phase_state state(net);
    state.mark_gas(pore_id(0));
    const double h = s * std::sqrt(3.0) / 2;
    const auto rhombus = law.entry_pressure(discs({{0, 0}, {s, 0}, {1.5 * s, h}, {0.5 * s, h}}));
    REQUIRE(rhombus.ok());
    for (const throat_id t : net.throats(pore_id(0))) {
      CHECK(rule.law_reason(t) == entry_status::gap_limited);
      const auto answer = rule.threshold(net, state, t);
      CHECK(answer.reason == entry_status::merged);
      CHECK(answer.value.lo == doctest::Approx(2 / gap).epsilon(1e-12));
      CHECK(rhombus.value <= 2 / gap * (1 + 1e-12));
    }
    CHECK(rule.merges().at_arc == 4);
  }
}

TEST_CASE("a rule of a law that knows no gaps, and a rule that refuses, keep the law's answers") {
  const network net = octahedron(2.0);
  const facet_rule circles(net, inscribed_circle{1.0});
  static_assert(decltype(circles)::model == gap_model::refused && !decltype(circles)::depends_on_state);
  CHECK(circles.facets()[entry_status::ok] == net.throat_count());
  facet_rule<mayer_stowe_princen, gap_model::refused> strict(net, {1.0});
  two_phase_state state(net);
  const auto answer = strict.threshold(net, state, between(net, 0, 1));
  CHECK(answer.reason == entry_status::no_hole);
  CHECK(answer.kind() == verdict::refused);
  CHECK(strict.totals()[verdict::refused] == strict.facets()[entry_status::no_hole]);
}

TEST_CASE("the answer for a facet alone and the law's own reason stay as they are while thresholds move") {
  const auto law = mayer_stowe_princen{1.0};
  const network net = octahedron(2.0);
  merged_rule rule(net, law);
  const facet_rule<mayer_stowe_princen, gap_model::lost_arc> lost(net, law);
  for (std::size_t i = 0; i < net.throat_count(); ++i) {
    const throat_id t(i);
    const auto own = law.entry_pressure(opening_at(net, t));
    CHECK(rule.law_reason(t) == own.reason);
    CHECK(lost.law_reason(t) == own.reason);
    CHECK((own.ok() ? rule.last_threshold(t) == own.value : std::isnan(rule.last_threshold(t))));
    CHECK(lost.last_threshold(t) == lost.alone(t).value);
  }
  CHECK(lost.facets()[entry_status::no_hole] == rule.facets()[entry_status::no_hole]);
  CHECK(lost.facets()[entry_status::no_hole] > 0);
  CHECK(lost.facets()[entry_status::lost_arc] == 0);
  two_phase_state state(net);
  state.mark_gas(pore_id(0));
  const throat_id t = between(net, 0, 1);
  const auto before = rule.alone(t);
  const auto answer = rule.threshold(net, state, t);
  CHECK(rule.last_threshold(t) == answer.value.lo);
  CHECK(std::isnan(before.value));
  CHECK(std::isnan(rule.alone(t).value));
  CHECK(rule.alone(t).reason == before.reason);
}
