// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/entry/mayer_stowe_princen.hpp"
#include "tetrapore/lbm/calibration.hpp"
#include "tetrapore/lbm/moments.hpp"
#include "tetrapore/lbm/rest.hpp"
#include "tetrapore/lbm/tube.hpp"
#include "tetrapore/lbm/wall_shift.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

/// \file
/// Entry pressure of a straight tube by experiment: a closed piece of it, gas above, liquid below, left until it rests.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// What a tube experiment is made of. \par Units  lattice units but where said
struct tube_set_up {
  opening<double> section;             ///< lines around a convex polygon, in any unit of length
  double nodes_per_length = 1;         ///< nodes per unit of the section
  std::optional<double> retraction{};  ///< nodes by which walls move out; none: what their film will take
  double gas = 4;                      ///< length of the gas, in radii σ/p of the arcs in the corners
  double liquid = 3;                   ///< and of the liquid
  double contact_angle = 0;            ///< [rad]
  calibrated_mixture mixture{};
  std::size_t most_nodes = 1000000;
  double near = 0.01;          ///< share by which the main density may miss the mixture's; σ is that of what is found
  double patience = 6000;      ///< steps per node of the arcs' radius after which a tube that still moves is given up
  kept_waits* kept = nullptr;  ///< where to go on from, and where states are saved
};

/// What a tube shows. \par Units  1/length of the section but where said
struct tube_result {
  double pressure = 0;    ///< p/σ that the fluids show in the tube as it lies on the lattice
  double entry = 0;       ///< of the section itself, where walls and films really are; NaN where no law covers it
  double law = 0;         ///< p/σ of Mayer, Stowe & Princen for the section
  double tension = 0;     ///< σ at these densities
  double shift = 0;       ///< nodes of film at what the fluids show
  double retraction = 0;  ///< nodes by which the walls lie further out
  double flow = 0;        ///< by how much the pressure of the liquid differs along its axis, relative to p: currents
  double arc = 0;         ///< radius of the arcs by the law [nodes]
  std::size_t nodes = 0;
  rest_report rest;
};

/// The entry pressure p/σ of the section. The error is the largest that was found with arcs of 3 nodes or more, on the
/// hexagon.
[[nodiscard]] inline measurement measured(const tube_result& r) noexcept {
  return at_rest(r.entry, r.rest, r.arc < 3 ? quiet_nan<double> : 0.08 / r.arc);
}
static_assert(experiment_result<tube_result>);

/// Nodes that the film and the corners of a tube take from each of its walls, whatever its section: what plates show,
/// and more where the arcs in the corners are hardly wider than an interface.
/// \par Units     σ/p of the arcs and result [nodes]
/// \par Domain    that of film_shift
/// \par Accuracy  0.05 (triangles, squares) to 0.15 nodes (hexagon, rectangle, on which the second term is calibrated:
///                1.0 and 0.3) at σ/p = 3 to 13
[[nodiscard]] inline double tube_shift(double arc) noexcept { return film_shift(arc) + 0.6 / arc; }

/// Lets a meniscus in a tube come to rest between mirrors and measures the difference of pressure across it.
///
/// A meniscus that rests in a straight tube does so at the entry pressure alone, since it could as well rest anywhere
/// else. Held at a pressure of one's choice it moves, but so it does while liquid still leaves the corners behind it or
/// comes back to them: over 3 nodes in 10,000 steps at r_in = 9 nodes. In a closed tube whose gas is no longer than a
/// few radii the corners come to rest with the meniscus.
/// A tube that rests at another main density ends as `missed`.
/// \par Domain    polygons that the law covers; arcs of 2.5 nodes and more; τ = 1 where `Storage` is moments
/// \par Accuracy  docs/throat_experiment.md, "Tubes"
/// \tparam T  float or double
template <std::floating_point T = float, class Model = mixture<d3q19, bgk>, storage Storage = storage::moments>
[[nodiscard]] tube_result tube_at_rest(const tube_set_up& o) {
  const mayer_stowe_princen law{.surface_tension = 1.0, .contact_angle = o.contact_angle};
  const auto plane = law.entry_pressure(o.section);
  if (!plane.ok()) {
    throw parameter_error("tube", describe(plane.reason), "a section with an entry pressure");
  }
  tube_result r;
  r.law = plane.value;
  const double arc = o.nodes_per_length / r.law;
  if (!(arc >= 2.5) || !(o.gas >= 2) || !(o.liquid >= 1.5) || !(o.patience > 0)) {
    throw parameter_error("tube",
                          "arcs of " + short_number(arc) + " nodes, " + short_number(o.gas) + " radii of gas, " +
                              short_number(o.liquid) + " of liquid",
                          "at least 2.5 nodes, 2 and 1.5 radii");
  }
  r.arc = arc;
  const double expected = o.contact_angle > 0 ? wall_shift : tube_shift(arc);
  const tube_on_lattice tube(o.section, {.nodes_per_length = o.nodes_per_length,
                                         .retraction = o.retraction.value_or(expected),
                                         .length = (o.gas + o.liquid) * arc + 4,
                                         .most_nodes = o.most_nodes});
  r.retraction = tube.retraction();
  const auto model = repelling_pair<Model>(o.mixture.attraction, o.mixture.tau);
  simulation<Model, T, Storage> s(model, tube.template sites<typename Model::lattice_type>());
  const auto& map = s.sites();
  r.nodes = map.size();
  const auto wall = wall_of_wettability(o.mixture.main, o.mixture.dissolved, wettability(o.mixture, o.contact_angle));
  s.set_wall(0, wall);
  s.set_wall(tube_wall, wall);

  std::array<int, 2> axis{};
  for (int x = 0; x < tube.box().size[0]; ++x) {
    for (int y = 0; y < tube.box().size[1]; ++y) {
      if (tube.to_walls(x, y) > tube.to_walls(axis[0], axis[1])) {
        axis = {x, y};
      }
    }
  }
  const double inscribed = tube.to_walls(axis[0], axis[1]);
  const double level = o.liquid * arc + 2;
  const auto on_axis = [&](int z) {
    return s.densities_at(static_cast<std::size_t>(map.node_at(axis[0], axis[1], z)));
  };
  const auto show = [&]() -> double {
    const auto gas = on_axis(tube.box().size[2] - 2);
    const auto liquid = on_axis(1);
    if (!(gas[0] > gas[1]) || !(liquid[1] > liquid[0])) {
      return std::isfinite(gas[0] + gas[1] + liquid[0] + liquid[1]) ? 0 : quiet_nan<double>;
    }
    const double p = model.pressure(gas) - model.pressure(liquid);
    r.tension = surface_tension(o.mixture, (gas[0] + liquid[1]) / 2);
    r.pressure = p * o.nodes_per_length / r.tension;
    r.flow = std::abs(model.pressure(liquid) - model.pressure(on_axis(static_cast<int>(level / 2)))) / p;
    return r.pressure;
  };
  const coexistence phases{o.mixture.attraction, o.mixture.factor, (o.mixture.factor - 1) / 2, o.mixture.main};
  const auto rho = reservoirs(phases, o.mixture.bubble_tension / arc);
  if (!rho.ok()) {
    r.rest.end = hold_end::dissolved;
    return r;
  }
  // walls repel both components and films hold some of one: what is laid is shifted until the bulk has the densities
  // of the calibration
  reservoir_pair laid = rho.value;
  const auto window = 2 * static_cast<std::uint64_t>(50 * arc);
  const auto most = static_cast<std::uint64_t>(o.patience * arc);
  for (const rest_options& wait :
       {rest_options{window, 0.02, 2, most, o.kept}, rest_options{window, 1e-3, 2, most, o.kept},
        rest_options{window, 1e-4, 3, most, o.kept}}) {
    s.initialise([&](const std::array<int, 3>& p, auto& at, auto&) {
      const double rise = 1 - std::clamp(tube.to_walls(p[0], p[1]) / inscribed, 0.0, 1.0);
      const double gas = 0.5 * (1 + std::tanh((p[2] - level - arc * rise * rise) / 1.5));
      const double core = 0.5 * (1 + std::tanh(arc + r.retraction - expected - tube.to_core(p[0], p[1], arc)));
      for (std::size_t c = 0; c < 2; ++c) {
        at[c] = laid.liquid[c] + (laid.gas[c] - laid.liquid[c]) * std::min(gas, core);
      }
    });
    const rest_report now = rest(s, wait, show);
    r.rest = {now.change, r.rest.steps + now.steps, r.rest.updates + now.updates, now.end};
    if (now.end != hold_end::stable) {
      return r;
    }
    const double miss = o.mixture.main - (on_axis(tube.box().size[2] - 2)[0] + on_axis(1)[1]) / 2;
    laid.gas[0] += miss;
    laid.liquid[1] += miss;
    if (std::abs(miss) > o.near * o.mixture.main) {
      r.rest.end = hold_end::missed;
    }
  }
  r.shift = o.contact_angle > 0 ? wall_shift : tube_shift(o.nodes_per_length / r.pressure);
  const auto laid_law = law.entry_pressure(moved_out(o.section, (r.retraction - r.shift) / o.nodes_per_length));
  r.entry = laid_law.ok() ? r.pressure * r.law / laid_law.value : quiet_nan<double>;
  return r;
}

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
