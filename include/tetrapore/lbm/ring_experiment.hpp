// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/bridge/young_laplace.hpp"
#include "tetrapore/lbm/entry_experiment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

/// \file
/// What the gas leaves behind: it goes through a throat and on, and pendular rings stay at the contacts.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// The ring between two grains of a throat, on the lattice and by the law of bridges of the same volume. A ring loses
/// liquid through the gas, slowly beside the time in which its shape follows: it is compared as it is.
/// \par Units  of the throat: length, 1/length for suctions per surface tension
struct ring_report {
  std::size_t side;  ///< of the opening: the ring between its grain and the next one's
  double gap;
  double neck;     ///< radius of the ring's waist; 0: no liquid, and then all that follows
  double volume;   ///< where liquid outweighs gas, outside the grains as they were given; of the whole ring
  double suction;  ///< pressure of the gas less that where the ring has most liquid
  double law_neck;
  double law_suction;
  bridge_status law;  ///< why the law says so; `no_liquid` where there is no ring, `not_covered` beside a wetting side,
                      ///< whose liquid is none: it is not looked at
};

/// A throat deep enough to be drained.
/// \par Units  lattice units: nodes, steps
/// \tparam T        float or double
/// \tparam Storage  of the nodes: in_place takes any τ, moments 1 alone
template <std::floating_point T = float, class Model = mixture<d3q19, bgk>, storage Storage = leanest_storage<Model>>
class ring_experiment {
 public:
  using simulation_type = simulation<Model, T, Storage>;

  /// Throws parameter_error for a pair that is not as measured.
  /// \param depth  from the plane of the centres to each reservoir, in radii of the largest grain
  explicit ring_experiment(const entry_set_up& s, double depth = 0.8)
      : set_up_(s),
        throat_(s.throat, s.sides, resolution(depth)),
        fluids_(detail::fluids_of<T, Model, Storage>(s, throat_)) {}

  [[nodiscard]] const entry_set_up& set_up() const noexcept { return set_up_; }
  [[nodiscard]] const throat_on_lattice& throat() const noexcept { return throat_; }
  [[nodiscard]] const simulation_type& fluids() const noexcept { return fluids_.simulation_of(); }

  /// Holds a p_c above the entry pressure until the gas has reached the bottom, where the liquid's reservoir stands
  /// like a plate that lets liquid alone through, and then until what is left of the liquid changes by less than 1 % in
  /// 1000 steps. `watch(report so far)` is called every 100 steps. The report's end is `passed` where all went so.
  template <class Watch>
    requires std::invocable<Watch&, const hold_report&>
  [[nodiscard]] hold_report drain(double capillary, Watch watch) {
    hold_report r;
    r.value = capillary;
    if (!fluids_.densities(capillary).ok()) {
      r.end = hold_end::dissolved;
      return r;
    }
    const double level = throat_.middle() + 0.3 * (throat_.box().size[2] - throat_.middle());
    fluids_.start(capillary, [&](const std::array<int, 3>& p) { return detail::first_gas(throat_, p, level); });
    const double bottom = 4 - throat_.middle();
    hold_rules rules = set_up_.rules;
    rules.foresee = false;
    fluids_.wait(
        rules, interface_track(1, 1), 0, r,
        [&](const meniscus_sight& s) {
          r.position = s.apex;
          watch(r);
          return s.apex < bottom ? hold_end::passed : hold_end::step_limit;
        },
        [](const hold_report&) {});
    if (r.end != hold_end::passed) {
      return r;
    }
    double before = 0;
    for (std::uint64_t waited = 0;; waited += held_fluids<T, Model, Storage>::glance) {
      if (waited % 1000 == 0) {
        const double now = fluids_.simulation_of().mass(1);
        if (!std::isfinite(now)) {
          r.end = hold_end::not_finite;
          return r;
        }
        if (std::abs(now - before) < 0.01 * now) {
          return r;
        }
        if (waited >= set_up_.rules.most_steps) {
          r.end = hold_end::drifting;
          return r;
        }
        before = now;
      }
      fluids_.advance(held_fluids<T, Model, Storage>::glance, r);
      watch(r);
    }
  }

  /// Density of the gas less that of the liquid at a place, between the nodes; NaN inside grains.
  [[nodiscard]] double difference_at(const vec3<double>& p) const noexcept {
    const auto& map = fluids_.sites();
    double sum = 0;
    double weight = 0;
    for (int corner = 0; corner < 8; ++corner) {
      std::array<int, 3> q{};
      double share = 1;
      for (std::size_t a = 0; a < 3; ++a) {
        const double low = std::floor(p[a]);
        const bool high = (corner >> a & 1) != 0;
        q[a] = static_cast<int>(low) + (high ? 1 : 0);
        share *= high ? p[a] - low : 1 - (p[a] - low);
      }
      const int top = throat_.box().size[2] - 1;
      q = throat_.standing_for(q[0], q[1], std::clamp(q[2], 0, top));
      if (q[0] < 0 || q[1] < 0 || q[0] >= throat_.box().size[0] || q[1] >= throat_.box().size[1]) {
        continue;
      }
      if (const auto n = map.node_at(q[0], q[1], q[2]); share > 0 && n >= 0 && is_fluid(q)) {
        const auto rho = fluids_.simulation_of().densities_at(static_cast<std::size_t>(n));
        sum += share * (rho[0] - rho[1]);
        weight += share;
      }
    }
    return weight > 0 ? sum / weight : quiet_nan<double>;
  }

  /// The three rings, at the suction that is held. \param capillary  in lattice units
  [[nodiscard]] std::array<ring_report, 3> rings(double capillary) const {
    std::array<ring_report, 3> all{};
    for (std::size_t k = 0; k < 3; ++k) {
      all[k] = ring(k, capillary);
    }
    return all;
  }

 private:
  [[nodiscard]] throat_resolution resolution(double depth) const noexcept {
    const double both = depth * detail::largest_grain(set_up_.throat) * set_up_.nodes_per_length;
    return detail::resolution_of(set_up_, both, both);
  }
  [[nodiscard]] bool is_fluid(const std::array<int, 3>& p) const noexcept {
    const site_kind kind = throat_.at(p[0], p[1], p[2]).kind;
    return kind == site_kind::fluid || kind == site_kind::reservoir;
  }

  [[nodiscard]] ring_report ring(std::size_t k, double capillary) const {
    if (throat_.halved() && throat_.on_face((k + 2) % 3)) {  // in the half that is left out
      ring_report image = ring((k + 1) % 3, capillary);
      image.side = k;
      return image;
    }
    const std::size_t next = (k + 1) % 3;
    const auto a = throat_.grain(k);
    const auto b = throat_.grain(next);
    const double unit = set_up_.nodes_per_length;
    const double distance = norm(b.centre - a.centre);
    const vec2<double> along = (b.centre - a.centre) * (1 / distance);
    const double gap = std::max(0.0, distance - a.radius - b.radius);
    const vec2<double> contact = a.centre + along * (a.radius + gap / 2);

    ring_report r{k, gap / unit, 0, 0, 0, 0, 0, bridge_status::no_liquid};
    if (set_up_.sides[k] == prism_side::wetting) {
      r.law = bridge_status::not_covered;
      return r;
    }
    // the waist, straight up from the contact
    const double top = throat_.box().size[2] - 1 - throat_.middle();
    double below = difference_at({contact.x, contact.y, throat_.middle() + 1});
    for (double z = 1; below < 0 && z + 0.25 < top; z += 0.25) {
      const double here = difference_at({contact.x, contact.y, throat_.middle() + z + 0.25});
      if (here >= 0) {
        r.neck = (z + 0.25 * below / (below - here)) / unit;
        break;
      }
      below = here;
    }
    if (!(r.neck > 0)) {
      return r;
    }
    // liquid around the axis of the pair, between its grains: half of the ring, or a quarter
    const auto rho = fluids_.densities(capillary).value;
    const auto& map = fluids_.sites();
    const double reach = r.neck * unit + 2;
    double nodes = 0;
    double most = 0;
    const double gas = pressure_of(fluids_.pair(), rho.gas);
    for (std::size_t n = 0; n < map.size(); ++n) {
      const auto& p = map.place(n);
      const vec2<double> q{static_cast<double>(p[0]), static_cast<double>(p[1])};
      const double s = dot(q - a.centre, along);
      const double up = p[2] - throat_.middle();
      const double radius = std::hypot(cross(along, q - a.centre), up);
      if (s < 0 || s > distance || radius > reach || std::hypot(s, radius) < a.radius ||
          std::hypot(distance - s, radius) < b.radius) {
        continue;
      }
      const double liquid = fluids_.simulation_of().density(1, n);
      if (liquid > most) {
        most = liquid;
        r.suction = (gas - fluids_.pressure_at(n)) / set_up_.pair.surface_tension * unit;
      }
      nodes += fluids_.simulation_of().density(0, n) < liquid ? 1 : 0;
    }
    const bool quarter = throat_.halved() && throat_.on_face(k);
    r.volume = nodes * (quarter ? 4 : 2) / (unit * unit * unit);
    const young_laplace<> law{
        .surface_tension = 1.0, .contact_angle1 = set_up_.contact_angle, .contact_angle2 = set_up_.contact_angle};
    const auto bridge = law.bridge(edge<double>{a.radius / unit, b.radius / unit, gap / unit, {1, 0, 0}},
                                   given_volume<double>{r.volume});
    r.law = bridge.reason;
    r.law_neck = bridge.value.neck;
    r.law_suction = bridge.value.suction;
    return r;
  }

  entry_set_up set_up_;
  throat_on_lattice throat_;
  held_fluids<T, Model, Storage> fluids_;
};

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
