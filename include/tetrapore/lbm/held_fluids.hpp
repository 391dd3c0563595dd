// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/checkpoint.hpp"
#include "tetrapore/lbm/coexistence.hpp"
#include "tetrapore/lbm/experiment.hpp"
#include "tetrapore/lbm/moments.hpp"
#include "tetrapore/lbm/simulation.hpp"
#include "tetrapore/lbm/state_numbers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

/// \file
/// Gas above a wetting liquid between two reservoirs whose difference of pressure is held: what experiments with a
/// meniscus share.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// How long a hold lasts and what counts as rest. \par Units  lattice units
struct hold_rules {
  std::uint64_t ramp = 500;          ///< steps over which p_c changes
  std::uint64_t most_steps = 20000;  ///< of a hold
  double still = 0.006;              ///< nodes per 1000 steps: an apex that moves less rests
  double still_mass = 1e-3;          ///< share of the gas's mass per 1000 steps: less is no drift
  double flow = 0.02;                ///< share of p_c by which the fluids may differ from it: more, and something flows
  bool foresee = true;               ///< a hold ends where it is clear how it would end
};

/// What is seen of the fluids.
struct meniscus_sight {
  double apex;  ///< of the lowest point at which gas outweighs liquid, above the middle
  double gas;   ///< mass of its component where nothing holds it
  bool finite;
  bool has_gas;
  bool has_liquid;
};

/// The storage of a throat's fluids: moments where the collision at τ = 1 leaves nothing else, 1.5 times as fast.
template <class Model>
inline constexpr storage leanest_storage = requires {
  requires Model::collision_type::equilibrium_at_one;
} && !Model::forcing_type::carries_source ? storage::moments : storage::in_place;

/// Two components of a calibrated pair on the nodes of a domain, the first the gas.
/// \par Units  lattice units: nodes, steps
/// \tparam T        float or double
/// \tparam Storage  in_place, or moments where τ is 1
template <std::floating_point T, class Model, storage Storage = leanest_storage<Model>>
class held_fluids {
  static_assert(Storage != storage::two_lattices, "held_fluids takes storage::in_place or storage::moments");
  static_assert(Model::components == 2, "held_fluids: a gas and a liquid, two components");
  static_assert(Model::lattice_type::dimensions == 3, "held_fluids: a meniscus is seen along z, on three dimensions");
  static_assert(std::same_as<decltype(Model::potential), linear_potential>,
                "held_fluids: reservoirs are known for psi = rho");

 public:
  using simulation_type = simulation<Model, T, Storage>;
  using lattice_type = typename Model::lattice_type;
  /// Steps between looks; even: populations then lie at their own node.
  static constexpr std::uint64_t glance = 100;

  /// \param middle  z of what positions are counted from
  held_fluids(const coexistence& pair, double gas_share, site_map<lattice_type> map, double middle, std::uint8_t above,
              std::uint8_t below, double tau = 1)
      : pair_(pair),
        gas_share_(gas_share),
        middle_(middle),
        above_(above),
        below_tag_(below),
        sim_(model_of(pair, tau), std::move(map)) {
    const auto& nodes = sim_.sites();
    below_.resize(nodes.size());
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const auto& p = nodes.place(n);
      below_[n] = p[2] > 0 ? nodes.node_at(p[0], p[1], p[2] - 1) : site_map<lattice_type>::none;
    }
  }

  [[nodiscard]] const simulation_type& simulation_of() const noexcept { return sim_; }
  [[nodiscard]] const site_map<lattice_type>& sites() const noexcept { return sim_.sites(); }
  [[nodiscard]] const coexistence& pair() const noexcept { return pair_; }
  [[nodiscard]] bool started() const noexcept { return held_ != none; }
  void set_wall(std::uint8_t tag, const std::array<double, 2>& rho) { sim_.set_wall(tag, rho); }

  [[nodiscard]] outcome<reservoir_pair, coexistence_status> densities(double capillary) const noexcept {
    return reservoirs(pair_, capillary, gas_share_);
  }

  /// The first state: `gas(place)` in 0 … 1.
  template <class Gas>
  void start(double capillary, Gas gas) {
    const reservoir_pair rho = densities(capillary).value;
    sim_.initialise([&](const std::array<int, 3>& p, auto& at, auto&) {
      const double share = gas(p);
      for (std::size_t c = 0; c < 2; ++c) {
        at[c] = rho.liquid[c] + (rho.gas[c] - rho.liquid[c]) * share;
      }
    });
    set(rho);
    held_ = capillary;
  }

  /// p_c goes from what is held to a new value, its slope 0 at both ends.
  void ramp(double capillary, std::uint64_t steps, hold_report& r) {
    if (held_ != capillary) {
      constexpr std::uint64_t piece = 20;
      const double from = held_;
      for (std::uint64_t done = piece; done <= steps; done += piece) {
        const double s = static_cast<double>(done) / static_cast<double>(steps);
        set(densities(from + (capillary - from) * s * s * (3 - 2 * s)).value);
        advance(piece, r);
      }
      held_ = capillary;
    }
    set(densities(capillary).value);
  }

  void advance(std::uint64_t steps, hold_report& r) {
    sim_.run(steps);
    r.steps += steps;
    r.updates += steps * sim_.sites().size();
  }

  [[nodiscard]] meniscus_sight look() const {
    const auto& map = sim_.sites();
    meniscus_sight o{std::numeric_limits<double>::infinity(), 0, true, false, false};
    for (std::size_t n = 0; n < map.size(); ++n) {
      const auto rho = sim_.densities_at(n);
      const bool held = map.at(n).kind == site_kind::reservoir;
      o.finite = o.finite && std::isfinite(rho[0]) && std::isfinite(rho[1]);
      o.gas += held ? 0 : rho[0];
      if (!(rho[0] > rho[1])) {
        o.has_liquid = o.has_liquid || !held;
        continue;
      }
      o.has_gas = o.has_gas || !held;
      double z = map.place(n)[2];
      if (z > o.apex + 1) {
        continue;
      }
      if (below_[n] != site_map<lattice_type>::none) {
        const auto under = sim_.densities_at(static_cast<std::size_t>(below_[n]));
        const double here = rho[0] - rho[1];
        const double there = under[0] - under[1];
        if (there <= 0) {
          z -= here / (here - there);
        }
      }
      o.apex = std::min(o.apex, z);
    }
    o.apex -= middle_;
    return o;
  }

  /// Looks at the fluids until they rest, have passed, or something is wrong. `done(sight)` may end the hold by an end
  /// of its own; `watch(report so far)` is called after every 1000 steps.
  template <class Done, class Watch>
  void wait(const hold_rules& rules, interface_track track, double level, hold_report& r, Done done, Watch watch) {
    constexpr std::uint64_t window = 1000;
    meniscus_sight now = look();
    meniscus_sight before = now;
    for (std::uint64_t waited = 0;; waited += glance) {
      r.position = now.apex;
      track.add(now.apex);
      if (!now.finite) {
        r.end = hold_end::not_finite;
        return;
      }
      if (!now.has_gas || !now.has_liquid) {
        r.end = hold_end::dissolved;
        return;
      }
      if (const auto end = done(now); end != hold_end::step_limit) {
        r.end = end;
        return;
      }
      if (rules.foresee && track.runs_away(level)) {
        r.end = hold_end::passed;
        return;
      }
      if (waited > 0 && waited % window == 0) {
        const bool rests = std::abs(now.apex - before.apex) < rules.still;
        const bool keeps_mass = std::abs(now.gas - before.gas) < rules.still_mass * now.gas;
        if (rests && keeps_mass) {
          r.end = hold_end::stable;
          return;
        }
        if (r.steps >= rules.most_steps) {
          r.end = rests ? hold_end::drifting : hold_end::step_limit;
          return;
        }
        before = now;
        watch(r);
      }
      if (rules.foresee && track.comes_to_rest()) {
        r.end = hold_end::stable;
        return;
      }
      advance(glance, r);
      now = look();
    }
  }

  [[nodiscard]] double pressure_at(std::size_t node) const noexcept {
    return sim_.model().pressure(sim_.densities_at(node));
  }

  /// The present state becomes the one that holds start from.
  void keep() {
    copy_state(sim_, kept_);
    kept_at_ = held_;
  }
  void back() {
    held_ = kept_at_;
    if (held_ != none) {
      put_state(sim_, kept_);
    }
  }

  void save(checkpoint_writer& out) const {
    out.append(std::uint32_t{Storage == storage::moments});
    out.append(std::uint32_t{sizeof(T)});
    out.append(kept_at_);
    out.append(std::span<const T>(kept_));
  }
  /// Everything that `save` wrote, the last of a state; nothing is changed where it is not all there.
  /// \throw input_error  fewer or more numbers, or those of another storage or precision
  void restore(checkpoint_reader& in) {
    std::uint32_t moments = 0;
    std::uint32_t bytes = 0;
    in.take(moments);
    in.take(bytes);
    if (moments != std::uint32_t{Storage == storage::moments} || bytes != sizeof(T)) {
      in.refuse(kept_as(moments != 0, bytes), kept_as(Storage == storage::moments, sizeof(T)));
    }
    double at = none;
    in.take(at);
    std::vector<T> state(at == none ? 0 : state_size(sim_));
    in.take(std::span<T>(state));
    in.finish();
    kept_ = std::move(state);
    kept_at_ = at;
    back();
  }

 private:
  static constexpr double none = -std::numeric_limits<double>::max();

  [[nodiscard]] static Model model_of(const coexistence& pair, double tau) noexcept {
    Model m;
    m.collisions[0].tau = m.collisions[1].tau = tau;
    m.attraction = {{{0, pair.attraction}, {pair.attraction, 0}}};
    m.reference = {1, 1};
    return m;
  }
  void set(const reservoir_pair& rho) {
    sim_.set_reservoir(above_, rho.gas);
    sim_.set_reservoir(below_tag_, rho.liquid);
  }
  [[nodiscard]] static std::string kept_as(bool moments, std::size_t bytes) {
    return std::string(moments ? "moments" : "populations") + " in numbers of " + std::to_string(bytes) + " bytes";
  }

  coexistence pair_;
  double gas_share_;
  double middle_;
  std::uint8_t above_;
  std::uint8_t below_tag_;
  simulation_type sim_;
  std::vector<std::int32_t> below_;
  std::vector<T> kept_;
  double kept_at_ = none;  ///< p_c of the kept state
  double held_ = none;     ///< p_c of the present one
};

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
