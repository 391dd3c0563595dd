// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/drainage_job.hpp"
#include "support/keys.hpp"
#include "support/stopwatch.hpp"

#include "tetrapore/geometry/inscribed.hpp"
#include "tetrapore/law/entry.hpp"
#include "tetrapore/network/gather.hpp"
#include "tetrapore/network/solid.hpp"
#include "tetrapore/packing/statistics.hpp"
#include "tetrapore/simplex/throat_geometry.hpp"
#include "tetrapore/tessellation/tessellation.hpp"
#include "tetrapore/two_phase/drainage.hpp"
#include "tetrapore/two_phase/facet_rule.hpp"
#include "tetrapore/two_phase/retention_curve.hpp"
#include "tetrapore/two_phase/van_genuchten.hpp"

#include <cstdio>
#include <limits>
#include <string>
#include <vector>

/// \file
/// What is told about a drainage: sizes of pores and throats, the curve, and the numbers behind the keys on stdout.

namespace support {

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// sizes ---------------------------------------------------------------------------------------------------------------

/// How the entry law answered for each throat, and how large things are. A throat with one pore is a boundary and gets
/// no answer.
struct sizes {
  std::vector<double> entry_pressure;          ///< [Pa] of the facet alone; infinity: closed; NaN: refused, boundary
  std::vector<tp::entry_status> entry_status;  ///< of the law itself, before --gap-limited
  std::vector<double> throat_radius;           ///< [m] inscribed circle; 0: covered; NaN: there is none
  std::vector<double> throat_area;             ///< [m²] of the fluid in the facet
  std::vector<double> pore_radius;             ///< [m] inscribed sphere; 0: covered; NaN: there is none
  std::vector<std::int32_t> coordination;      ///< throats of a pore that lead to another pore and are not closed
};

/// The radius of an inscribed circle or sphere.
template <class Shape>
[[nodiscard]] double radius_or_none(const tp::outcome<Shape, tp::inscribed_status>& found) {
  return found.ok() ? found.value.radius : (found.kind() == tp::verdict::absent ? 0.0 : nan);
}

[[nodiscard]] inline double inscribed_radius(const tp::pore_body<double>& body) {
  std::array<tp::bounding_side3<double>, 4> sides;
  for (std::size_t k = 0; k < 4; ++k) {
    sides[k] = k < body.grain_count ? tp::round_side(body.grains[k]) : tp::flat_side(body.walls[k - body.grain_count]);
  }
  return radius_or_none(tp::sphere_between(sides));
}

[[nodiscard]] inline double inscribed_radius(const tp::opening<double>& ring) {
  std::array<tp::bounding_side2<double>, 3> sides;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& s = ring.sides[k];
    sides[k] = {s.point, s.normal, s.radius, s.kind == tp::side_kind::line};
  }
  return radius_or_none(tp::circle_between(sides));
}

/// Gathers the answers of a rule for every throat between two pores, before an invasion moves them.
template <class Rule>
[[nodiscard]] sizes measure_sizes(const tp::network& net, const Rule& rule) {
  sizes s;
  s.entry_pressure.assign(net.throat_count(), nan);
  s.entry_status.assign(net.throat_count(), tp::entry_status::not_covered);
  s.coordination.assign(net.pore_count(), 0);
  for (std::size_t k = 0; k < net.throat_count(); ++k) {
    const tp::throat_id t(k);
    const auto ring = tp::opening_at(net, t);
    s.throat_radius.push_back(inscribed_radius(ring));
    const auto area = tp::fluid_area(tp::throat_at(net, t));
    s.throat_area.push_back(area.ok() ? area.value : nan);
    if (net.is_boundary(t)) {
      continue;
    }
    s.entry_pressure[k] = rule.alone(t).value;
    s.entry_status[k] = rule.law_reason(t);
    if (rule.law_reason(t) != tp::entry_status::closed) {
      for (const tp::pore_id p : net.pores(t)) {
        ++s.coordination[p.index()];
      }
    }
  }
  for (std::size_t p = 0; p < net.pore_count(); ++p) {
    s.pore_radius.push_back(inscribed_radius(tp::pore_body_at(net, tp::pore_id(p))));
  }
  return s;
}

// the invasion --------------------------------------------------------------------------------------------------------

enum class phase : std::uint8_t { gas = 0, liquid = 1, trapped_liquid = 2 };

[[nodiscard]] inline std::vector<phase> phases_of(const tp::two_phase_state& state) {
  std::vector<phase> out(state.pore_count());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const tp::pore_id p(i);
    out[i] = state.is_gas(p) ? phase::gas : state.is_trapped(p) ? phase::trapped_liquid : phase::liquid;
  }
  return out;
}

struct snapshot {
  double saturation;
  double pressure;  ///< [Pa]
  std::vector<phase> phases;
};

/// An invasion from beginning to end.
struct history {
  std::vector<tp::drainage_event> events;
  std::vector<snapshot> snapshots;  ///< at falling saturations, the first and the last state among them
  tp::two_phase_state end;
  tp::retention_curve curve;
  tp::merge_counts merges;  ///< how the facets at the front merged
  double void_volume = 0;   ///< of the pores that are not reservoir [m³]
};

/// Drains to the end and keeps the state where the saturation first falls to 0.9, 0.8, …
template <class Rule>
  requires tp::entry_rule<Rule>
[[nodiscard]] history drain(const tp::network& net, Rule& rule, const drainage_job& job) {
  tp::drainage invasion(
      net, rule,
      {.inlet = job.inlet, .outlet = job.outlet, .trap = job.trapping ? tp::trapping::per_event : tp::trapping::none});
  std::vector<snapshot> snapshots;
  const auto keep = [&] {
    if (snapshots.empty() || invasion.saturation() < snapshots.back().saturation) {
      snapshots.push_back({invasion.saturation(), invasion.state().pressure(), phases_of(invasion.state())});
    }
  };
  keep();
  for (int tenth = 9; tenth > 0; --tenth) {
    invasion.run_to_saturation(0.1 * tenth);
    keep();
  }
  invasion.run();
  keep();
  return {invasion.events(), std::move(snapshots),  invasion.state(), tp::retention_curve(invasion),
          rule.merges(),     invasion.void_volume()};
}

// the keys ------------------------------------------------------------------------------------------------------------

struct seconds {
  double read = 0;
  double tessellation = 0;
  double laws = 0;
  double invasion = 0;
  double write = 0;
};

struct summary {
  std::size_t grains = 0;
  std::size_t pores = 0;
  std::size_t throats = 0;
  std::size_t hidden = 0;
  double mean_radius = 0;  ///< [m]
  double porosity = 0;
  double volume_defect = 0;
  std::array<std::size_t, tp::status_counts::kinds> answers{};
  std::size_t merged = 0;
  double pressure_unit = 0;             ///< σ over the mean radius [Pa]
  std::array<double, 4> pressure_at{};  ///< at S = 0.9, 0.7, 0.5, 0.3, in that unit
  double residual_saturation = 0;
  double residual_interior = 0;
  std::size_t trapped_clusters = 0;
  double bond_number = nan;
  double gravity_ratio = nan;  ///< hydrostatic difference over the height of the sample / p_c at S = 0.5
  tp::outcome<tp::van_genuchten_fit, tp::fit_status> fitted{{}, tp::fit_status::too_few_points};

  [[nodiscard]] std::size_t count(tp::entry_status s) const { return answers[static_cast<std::size_t>(s)]; }
};

inline constexpr std::array<double, 4> levels_told{0.9, 0.7, 0.5, 0.3};

[[nodiscard]] inline summary summarise(const tp::tessellation& mesh, const sizes& s, const history& h,
                                       const drainage_job& job) {
  const tp::network& net = mesh.net;
  summary out;
  out.grains = net.grain_count();
  out.pores = net.pore_count();
  out.throats = net.throat_count();
  out.hidden = mesh.report.hidden.size();
  out.mean_radius = tp::radii_of(net.grains()).mean;

  bool closed = true;
  for (const tp::face f : tp::all_faces) {
    closed = closed && net.region().at(f) != tp::boundary::open;
  }
  const double voids = tp::compensated_sum(net.arrays().void_volumes);
  const double whole = closed ? net.region().bounds.volume() : tp::compensated_sum(net.arrays().volumes);
  out.porosity = voids / whole;
  out.volume_defect = std::abs(voids + tp::solid_volume(net) - whole) / whole;

  for (std::size_t k = 0; k < net.throat_count(); ++k) {
    if (!net.is_boundary(tp::throat_id(k))) {
      ++out.answers[static_cast<std::size_t>(s.entry_status[k])];
    }
  }
  out.merged = h.merges.merged;

  out.pressure_unit = job.surface_tension / out.mean_radius;
  for (std::size_t k = 0; k < levels_told.size(); ++k) {
    out.pressure_at[k] = h.curve.pressure_at(levels_told[k]).value_or(nan) / out.pressure_unit;
  }
  double trapped = 0;
  double trapped_interior = 0;
  double interior = 0;
  for (std::size_t i = 0; i < net.pore_count(); ++i) {
    const tp::pore_id p(i);
    if (h.end.is_reservoir(p)) {
      continue;
    }
    const double held = h.end.is_trapped(p) ? h.end.liquid()[p] : 0;
    trapped += held;
    if (!net.touches_wall(p)) {
      trapped_interior += held;
      interior += net.void_volume(p);
    }
  }
  out.residual_saturation = trapped / h.void_volume;
  out.residual_interior = trapped_interior / interior;
  out.trapped_clusters = h.end.clusters().size();
  if (job.density) {
    constexpr double g = 9.80665;  // [m/s²] standard gravity
    const double weight = *job.density * g;
    const std::size_t axis = axis_of(job.inlet);
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const auto& grain : net.grains()) {
      low = std::min(low, grain.centre[axis]);
      high = std::max(high, grain.centre[axis]);
    }
    out.bond_number = weight * out.mean_radius * out.mean_radius / job.surface_tension;
    out.gravity_ratio = weight * (high - low) / h.curve.pressure_at(0.5).value_or(nan);
  }
  out.fitted = tp::fit_van_genuchten(h.curve);
  return out;
}

/// Gravity matters where the weight of the fluids over the height of the sample is no longer small beside the pressure
/// that moves them: from 10 % of p_c at S = 0.5 on.
inline void warn_of_gravity(const summary& s, const drainage_job& job) {
  if (s.gravity_ratio > 0.1) {
    std::fprintf(
        stderr,
        "warning: gravity matters: over the sample between %s and %s it changes p_c by %.0f %% of its value at "
        "S = 0.5, and this drainage leaves it out (bond_number = %.3g)\n",
        describe(job.inlet), describe(job.outlet), 100 * s.gravity_ratio, s.bond_number);
  }
}

inline void print_table(const tp::retention_curve& c, const summary& s) {
  std::printf("%10s %12s %12s %10s %10s\n", "S", "p_c [Pa]", "p_c r/sigma", "S_interior", "gas_pores");
  double next = c.initial_saturation();
  const auto points = c.points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& p = points[i];
    if (p.saturation <= next || i + 1 == points.size()) {
      std::printf("%10.4f %12.5g %12.4f %10.4f %10zu\n", p.saturation, p.pressure, p.pressure / s.pressure_unit,
                  p.interior_saturation, p.events);
      while (next >= p.saturation) {
        next -= 0.05;
      }
    }
  }
}

inline void print_keys(const summary& s, const seconds& t) {
  using enum tp::entry_status;
  const key_printer say;
  say("grains", s.grains);
  say("pores", s.pores);
  say("throats", s.throats);
  say("hidden", s.hidden);
  say("porosity", s.porosity);
  say("volume_defect", s.volume_defect);
  say("entry_ok", s.count(ok));
  say("entry_gap_limited", s.count(gap_limited));
  say("entry_merged", s.merged);
  say("entry_no_hole", s.count(no_hole));
  say("entry_dry", s.count(dry_corner));
  say("entry_closed", s.count(closed));
  say("entry_refused", s.count(not_covered) + s.count(invalid_input) + s.count(not_converged));
  say("pc_s90", s.pressure_at[0]);
  say("pc_s70", s.pressure_at[1]);
  say("pc_s50", s.pressure_at[2]);
  say("pc_s30", s.pressure_at[3]);
  say("residual_saturation", s.residual_saturation);
  say("residual_interior", s.residual_interior);
  say("trapped_clusters", s.trapped_clusters);
  if (!std::isnan(s.bond_number)) {
    say("bond_number", s.bond_number);
  }
  say("van_genuchten_alpha", s.fitted.value.law.alpha);
  say("van_genuchten_n", s.fitted.value.law.n);
  say("fit_rms", s.fitted.value.rms);
  say("seconds_read", t.read);
  say("seconds_tessellation", t.tessellation);
  say("seconds_laws", t.laws);
  say("seconds_invasion", t.invasion);
  say("seconds_write", t.write);
  say("peak_rss_mb", peak_rss_mb());
}

}  // namespace support
