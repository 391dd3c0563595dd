// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/laplace.hpp"
#include "tetrapore/lbm/wall_shift.hpp"

#include <span>

/// \file
/// The contact angle that wall densities give, by a meniscus between two plates.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// A meniscus between plates, half of it above the mirror between them. \par Units  lattice units
struct contact_set_up {
  double attraction = 1.8;  ///< G
  double tau = 1;
  double main = 1;           ///< mean main density of both phases
  double more = 0;           ///< laid in the beginning: walls repel both components and take up some of them
  double tension = 0.0862;   ///< of a flat interface, for the start
  double factor = 1.995;     ///< c of `coexistence`, for the start
  double wettability = 0.5;  ///< of both plates, `wall_of_wettability`
  double expected = 1.047;   ///< angle to start from [rad]
  int half_gap = 24;         ///< nodes between plate and mirror
  int skipped = 4;           ///< rows beside the plate that are not fitted: the wall bends what is near
  rest_options rest{1000, 2e-5, 3, 100000};
};

/// What a meniscus shows: component 1 is the liquid, angles are through it.
struct contact_result {
  double angle = 0;      ///< at the plane that acts as the plate [rad]; 0 where a film covers the plate
  double curvature = 0;  ///< of the meniscus [1/node]; its sign is that of cos θ
  double cosine = 0;     ///< (half gap − axis_wall_shift) × curvature; above 1 where a film narrows the gap
  double tension = 0;    ///< p_c over the curvature
  double more = 0;       ///< what had to be laid for the main density that was asked for
  double residual = 0;   ///< root mean square distance of the interface from its arc [nodes]
  double by_rows = 0;    ///< by how much the angle changes when two rows more are left out [rad]
  double driest = 0;  ///< lowest share of liquid beside the plate: (ρ1 − ρ0)/(main − dissolved); −1 dry, 1 wet
  rest_report rest;
};

/// The angle [rad]; the error of the lattice is taken to be what two rows more or less make.
[[nodiscard]] inline measurement measured(const contact_result& r) noexcept {
  return at_rest(r.angle, r.rest, r.angle > 0 ? std::abs(r.by_rows) / r.angle : quiet_nan<double>);
}
static_assert(experiment_result<contact_result>);

namespace detail {

struct arc {
  double apex;
  double curvature;
  double residual;
};

/// The arc x = apex + curvature × ((x − apex)² + h²)/2 through points (x, h), its middle on h = 0: straight ones too.
[[nodiscard]] inline arc fit_arc(std::span<const std::array<double, 2>> points) noexcept {
  arc a{points.back()[0], 0, 0};
  const auto n = static_cast<double>(points.size());
  for (int turn = 0; turn < 50; ++turn) {
    double x = 0, q = 0, qq = 0, xq = 0;
    for (const auto& p : points) {
      const double z = ((p[0] - a.apex) * (p[0] - a.apex) + p[1] * p[1]) / 2;
      x += p[0] / n;
      q += z / n;
      qq += z * z / n;
      xq += p[0] * z / n;
    }
    a.curvature = (xq - x * q) / (qq - q * q);
    a.apex = x - a.curvature * q;
  }
  for (const auto& p : points) {
    const double off = std::hypot(1 - a.curvature * (p[0] - a.apex), a.curvature * p[1]) - 1;
    const double distance = std::abs(a.curvature) > 1e-9 ? off / a.curvature : p[0] - a.apex;
    a.residual += distance * distance / n;
  }
  a.residual = std::sqrt(a.residual);
  return a;
}

}  // namespace detail

/// Lets a meniscus between plates come to rest and fits an arc to the line on which the components weigh the same.
///
/// What the arc has at the plate is the angle seen from afar; next to the wall the interface bends within some 3 nodes.
/// The plane at which the angle holds lies inside the gap by `axis_wall_shift`. A wall shows densities of its own, so
/// its angle follows the main density (cos θ by half of a change of it): fluids are laid again until that is the one
/// asked for, to 0.3 %; where it is not after six times the end is `missed`.
/// \par Units  lattice units
/// \tparam Model  a mixture on a lattice of two dimensions: of D3Q19 it is what its planes show
template <class Model = mixture<d2q9, bgk>, std::floating_point T = float>
[[nodiscard]] contact_result contact_angle(const contact_set_up& o) {
  static_assert(Model::lattice_type::dimensions == 2, "a meniscus between plates is computed in the plane");
  if (o.half_gap < o.skipped + 6 || o.skipped < 1 || !(std::abs(o.expected - pi<double> / 2) <= pi<double> / 2)) {
    throw parameter_error("meniscus", std::to_string(o.half_gap) + " nodes to the middle of the gap",
                          "6 more than are left out beside the plate, an angle of 0 to 180 degrees");
  }
  const auto model = repelling_pair<Model>(o.attraction, o.tau);
  contact_result c;
  const coexistence pair{o.attraction, o.factor, (o.factor - 1) / 2, o.main};
  const double start_cosine = std::cos(o.expected);
  const auto flat = dissolved_density(pair);
  const auto start = reservoirs(pair, o.tension * start_cosine / o.half_gap);
  if (!start.ok()) {
    c.rest.end = hold_end::dissolved;
    return c;
  }
  // the arc and a film: 1 to 2 gaps of fluid on either side; x runs along the plates, gas first
  const int length = 4 * o.half_gap + 16;
  const int height = o.half_gap;
  const lattice_box box{{length, height, 1},
                        {face_kind::mirror, face_kind::wall, face_kind::periodic},
                        {face_kind::mirror, face_kind::mirror, face_kind::periodic}};
  simulation<Model, T> s(model, {box, [](int, int, int) { return site{}; }});
  s.set_wall(0, wall_of_wettability(o.main, flat.value, o.wettability));
  const double curvature = start_cosine / o.half_gap;
  const auto below_middle = [&](int y) { return height - 0.5 - y; };
  std::vector<std::array<double, 2>> points(static_cast<std::size_t>(height));
  std::vector<double> profile(static_cast<std::size_t>(length));
  const auto fit = [&](int skipped) {
    return detail::fit_arc(std::span<const std::array<double, 2>>(points).subspan(static_cast<std::size_t>(skipped)));
  };
  const auto look = [&]() -> double {
    c.driest = 1;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < length; ++x) {
        const auto rho = s.densities_at(static_cast<std::size_t>(s.sites().node_at(x, y, 0)));
        profile[static_cast<std::size_t>(x)] = rho[0] - rho[1];
        if (!std::isfinite(rho[0] + rho[1])) {
          return quiet_nan<double>;
        }
        c.driest = y == 0 ? std::min(c.driest, (rho[1] - rho[0]) / (o.main - flat.value)) : c.driest;
      }
      const double at = detail::falls_below(profile, 0);
      points[static_cast<std::size_t>(y)] = {at, below_middle(y)};
      if (at < 0 && y >= o.skipped) {
        return 0;  // one of the phases fills a row
      }
    }
    return 2 - o.half_gap * fit(o.skipped).curvature;
  };
  const int axis = height - 1;
  const auto at = [&](int x) { return s.densities_at(static_cast<std::size_t>(s.sites().node_at(x, axis, 0))); };
  c.more = o.more;
  double slope = 1;  // of the main density found, by the one laid
  double last_more = 0;
  double last_miss = 0;
  for (int turn = 0; turn < 6; ++turn) {
    reservoir_pair laid = start.value;
    laid.gas[0] += c.more;
    laid.liquid[1] += c.more;
    lay_interface(s, laid, [&](const std::array<int, 3>& p) {
      const double h = below_middle(p[1]);
      const double sagitta = curvature * h * h / (1 + std::sqrt(std::max(0.0, 1 - curvature * curvature * h * h)));
      return 0.5 * length - (sagitta - curvature * o.half_gap * o.half_gap / 2) - p[0];
    });
    const rest_report r = rest(s, o.rest, look);
    c.rest = {r.change, c.rest.steps + r.steps, c.rest.updates + r.updates, r.end};
    if (r.end != hold_end::stable) {
      return c;
    }
    const double miss = o.main - (at(1)[0] + at(length - 2)[1]) / 2;
    c.rest.end = std::abs(miss) < 0.003 * o.main ? hold_end::stable : hold_end::missed;
    if (c.rest.end == hold_end::stable) {
      break;
    }
    slope = turn > 0 ? std::clamp((last_miss - miss) / (c.more - last_more), 0.5, 4.0) : slope;
    last_more = c.more;
    last_miss = miss;
    c.more += miss / slope;
  }
  const detail::arc whole = fit(o.skipped);
  const auto angle_of = [&](double curvature_found) {
    // the gas reaches out in the middle
    return std::acos(std::clamp(-curvature_found * (o.half_gap - axis_wall_shift), -1.0, 1.0));
  };
  c.curvature = -whole.curvature;
  c.cosine = c.curvature * (o.half_gap - axis_wall_shift);
  c.tension = (model.pressure(at(1)) - model.pressure(at(length - 2))) / c.curvature;
  c.angle = angle_of(whole.curvature);
  c.residual = whole.residual;
  c.by_rows = std::abs(angle_of(fit(o.skipped + 2).curvature) - c.angle);
  return c;
}

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
