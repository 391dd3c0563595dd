// SPDX-License-Identifier: BSD-3-Clause
#include "support/compiled_triangulation.hpp"
#include "support/csv_table.hpp"
#include "support/shared_data.hpp"

#include "tetrapore/geometry/inscribed.hpp"
#include "tetrapore/io/read_packing.hpp"
#include "tetrapore/law/entry.hpp"
#include "tetrapore/packing/statistics.hpp"
#include "tetrapore/two_phase.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

using namespace tetrapore;

namespace {

/// One threshold per throat, and, where `body` is given, at least that of the pore behind it: Yade's rule, in parts.
struct rule_in_parts {
  static constexpr bool depends_on_state = false;
  std::vector<outcome<double, entry_status>> throats;
  std::vector<double> body;  // [Pa]

  [[nodiscard]] threshold_outcome threshold(const network& net, const two_phase_state& state, throat_id t) const {
    const auto& [value, reason] = throats[t.index()];
    const auto& [a, b] = net.pores(t);
    if (verdict_of(reason) != verdict::ok || body.empty() || !b.valid()) {
      return {bracket<double>::exactly(value), reason};
    }
    const pore_id into = state.is_gas(a) ? b : a;
    return {bracket<double>::exactly(std::max(value, body[into.index()])), reason};
  }
  void settle(const network&, const two_phase_state&, std::span<const throat_id>) const {}
  void touched_by(const network&, const two_phase_state&, pore_id, std::vector<throat_id>&) const {}
};
static_assert(entry_rule<rule_in_parts>);

/// Which of the peer's ways replace ours.
struct parts {
  bool walls_inscribed = false;  ///< a facet with a wall lets gas in at σ/r of its inscribed circle
  bool per_level = false;        ///< liquid is trapped when a burst has ended
  bool bodies = false;           ///< gas must also enter the inscribed sphere of the pore behind the throat
};

class decomposition {
 public:
  explicit decomposition(const packing& p)
      : net_(compiled_triangulation{}(p.grains, domain_of(p)).net),
        radius_(radii_of(p.grains).mean),
        lost_(net_, {1.0}) {
    for (std::size_t i = 0; i < net_.pore_count(); ++i) {
      const auto around = pore_body_at(net_, pore_id(i));
      std::array<bounding_side3<double>, 4> sides;
      for (std::size_t k = 0; k < 4; ++k) {
        sides[k] =
            k < around.grain_count ? round_side(around.grains[k]) : flat_side(around.walls[k - around.grain_count]);
      }
      const auto ball = sphere_between(sides);
      bodies_.push_back(ball.ok() ? 1 / ball.value.radius : 0);  // no ball: nothing to ask beyond the throat
    }
  }

  [[nodiscard]] const network& net() const { return net_; }
  [[nodiscard]] double radius() const { return radius_; }

  [[nodiscard]] retention_curve curve(const parts& with) const {
    const inscribed_circle half{0.5};  // 2 (σ/2) / r: the pressure σ / r of a facet with a wall
    rule_in_parts rule;
    for (std::size_t k = 0; k < net_.throat_count(); ++k) {
      const throat_id t(k);
      rule.throats.push_back(lost_.alone(t));
      const auto ring = opening_at(net_, t);
      const bool at_wall = std::any_of(ring.sides.begin(), ring.sides.begin() + static_cast<std::ptrdiff_t>(ring.count),
                                       [](const auto& s) { return s.kind == side_kind::line; });
      if (with.walls_inscribed && at_wall) {
        if (const auto answer = half.entry_pressure(ring); answer.ok()) {
          rule.throats.back() = answer;
        }
      }
    }
    if (with.bodies) {
      rule.body = bodies_;
    }
    drainage invasion(net_, rule,
                      {.inlet = face::y_max,
                       .outlet = face::y_min,
                       .trap = with.per_level ? trapping::per_level : trapping::per_event,
                       .level_margin = with.per_level ? 1e-9 : 0});
    invasion.run();
    return retention_curve(invasion);
  }

 private:
  network net_;
  double radius_;
  facet_rule<mayer_stowe_princen, gap_model::lost_arc> lost_;
  std::vector<double> bodies_;  // [Pa], σ = 1
};

std::string row(const char* name, const retention_curve& c, double radius) {
  std::string out = name;
  std::array<char, 32> text{};
  for (const double s : {0.9, 0.7, 0.5, 0.3}) {
    const auto p = c.pressure_at(s);
    REQUIRE(p.has_value());
    std::snprintf(text.data(), text.size(), " | %.3f", *p * radius);
    out += text.data();
  }
  std::snprintf(text.data(), text.size(), " | %.4f", c.end_saturation());
  return out + text.data();
}

/// All pores, and those without a wall.
struct saturations {
  double all, interior;
};

saturations at(const retention_curve& c, double pressure) {
  saturations s{c.initial_saturation(), 1};
  for (const auto& p : c.points()) {
    if (p.pressure > pressure) {
      break;
    }
    s = {p.saturation, p.interior_saturation};
  }
  return s;
}

/// How far a curve leaves the peer's staircase when its pressures may err by the relative `slack` (p): the largest
/// difference of saturation that no shift of a pressure within the slack explains.
template <class Slack>
double worst_excess(const retention_curve& ours, const csv_table& peer, const Slack& slack) {
  double worst = 0;
  saturations before{1, 1};
  for (std::size_t k = 0; k < peer.size(); ++k) {
    const double p = peer.number(k, "pc");
    const saturations after{peer.number(k, "Sw_all"), peer.number(k, "Sw_interior")};
    const saturations low = at(ours, p * (1 - slack(p)));
    const saturations high = at(ours, p * (1 + slack(p)));
    worst = std::max({worst, high.all - after.all, high.interior - after.interior, before.all - low.all,
                      before.interior - low.interior});
    before = after;
  }
  return worst;
}

}  // namespace

TEST_CASE(
    "two rules written by a user turn our curve into the peer's: the pressure of facets at walls, and the moment "
    "of trapping") {
  const auto spheres = shared_file("data/packings/open_1000.txt");
  const auto curve = shared_file("data/peer_yade/open_1000_drainage_pore.csv");
  if (!spheres || !curve) {
    return;
  }
  const decomposition d(io::read_packing(*spheres).packing);
  parts with;
  const retention_curve ours = d.curve(with);
  with.per_level = true;
  const retention_curve levels = d.curve(with);
  with.walls_inscribed = true;
  const retention_curve both = d.curve(with);
  with.bodies = true;
  const retention_curve all = d.curve(with);
  with = {};
  with.walls_inscribed = true;
  const retention_curve walls = d.curve(with);
  MESSAGE("p_c r/σ at S = 0.9, 0.7, 0.5, 0.3, and S at the end\n"
          << row("ours                ", ours, d.radius()) << "\n"
          << row("trapping per level  ", levels, d.radius()) << "\n"
          << row("walls at σ/r        ", walls, d.radius()) << "\n"
          << row("both                ", both, d.radius()) << "\n"
          << row("both, pore bodies   ", all, d.radius()));

  // The export has 12 digits; what limits the comparison is that the peer's walls are spheres of radius 5·10⁴ box
  // lengths. Within the box (1) such a sphere leaves its plane by at most (√½)² / (2·5·10⁴), and no inscribed circle
  // changes its radius by more than its sides move: relative, by at most that times p_c/σ.
  constexpr double wall_radius = 5e4;
  const auto slack = [](double p) { return p * 0.5 / (2 * wall_radius); };
  // Events whose pressures lie that close may change places, and then a step ends one pore earlier or later.
  double largest_all = 0, largest_interior = 0, sum_all = 0, sum_interior = 0;
  for (std::size_t i = 0; i < d.net().pore_count(); ++i) {
    const pore_id p(i);
    const double v = d.net().void_volume(p);
    if (d.net().touches(p, face::y_max) || d.net().touches(p, face::y_min)) {
      continue;
    }
    sum_all += v;
    largest_all = std::max(largest_all, v);
    if (!d.net().touches_wall(p)) {
      sum_interior += v;
      largest_interior = std::max(largest_interior, v);
    }
  }
  const double one_pore = std::min(largest_all / sum_all, largest_interior / sum_interior);
  const csv_table peer(*curve);
  REQUIRE(peer.size() > 100);
  const double excess = worst_excess(both, peer, slack);
  CHECK(excess < one_pore);
  // The edges of a pore at a wall point at the centre of that sphere instead of along the normal: by √½ / (5·10⁴).
  const double at_end = std::abs(both.end_saturation() - peer.number(peer.size() - 1, "Sw_all"));
  const double at_end_interior = std::abs(both.interior_end_saturation() - peer.number(peer.size() - 1, "Sw_interior"));
  CHECK(at_end < std::sqrt(0.5) / wall_radius);
  CHECK(at_end_interior < std::sqrt(0.5) / wall_radius);
  MESSAGE("beyond what its walls explain the peer's staircase is left by at most "
          << excess << " in S (one pore: " << one_pore << "), its end by " << at_end << " and, in the interior, "
          << at_end_interior);

  // Neither of the two does it alone.
  CHECK(worst_excess(ours, peer, slack) > 10 * one_pore);
  CHECK(worst_excess(levels, peer, slack) > 10 * one_pore);
  CHECK(worst_excess(walls, peer, slack) > 10 * one_pore);

  // The threshold of the pore body changes nothing here.
  REQUIRE(all.points().size() == both.points().size());
  std::size_t changed = 0;
  for (std::size_t k = 0; k < both.points().size(); ++k) {
    const auto& a = all.points()[k];
    const auto& b = both.points()[k];
    changed += a.pressure == b.pressure && a.saturation == b.saturation ? 0U : 1U;
  }
  CHECK(changed == 0);
}
