// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/entry/inscribed_circle.hpp"
#include "tetrapore/law/entry/mayer_stowe_princen.hpp"
#include "tetrapore/law/entry/mirror_sided.hpp"
#include "tetrapore/lbm/checkpoint.hpp"
#include "tetrapore/lbm/coexistence.hpp"
#include "tetrapore/lbm/experiment.hpp"
#include "tetrapore/lbm/simulation.hpp"
#include "tetrapore/lbm/throat.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

/// \file
/// Entry pressure of a throat by experiment: gas above, wetting liquid below, a capillary pressure that is held until
/// the meniscus rests or has passed.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// The measured pairs of `calibrate_pair`: G = 1.8 leaves an interface of 2.9 nodes and slow spurious currents.
inline constexpr calibrated_pair pair_18{1.8, 1.003, 1.99526, 0.5, 0.0877, 0.0870, 0.14};

/// The densities that a wall shows where the contact angle is θ; at 0 those of the liquid itself, twice what the angle
/// asks for, so that a film covers the wall.
/// \par Units     lattice units; θ [rad], 0 to below π/2
/// \par Accuracy  above 0 not measured: a rule of ψ = ρ, no fit
/// \par Source    Huang, Thorne, Schaap & Sukop, Phys. Rev. E 76, 066701 (2007), with the wall's densities as strength
[[nodiscard]] inline std::array<double, 2> wall_densities(const coexistence& pair, double contact_angle) {
  const auto dissolved = dissolved_density(pair);
  if (!dissolved.ok()) {
    throw parameter_error("mixture", describe(dissolved.reason), "two phases");
  }
  if (!(contact_angle >= 0 && contact_angle < pi<double> / 2)) {
    throw parameter_error("contact angle", short_number(contact_angle) + " rad", "0 to below a right angle");
  }
  if (contact_angle == 0) {
    return {dissolved.value, pair.main};
  }
  const double mean = (pair.main + dissolved.value) / 2;
  const double half = std::cos(contact_angle) * (pair.main - dissolved.value) / 4;
  return {mean - half, mean + half};
}

/// What an entry pressure measured with r_in nodes is to be multiplied by: films and interfaces of finite width.
/// \par Domain    θ = 0, grains retracted by 1.1 nodes, `pair_18`, r_in from 2 nodes
/// \par Accuracy  5 % from r_in = 4 on. Calibrated on three equal touching spheres at r_in = 2.3, 3.0 and 4.0 alone,
///                against their Surface Evolver value; with gaps of 0.4 R −12, −5, 0, +4 % are left at
///                2.3, 3.0, 4.0 and 8.4 nodes
[[nodiscard]] constexpr double entry_correction(double inscribed) noexcept {
  return 1 + 0.91 / (inscribed * inscribed);
}

/// What an entry experiment is made of.
/// \par Units  lattice units but where said
struct entry_set_up {
  opening<double> throat;  ///< three discs, in any unit of length
  std::array<prism_side, 3> sides{};
  double nodes_per_length = 1;  ///< nodes per unit of the throat
  double retraction = 1.1;      ///< nodes by which grains shrink: room for the film
  double clear = 1.1;           ///< how far the reservoirs lie, in radii of the largest grain
  double contact_angle = 0;     ///< [rad]
  calibrated_pair pair = pair_18;
  double gas_share = 0.5;            ///< of p_c that raises the gas; the rest lowers the liquid
  std::uint64_t ramp = 2000;         ///< steps over which p_c changes
  std::uint64_t most_steps = 20000;  ///< of a hold
  double still = 0.006;              ///< nodes per 1000 steps: an apex that moves less rests
  double still_mass = 1e-3;          ///< share of the gas's mass per 1000 steps: less is no drift
};

/// The plane picture of a throat: what the experiment is compared with, and its first bracket.
/// \par Units  of the throat: length, 1/length for pressures per surface tension
struct plane_entry {
  double inscribed;  ///< radius of the inscribed circle
  double princen;    ///< p/σ of Mayer, Stowe & Princen: arcs in all gaps
  double best;       ///< p/σ, the least over all choices of gaps that the gas may cross
};

/// Throws parameter_error where no law covers the throat.
[[nodiscard]] inline plane_entry plane_entry_of(const opening<double>& o, const std::array<prism_side, 3>& sides,
                                                double contact_angle = 0) {
  const mayer_stowe_princen arcs{.surface_tension = 1.0, .contact_angle = contact_angle};
  const auto circle = inscribed_circle{.surface_tension = 1.0, .contact_angle = 0.0}.entry_pressure(o);
  const auto princen = arcs.entry_pressure(o);
  auto best = princen;
  for (unsigned open = 1; open < 8; ++open) {
    opening<double> trial = o;
    bool mirrors = true;
    for (std::size_t k = 0; k < 3; ++k) {
      if ((open >> k & 1U) != 0) {
        trial.gaps[k] = gap_state::open;
        const auto d = o.sides[o.next(k)].point - o.sides[k].point;
        const double sum = o.sides[k].radius + o.sides[o.next(k)].radius;
        mirrors = mirrors && sides[k] == prism_side::mirror && dot(d, d) > sum * sum;
      }
    }
    if (mirrors) {
      const auto answer = arcs.entry_pressure(trial);
      if (answer.ok() && !(best.ok() && best.value <= answer.value)) {
        best = answer;
      }
    }
  }
  if (!circle.ok() || !best.ok()) {
    throw parameter_error("throat", describe(circle.ok() ? best.reason : circle.reason), "one with an entry pressure");
  }
  return {2 / circle.value, princen.value, best.value};
}

/// A throat in which p_c can be held.
/// \par Units  lattice units: nodes, steps; positions of the apex are above the plane of the grains' centres
/// \tparam T  float or double
template <std::floating_point T = float, class Model = mixture<d3q19, bgk>>
class entry_experiment {
 public:
  using simulation_type = simulation<Model, T>;

  /// Throws parameter_error for a throat that no law covers or that leaves the lattice no room.
  explicit entry_experiment(const entry_set_up& s)
      : set_up_(s),
        plane_(plane_entry_of(s.throat, s.sides, s.contact_angle)),
        pair_{s.pair.attraction, s.pair.factor, s.pair.common, s.pair.main},
        throat_(s.throat, s.sides, resolution()),
        sim_(model(), throat_.template sites<d3q19>()) {
    if (!(s.still > 0) || !(s.still_mass > 0) || s.most_steps < window) {
      throw parameter_error("hold", "no motion that counts as rest, or fewer than 1000 steps", "more");
    }
    sim_.set_wall(grain_wall, wall_densities(pair_, s.contact_angle));
    sim_.set_wall(liquid_wall, wall_densities(pair_, 0));
    find_columns();
  }

  [[nodiscard]] const plane_entry& plane() const noexcept { return plane_; }
  [[nodiscard]] const entry_set_up& set_up() const noexcept { return set_up_; }
  [[nodiscard]] const throat_on_lattice& throat() const noexcept { return throat_; }
  [[nodiscard]] const simulation_type& fluids() const noexcept { return sim_; }
  [[nodiscard]] std::size_t fluid_nodes() const noexcept { return sim_.sites().size(); }
  /// Radius of the inscribed circle in nodes.
  [[nodiscard]] double inscribed() const noexcept { return plane_.inscribed * set_up_.nodes_per_length; }

  /// p_c in lattice units of a pressure per surface tension in 1/length of the throat.
  [[nodiscard]] double lattice_pressure(double per_tension) const noexcept {
    return per_tension * set_up_.pair.surface_tension / set_up_.nodes_per_length;
  }

  /// Bisection around `factor` × the least plane entry pressure.
  [[nodiscard]] search_options bracket(double factor = 1, double width = 0.03) const noexcept {
    const double p = factor * lattice_pressure(plane_.best);
    return {.lower = 0.7 * p, .upper = 1.3 * p, .width = width};
  }

  /// Holds p_c, from the kept state or else from a meniscus well above the throat, until the apex rests or has passed.
  [[nodiscard]] hold_report hold(double capillary) {
    return hold(capillary, [](const hold_report&) {});
  }
  /// The same; `watch(report so far)` is called after every 1000 steps.
  template <class Watch>
    requires std::invocable<Watch&, const hold_report&>
  [[nodiscard]] hold_report hold(double capillary, Watch watch) {
    hold_report r;
    r.value = capillary;
    const auto target = reservoirs(pair_, capillary, set_up_.gas_share);
    if (!target.ok()) {
      r.end = hold_end::dissolved;
      return r;
    }
    if (held_ == none) {
      start(target.value);
      held_ = capillary;
    }
    ramp(capillary, r);
    const double passed = -(inscribed() + 0.25 * smallest());
    observation before = observe();
    for (;;) {
      r.position = before.apex;
      if (!step_on(window, passed, r)) {
        return finish(r, observe());
      }
      const observation now = observe();
      const bool rests = std::abs(now.apex - before.apex) < set_up_.still;
      const bool keeps_mass = std::abs(now.gas - before.gas) < set_up_.still_mass * now.gas;
      before = now;
      r.position = now.apex;
      if (rests && keeps_mass) {
        r.end = hold_end::stable;
        return finish(r, now);
      }
      if (r.steps >= set_up_.most_steps) {
        r.end = rests ? hold_end::drifting : hold_end::step_limit;
        return finish(r, now);
      }
      watch(r);
    }
  }

  /// The present state becomes the one that holds start from.
  void keep() {
    kept_.resize(Model::components * sim_.sites().size() * Model::directions);
    std::size_t at = 0;
    for_each_population([&](const T& f) { kept_[at++] = f; });
    kept_at_ = held_;
  }
  void back() {
    held_ = kept_at_;
    if (held_ == none) {
      return;
    }
    std::size_t at = 0;
    for_each_population([&](T& f) { f = kept_[at++]; });
  }

  /// The kept state and where a search stands, as bytes.
  [[nodiscard]] std::vector<std::byte> save(const threshold_search& search) const {
    checkpoint_writer out(fingerprint());
    out.append(search.now());
    out.append(kept_at_);
    out.append(std::span<const T>(kept_));
    return std::move(out).finish();
  }
  /// What `save` made of an experiment of the same set-up; the search goes on where it stood.
  /// \throw input_error  no such state, cut short, damaged, or of another experiment; nothing is changed then
  [[nodiscard]] threshold_search restore(std::span<const std::byte> bytes, const search_options& options,
                                         const std::string& where = "state") {
    checkpoint_reader in(bytes, fingerprint(), where);
    threshold_search::memory memory;
    double at = none;
    in.take(memory);
    in.take(at);
    std::vector<T> populations(at == none ? 0 : Model::components * sim_.sites().size() * Model::directions);
    in.take(std::span<T>(populations));
    in.finish();
    kept_ = std::move(populations);
    kept_at_ = at;
    back();
    return {options, memory};
  }

 private:
  static constexpr std::uint64_t window = 1000;
  static constexpr std::uint64_t glance = 200;  // even: between looks, populations lie at their own node
  static constexpr double none = -std::numeric_limits<double>::max();

  struct observation {
    double apex;  ///< of the lowest point at which gas outweighs liquid
    double gas;   ///< mass of its component
    bool finite;
    bool has_gas;
    bool has_liquid;
  };

  [[nodiscard]] double smallest() const noexcept {
    return set_up_.nodes_per_length *
           std::min({set_up_.throat.sides[0].radius, set_up_.throat.sides[1].radius, set_up_.throat.sides[2].radius});
  }
  [[nodiscard]] double largest() const noexcept {
    return set_up_.nodes_per_length *
           std::max({set_up_.throat.sides[0].radius, set_up_.throat.sides[1].radius, set_up_.throat.sides[2].radius});
  }
  [[nodiscard]] throat_resolution resolution() const noexcept {
    const double reach = set_up_.clear * largest();
    return {set_up_.nodes_per_length, set_up_.retraction, reach, std::max(reach, inscribed() + 0.25 * smallest() + 6)};
  }
  [[nodiscard]] Model model() const noexcept {
    Model m;
    m.attraction = {{{0, set_up_.pair.attraction}, {set_up_.pair.attraction, 0}}};
    m.reference = {1, 1};
    return m;
  }

  /// Gas above 0.45 R over the plane of the centres, liquid below, a film of it on the grains.
  void start(const reservoir_pair& rho) {
    const double level = throat_.middle() + 0.45 * smallest();
    sim_.initialise([&](const std::array<int, 3>& p, auto& at, auto&) {
      const double gas = near_grain(p) ? 0 : 0.5 * (1 + std::tanh((p[2] - level) / 1.5));
      for (std::size_t c = 0; c < 2; ++c) {
        at[c] = rho.liquid[c] + (rho.gas[c] - rho.liquid[c]) * gas;
      }
    });
    set(rho);
  }
  [[nodiscard]] bool near_grain(const std::array<int, 3>& p) const noexcept {
    constexpr int film = 2;
    const auto& size = throat_.box().size;
    for (int x = std::max(0, p[0] - film); x <= std::min(size[0] - 1, p[0] + film); ++x) {
      for (int y = std::max(0, p[1] - film); y <= std::min(size[1] - 1, p[1] + film); ++y) {
        for (int z = std::max(0, p[2] - film); z <= std::min(size[2] - 1, p[2] + film); ++z) {
          const site s = throat_.at(x, y, z);
          if (s.kind == site_kind::solid && s.tag == grain_wall) {
            return true;
          }
        }
      }
    }
    return false;
  }
  void set(const reservoir_pair& rho) {
    sim_.set_reservoir(reservoir_above, rho.gas);
    sim_.set_reservoir(reservoir_below, rho.liquid);
  }

  /// p_c goes from what is held to a new value, its slope 0 at both ends.
  void ramp(double capillary, hold_report& r) {
    if (held_ != capillary) {
      constexpr std::uint64_t piece = 20;
      const double from = held_;
      for (std::uint64_t done = piece; done <= set_up_.ramp; done += piece) {
        const double s = static_cast<double>(done) / static_cast<double>(set_up_.ramp);
        set(reservoirs(pair_, from + (capillary - from) * s * s * (3 - 2 * s), set_up_.gas_share).value);
        advance(piece, r);
      }
      held_ = capillary;
    }
    set(reservoirs(pair_, capillary, set_up_.gas_share).value);
  }
  void advance(std::uint64_t steps, hold_report& r) {
    sim_.run(steps);
    r.steps += steps;
    r.updates += steps * sim_.sites().size();
  }
  /// Steps with a glance at the apex now and then; false, with the end, when there is nothing more to wait for.
  [[nodiscard]] bool step_on(std::uint64_t steps, double passed, hold_report& r) {
    for (std::uint64_t done = 0; done < steps; done += glance) {
      advance(glance, r);
      const observation now = observe();
      r.position = now.apex;
      if (!now.finite) {
        r.end = hold_end::not_finite;
        return false;
      }
      if (!now.has_gas || !now.has_liquid) {
        r.end = hold_end::dissolved;
        return false;
      }
      if (now.apex < passed) {
        r.end = hold_end::passed;
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] hold_report finish(hold_report r, const observation& o) const {
    r.position = o.apex;
    r.measured = pressure_at(throat_.box().size[2] - 2) - pressure_at(1);
    return r;
  }

  void find_columns() {
    const auto& map = sim_.sites();
    below_.resize(map.size());
    for (std::size_t n = 0; n < map.size(); ++n) {
      const auto& p = map.place(n);
      below_[n] = p[2] > 0 ? map.node_at(p[0], p[1], p[2] - 1) : site_map<d3q19>::none;
    }
  }
  [[nodiscard]] observation observe() const {
    const auto& map = sim_.sites();
    observation o{std::numeric_limits<double>::infinity(), 0, true, false, false};
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
      if (below_[n] != site_map<d3q19>::none) {
        const auto under = sim_.densities_at(static_cast<std::size_t>(below_[n]));
        const double here = rho[0] - rho[1];
        const double there = under[0] - under[1];
        if (there <= 0) {
          z -= here / (here - there);
        }
      }
      o.apex = std::min(o.apex, z);
    }
    o.apex -= throat_.middle();
    return o;
  }
  /// The middle one of the pressures of a level's nodes: the film on the grains below the reservoir is few of them.
  [[nodiscard]] double pressure_at(int level) const {
    const auto& map = sim_.sites();
    std::vector<double> all;
    for (std::size_t n = 0; n < map.size(); ++n) {
      if (map.place(n)[2] == level) {
        all.push_back(sim_.model().pressure(sim_.densities_at(n)));
      }
    }
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    return *middle;
  }

  template <class Do>
  void for_each_population(Do apply) {
    for (std::size_t c = 0; c < Model::components; ++c) {
      for (std::size_t i = 0; i < Model::directions; ++i) {
        for (std::size_t n = 0; n < sim_.sites().size(); ++n) {
          apply(sim_.population(c, n, i));
        }
      }
    }
  }

  [[nodiscard]] std::uint64_t fingerprint() const noexcept {
    parameter_hash h;
    h.add(std::uint64_t{sizeof(T)}).add(std::uint64_t{sim_.sites().size()});
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& side = set_up_.throat.sides[k];
      h.add(side.point.x).add(side.point.y).add(side.radius);
      h.add(static_cast<std::uint64_t>(set_up_.sides[k]));
    }
    const calibrated_pair& p = set_up_.pair;
    for (const double x :
         {set_up_.nodes_per_length, set_up_.retraction, set_up_.clear, set_up_.contact_angle, set_up_.gas_share,
          set_up_.still, set_up_.still_mass, p.attraction, p.factor, p.common, p.main, p.surface_tension}) {
      h.add(x);
    }
    return h.add(set_up_.ramp).add(set_up_.most_steps).value();
  }

  entry_set_up set_up_;
  plane_entry plane_;
  coexistence pair_;
  throat_on_lattice throat_;
  simulation_type sim_;
  std::vector<std::int32_t> below_;
  std::vector<T> kept_;
  double kept_at_ = none;  ///< p_c of the kept state
  double held_ = none;     ///< p_c of the present one
};
static_assert(held_experiment<entry_experiment<>>);

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
