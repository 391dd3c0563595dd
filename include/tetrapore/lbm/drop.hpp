// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/calibration.hpp"
#include "tetrapore/lbm/moments.hpp"
#include "tetrapore/lbm/rest.hpp"
#include "tetrapore/lbm/wall_shift.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

/// \file
/// A drop on a flat wall, a quarter of it between mirrors: the contact angle in three dimensions.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// \par Units  lattice units
struct drop_set_up {
  calibrated_mixture mixture{};
  double contact_angle = 0.698;  ///< of the table, and to start from [rad]
  double base = 32;              ///< radius of the disc that the drop wets [nodes]
  int margin = 12;               ///< nodes beyond the drop
  int skipped = 4;               ///< rows beside the wall that are not fitted
  rest_options rest{1000, 1e-4, 3, 40000};
};

/// What a drop shows.
struct drop_result {
  double angle = 0;     ///< of the sphere through its surface, at the plane that acts as the wall [rad]
  double at_wall = 0;   ///< the same half a node outside the first nodes
  double radius = 0;    ///< of the sphere [nodes]
  double residual = 0;  ///< root mean square distance of the surface from the sphere, row by row [nodes]
  double tension = 0;   ///< p_c × radius / 2, over σ of the table at these densities
  double main = 0;      ///< mean main density in the end
  rest_report rest;
};

/// The angle [rad]; of drops the error of a lattice was not measured (docs/lattice_calibration.md has what they show).
[[nodiscard]] inline measurement measured(const drop_result& r) noexcept {
  return at_rest(r.angle, r.rest, quiet_nan<double>);
}
static_assert(experiment_result<drop_result>);

/// Lets a drop come to rest and fits a sphere to the areas of its sections. Its mean main density is that of the
/// mixture to 0.3 %, or the end is `missed`.
/// \par Units   lattice units
/// \par Domain  0 < θ < 180°; a drop of skipped + 5 rows or more
/// \tparam T  float or double
template <std::floating_point T = float, class Model = mixture<d3q19, bgk>, storage Storage = storage::moments>
[[nodiscard]] drop_result drop_on_wall(const drop_set_up& o) {
  const double radius = o.base / std::sin(o.contact_angle);
  const double tall = radius * (1 - std::cos(o.contact_angle));
  if (!(o.contact_angle > 0 && o.contact_angle < pi<double>) || !(tall >= o.skipped + 5) || o.skipped < 1) {
    throw parameter_error("drop", short_number(tall) + " nodes tall", "5 rows more than are left out beside the wall");
  }
  const double widest = o.contact_angle > pi<double> / 2 ? radius : o.base;
  const int side = static_cast<int>(widest) + o.margin;
  const int height = static_cast<int>(tall) + o.margin;
  constexpr face_kind mirror = face_kind::mirror;
  const auto model = repelling_pair<Model>(o.mixture.attraction, o.mixture.tau);
  simulation<Model, T, Storage> s(model,
                                  {{{side, side, height}, {mirror, mirror, face_kind::wall}, {mirror, mirror, mirror}},
                                   [](int, int, int) { return site{}; }});
  s.set_wall(0, wall_of_wettability(o.mixture.main, o.mixture.dissolved, wettability(o.mixture, o.contact_angle)));
  const auto& map = s.sites();
  const auto at = [&](int x, int y, int z) { return s.densities_at(static_cast<std::size_t>(map.node_at(x, y, z))); };

  drop_result d;
  const coexistence phases{o.mixture.attraction, o.mixture.factor, (o.mixture.factor - 1) / 2, o.mixture.main};
  // the drop is component 1 and its pressure the higher one: the liquid's side of p_c < 0
  const auto rho = reservoirs(phases, -2 * o.mixture.bubble_tension / radius);
  if (!rho.ok()) {
    d.rest.end = hold_end::dissolved;
    return d;
  }
  double centre = 0;
  const auto fit = [&]() -> double {
    const auto gas = at(side - 1, side - 1, height - 1);
    const auto liquid = at(0, 0, o.skipped);
    if (!(gas[0] > gas[1]) || !(liquid[1] > liquid[0])) {
      return std::isfinite(gas[0] + gas[1] + liquid[0] + liquid[1]) ? 0 : quiet_nan<double>;
    }
    d.main = (gas[0] + liquid[1]) / 2;
    std::vector<std::array<double, 2>> rows;  // height, squared radius of the section + height²
    for (int z = o.skipped; z < height; ++z) {
      double wet = 0;
      for (int x = 0; x < side; ++x) {
        for (int y = 0; y < side; ++y) {
          const auto here = at(x, y, z);
          wet += (gas[0] - gas[1] - here[0] + here[1]) / (gas[0] - gas[1] - liquid[0] + liquid[1]);
        }
      }
      const double squared = 4 * wet / pi<double>;
      if (squared < o.base * o.base / 16) {
        break;  // the top, where an interface is as wide as the section
      }
      const double h = z + 0.5;
      rows.push_back({h, squared + h * h});
    }
    const auto n = static_cast<double>(rows.size());
    if (rows.size() < 4) {
      return 0;
    }
    double h = 0, q = 0, hh = 0, hq = 0;
    for (const auto& row : rows) {
      h += row[0] / n;
      q += row[1] / n;
      hh += row[0] * row[0] / n;
      hq += row[0] * row[1] / n;
    }
    const double slope = (hq - h * q) / (hh - h * h);  // twice the height of the centre
    centre = slope / 2;
    d.radius = std::sqrt(q - slope * h + centre * centre);
    d.residual = 0;
    for (const auto& row : rows) {
      const double off = std::sqrt(row[1] - slope * row[0] + centre * centre) - d.radius;
      d.residual += off * off / n;
    }
    d.residual = std::sqrt(d.residual);
    d.tension = (model.pressure(liquid) - model.pressure(gas)) * d.radius / 2 / surface_tension(o.mixture, d.main);
    return d.radius - centre;
  };
  reservoir_pair laid = rho.value;
  for (const double still : {10 * o.rest.still, o.rest.still, o.rest.still}) {
    lay_interface(s, laid, [&](const std::array<int, 3>& p) {
      return std::hypot(p[0] + 0.5, p[1] + 0.5, p[2] + 0.5 + radius * std::cos(o.contact_angle)) - radius;
    });
    rest_options wait = o.rest;
    wait.still = still;
    const rest_report r = rest(s, wait, fit);
    d.rest = {r.change, d.rest.steps + r.steps, d.rest.updates + r.updates, r.end};
    if (r.end != hold_end::stable) {
      return d;
    }
    const double miss = o.mixture.main - d.main;
    d.rest.end = std::abs(miss) < 0.003 * o.mixture.main ? hold_end::stable : hold_end::missed;
    if (d.rest.end == hold_end::stable) {
      break;
    }
    laid.gas[0] += miss;
    laid.liquid[1] += miss;
  }
  d.angle = std::acos((axis_wall_shift - centre) / d.radius);
  d.at_wall = std::acos(-centre / d.radius);
  return d;
}

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
