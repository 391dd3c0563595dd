// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/entry/mayer_stowe_princen.hpp"
#include "tetrapore/lbm/entry_experiment.hpp"
#include "tetrapore/lbm/tube.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

/// \file
/// Entry pressure of a straight tube by experiment: a meniscus in it goes on above the entry pressure and back below.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// What a tube experiment is made of. \par Units  lattice units but where said
struct tube_set_up {
  opening<double> section;      ///< lines around a convex polygon, in any unit of length
  double nodes_per_length = 1;  ///< nodes per unit of the section
  double retraction = 1.1;      ///< nodes by which walls move out: room for the film
  double length = 5;            ///< of the tube, in radii σ/p of the highest arc that enters
  double plug = 4;              ///< nodes that the upper reservoir keeps from the walls
  double contact_angle = 0;     ///< [rad]
  calibrated_pair pair = pair_18;
  double gas_share = 0.5;
  std::size_t most_nodes = 1000000;
  hold_rules rules{};
};

/// A tube in which p_c can be held: no meniscus rests in it but at its entry pressure.
/// \par Units  lattice units
/// \tparam T  float or double
template <std::floating_point T = float, class Model = mixture<d3q19, bgk>>
class tube_experiment {
 public:
  using simulation_type = simulation<Model, T>;

  /// Throws parameter_error for a section that the law does not cover or the lattice has no room for.
  explicit tube_experiment(const tube_set_up& s)
      : set_up_(s),
        plane_(plane_of(s)),
        tube_(s.section,
              {s.nodes_per_length, s.retraction, s.length * 2 * s.nodes_per_length / plane_ + 8, s.plug, s.most_nodes}),
        fluids_({s.pair.attraction, s.pair.factor, s.pair.common, s.pair.main}, s.gas_share,
                tube_.template sites<d3q19>(), tube_.middle(), tube_above, tube_below) {
    fluids_.set_wall(tube_wall, wall_densities(fluids_.pair(), s.contact_angle));
  }

  [[nodiscard]] const tube_set_up& set_up() const noexcept { return set_up_; }
  [[nodiscard]] const tube_on_lattice& tube() const noexcept { return tube_; }
  [[nodiscard]] const simulation_type& fluids() const noexcept { return fluids_.simulation_of(); }
  [[nodiscard]] std::size_t fluid_nodes() const noexcept { return fluids_.sites().size(); }
  /// p/σ of the law for the section. \par Units  1/length of the section
  [[nodiscard]] double plane() const noexcept { return plane_; }

  [[nodiscard]] double lattice_pressure(double per_tension) const noexcept {
    return per_tension * set_up_.pair.surface_tension / set_up_.nodes_per_length;
  }
  [[nodiscard]] search_options bracket(double factor = 1, double width = 0.02) const noexcept {
    const double p = factor * lattice_pressure(plane_);
    return {.lower = (1 - width) * p, .upper = (1 + width) * p, .width = width, .widen = 1 + 2 * width};
  }

  /// Holds p_c until the meniscus has gone the way of half a node, on or back.
  [[nodiscard]] hold_report hold(double capillary) {
    hold_report r;
    r.value = capillary;
    if (!fluids_.densities(capillary).ok()) {
      r.end = hold_end::dissolved;
      return r;
    }
    if (!fluids_.started()) {
      const double arc = set_up_.nodes_per_length / plane_;  // radius of the arcs in the corners
      fluids_.start(capillary, [&](const std::array<int, 3>& p) {
        constexpr double film = 0.5;  // on the polygon itself; more behind it, where its walls have moved out
        return tube_.to_core(p[0], p[1], arc) > arc - film ? 0 : 0.5 * (1 + std::tanh((p[2] - tube_.middle()) / 1.5));
      });
    }
    fluids_.ramp(capillary, set_up_.rules.ramp, r);
    std::vector<double> apex;
    constexpr std::size_t settled = 1500 / held_fluids<T, Model>::glance;
    hold_rules rules = set_up_.rules;
    rules.foresee = false;
    fluids_.wait(
        rules, interface_track(1, 1), 0, r,
        [&](const meniscus_sight& s) {
          apex.push_back(s.apex);
          if (apex.size() <= settled) {
            return hold_end::step_limit;
          }
          // a way that the second half of the time has its share in: corners that drain move the apex at first
          const double way = s.apex - apex[settled];
          const double half = s.apex - apex[(settled + apex.size()) / 2];
          if (std::abs(way) < 0.5 || half / way < 0.4) {
            return hold_end::step_limit;
          }
          return way > 0 ? hold_end::withdrew : hold_end::passed;
        },
        [](const hold_report&) {});
    return r;
  }
  void keep() { fluids_.keep(); }
  void back() { fluids_.back(); }

 private:
  [[nodiscard]] static double plane_of(const tube_set_up& s) {
    const auto p =
        mayer_stowe_princen{.surface_tension = 1.0, .contact_angle = s.contact_angle}.entry_pressure(s.section);
    if (!p.ok()) {
      throw parameter_error("tube", describe(p.reason), "a section with an entry pressure");
    }
    return p.value;
  }

  tube_set_up set_up_;
  double plane_;
  tube_on_lattice tube_;
  held_fluids<T, Model> fluids_;
};
static_assert(held_experiment<tube_experiment<>>);

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
