// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/error.hpp"
#include "tetrapore/core/outcome.hpp"
#include "tetrapore/geometry/primitives.hpp"
#include "tetrapore/lbm/curved_walls.hpp"
#include "tetrapore/lbm/kept_waits.hpp"
#include "tetrapore/lbm/measurement.hpp"
#include "tetrapore/lbm/simulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

/// \file
/// The permeability of spheres in a periodic box, by one fluid on the nodes between them.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// Why an experiment ended.
enum class flow_status : unsigned char {
  steady,          ///< the flux changes less than asked
  still_changing,  ///< the cap of steps came first: no answer
  unstable         ///< NaN, or a velocity near that of sound
};

[[nodiscard]] constexpr verdict verdict_of(flow_status s) noexcept {
  return s == flow_status::steady ? verdict::ok : verdict::failed;
}
[[nodiscard]] constexpr const char* describe(flow_status s) noexcept {
  switch (s) {
    case flow_status::steady: return "the flux is steady";
    case flow_status::still_changing: return "the flux still changes after the last step allowed";
    case flow_status::unstable: return "the populations grew without bound";
  }
  return "not a flow status";
}
static_assert(status<flow_status>);

/// The box of a periodic packing and its spheres.
/// \par Units  any one length; the box begins at 0
struct periodic_spheres {
  std::array<double, 3> box;
  std::vector<sphere<double>> spheres;
  /// Axes of which half of the box, from 0 to its middle, is the whole by mirrors; the flow may not be along one.
  std::array<bool, 3> halved{};
};

struct permeability_options {
  double tau = 1;        ///< of the shear; the flux does not depend on it
  double steady = 1e-7;  ///< relative change of the flux in the time that momentum takes across a node's width × 100
  std::size_t cap = 200000;    ///< steps
  kept_waits* kept = nullptr;  ///< where to go on from, and where states are saved
};

/// \par Units  permeability in the square of the unit of length
struct lattice_permeability {
  double permeability;
  double node;      ///< width of a node [unit of length]
  double porosity;  ///< of the nodes
  std::size_t fluid_nodes;
  std::size_t wall_links;      ///< from a fluid node to a solid one
  std::size_t half_way_links;  ///< those whose wall is taken half-way, for want of a node on their other side
  std::size_t steps;
  std::size_t taken_up;  ///< of the steps: made by runs before this one
  double change;         ///< of the flux, relative, when it was looked at last

  [[nodiscard]] std::size_t updates() const noexcept { return fluid_nodes * steps; }
};

/// What two lattices of different nodes say of the limit, as if the error were of the second order.
/// \par Accuracy  what half-way links leave is of the first order and comes on top: −1.7 % in a random packing of
///                fraction 0.60 with 9 nodes to the radius, 14 % of whose wall links are half-way
struct permeability_limit {
  double permeability;
  double discretisation;  ///< relative, of the finer lattice
};
[[nodiscard]] inline permeability_limit extrapolated(const lattice_permeability& coarse,
                                                     const lattice_permeability& fine) noexcept {
  const double ratio = coarse.node / fine.node;
  const double limit = (ratio * ratio * fine.permeability - coarse.permeability) / (ratio * ratio - 1);
  return {limit, std::abs(fine.permeability / limit - 1)};
}

/// Of one lattice the error is not known: two of them tell (`extrapolated`).
[[nodiscard]] inline measurement measured(const outcome<lattice_permeability, flow_status>& o) noexcept {
  const lattice_permeability& r = o.value;
  return {r.permeability,
          r.permeability * (1 - r.change),
          r.permeability * (1 + r.change),
          quiet_nan<double>,
          r.updates(),
          verdict_of(o.reason),
          describe(o.reason)};
}
static_assert(experiment_result<outcome<lattice_permeability, flow_status>>);

namespace detail {

/// The nodes that spheres leave free, and where spheres cut their links.
template <lattice L>
class sphere_nodes {
 public:
  /// Of the node at a place: a sphere cuts its link after a share of it.
  struct cut {
    std::array<int, 3> place;
    int direction;
    double share;
    friend bool operator<(const cut& a, const cut& b) noexcept {
      return std::tie(a.place, a.direction, a.share) < std::tie(b.place, b.direction, b.share);
    }
  };

  sphere_nodes(const periodic_spheres& p, int nodes) {
    if (nodes < 1 || !(p.box[0] > 0)) {
      throw parameter_error("lattice permeability", std::to_string(nodes) + " nodes in " + short_number(p.box[0]),
                            "at least 1 node and a box");
    }
    step_ = p.box[0] / nodes;
    for (std::size_t a = 0; a < 3; ++a) {
      const double whole = p.box[a] / step_;
      full_[a] = static_cast<int>(std::lround(whole));
      if (!(std::abs(whole - full_[a]) < 1e-6 * whole) || (p.halved[a] && full_[a] % 2 != 0)) {
        throw parameter_error("lattice permeability, axis " + std::to_string(a), short_number(whole) + " nodes",
                              p.halved[a] ? "an even number" : "a whole number");
      }
      box_.size[a] = p.halved[a] ? full_[a] / 2 : full_[a];
      box_.low[a] = box_.high[a] = p.halved[a] ? face_kind::mirror : face_kind::periodic;
    }
    const auto count = [&](std::size_t a) { return static_cast<std::size_t>(box_.size[a]); };
    solid_.assign(count(0) * count(1) * count(2), false);
    for (const auto& s : p.spheres) {
      if (!(s.radius > 0 && s.radius < infinity<double>) || !std::isfinite(norm(s.centre))) {
        throw parameter_error("lattice permeability, a sphere", "radius " + short_number(s.radius), "finite, above 0");
      }
      around(s, 0, [&](const std::array<int, 3>& at, const std::array<double, 3>& from, double radius) {
        if (square(from) <= radius * radius) {
          solid_[index(folded(at))] = true;
        }
      });
    }
    if (std::find(solid_.begin(), solid_.end(), true) == solid_.end()) {
      throw parameter_error("lattice permeability", "no node in a sphere", "spheres that resist the flow");
    }
    for (const auto& s : p.spheres) {
      add_cuts(s);
    }
    // the first of the spheres that cut a link counts
    std::sort(cuts_.begin(), cuts_.end());
    cuts_.erase(
        std::unique(cuts_.begin(), cuts_.end(),
                    [](const cut& a, const cut& b) { return a.place == b.place && a.direction == b.direction; }),
        cuts_.end());
  }

  [[nodiscard]] const lattice_box& box() const noexcept { return box_; }
  [[nodiscard]] double step() const noexcept { return step_; }
  [[nodiscard]] bool solid(int x, int y, int z) const noexcept { return solid_[index({x, y, z})]; }
  [[nodiscard]] const std::vector<cut>& cuts() const noexcept { return cuts_; }

 private:
  [[nodiscard]] std::size_t index(const std::array<int, 3>& p) const noexcept {
    return (static_cast<std::size_t>(p[0]) * static_cast<std::size_t>(box_.size[1]) + static_cast<std::size_t>(p[1])) *
               static_cast<std::size_t>(box_.size[2]) +
           static_cast<std::size_t>(p[2]);
  }
  [[nodiscard]] static double square(const std::array<double, 3>& r) noexcept {
    return r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
  }
  /// The node of the box that stands for a place of the whole lattice.
  [[nodiscard]] std::array<int, 3> folded(std::array<int, 3> p) const noexcept {
    for (std::size_t a = 0; a < 3; ++a) {
      p[a] = (p[a] % full_[a] + full_[a]) % full_[a];
      if (p[a] >= box_.size[a]) {
        p[a] = full_[a] - 1 - p[a];
      }
    }
    return p;
  }

  /// `visit(place, place − centre, radius)`, in nodes, of what lies in the box, not behind its mirrors, and no further
  /// than `margin` outside a sphere.
  template <class Visit>
  void around(const sphere<double>& s, int margin, Visit visit) const {
    const std::array<double, 3> centre{s.centre.x / step_ - 0.5, s.centre.y / step_ - 0.5, s.centre.z / step_ - 0.5};
    const double radius = s.radius / step_;
    const int reach = static_cast<int>(std::ceil(radius)) + 1 + margin;
    std::array<int, 3> base;
    for (std::size_t a = 0; a < 3; ++a) {
      base[a] = static_cast<int>(std::lround(centre[a]));
    }
    for (int x = base[0] - reach; x <= base[0] + reach; ++x) {
      for (int y = base[1] - reach; y <= base[1] + reach; ++y) {
        for (int z = base[2] - reach; z <= base[2] + reach; ++z) {
          const std::array<int, 3> at{x, y, z};
          bool kept = true;
          for (std::size_t a = 0; a < 3; ++a) {
            kept = kept && (at[a] % full_[a] + full_[a]) % full_[a] < box_.size[a];
          }
          if (kept) {
            visit(at, {x - centre[0], y - centre[1], z - centre[2]}, radius);
          }
        }
      }
    }
  }

  /// Links of fluid nodes to solid ones that a sphere cuts.
  void add_cuts(const sphere<double>& s) {
    around(s, 1, [&](const std::array<int, 3>& at, const std::array<double, 3>& from, double radius) {
      const std::array<int, 3> here = folded(at);
      const double outside = square(from) - radius * radius;
      if (solid_[index(here)] || outside > 3 + 4 * radius) {
        return;
      }
      for (int k = 1; k < static_cast<int>(L::directions); ++k) {
        const auto& c = L::velocity[static_cast<std::size_t>(k)];
        const double length = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
        const double towards = -(from[0] * c[0] + from[1] * c[1] + from[2] * c[2]);
        const double inside = towards * towards - length * outside;
        if (towards <= 0 || inside < 0 || !solid_[index(folded({at[0] + c[0], at[1] + c[1], at[2] + c[2]}))]) {
          continue;
        }
        const double share = outside / (towards + std::sqrt(inside));
        if (share <= 1 + 1e-9) {  // a solid node on the sphere itself
          cuts_.push_back({here, k, std::min(share, 1.0)});
        }
      }
    });
  }

  std::array<int, 3> full_{};
  lattice_box box_;
  double step_ = 0;
  std::vector<bool> solid_;
  std::vector<cut> cuts_;
};

template <class Simulation>
[[nodiscard]] double flux_of(const Simulation& s, std::size_t axis) {
  double flux = 0;
  for (std::size_t n = 0; n < s.sites().size(); ++n) {
    flux += s.velocity(n)[axis];
  }
  return flux;
}

}  // namespace detail

/// Permeability along an axis with `nodes` along the box's first axis: the flux under a body force, at the limit of no
/// inertia.
/// \par Domain  spheres that leave fluid between them; a box of a whole number of nodes
/// \par Accuracy  simple cubic spheres of solid fraction 0.34 to 0.52: 0.5 % at 24 nodes to the period, 0.1 % at
///                80; a random packing of fraction 0.60: +0.7, −1.4, −1.7, −1.3 % at 4.7, 6.3, 9.4, 12.6 nodes to the
///                radius, since every fifth wall link is cut on both sides there
/// \par Source  curved_walls
template <lattice L = d3q19, std::floating_point T = double>
[[nodiscard]] outcome<lattice_permeability, flow_status> measure_permeability(const periodic_spheres& p, int nodes,
                                                                              std::size_t axis = 0,
                                                                              const permeability_options& how = {}) {
  using model_type = mixture<L, trt, guo, linear_potential, 1>;
  if (axis > 2 || p.halved[axis]) {
    throw parameter_error("lattice permeability", "a flow along axis " + std::to_string(axis),
                          "an axis that is not halved");
  }
  const detail::sphere_nodes<L> solid(p, nodes);
  model_type model;
  model.collisions[0].tau = how.tau;
  model.reference = {1};
  const double width = solid.box().size[0];
  struct {
    double gravity = 0;
    double flux = 0;
    double change = quiet_nan<double>;
    std::size_t steps = 0;
    bool paced = false;
    bool steady = false;
  } now;
  now.gravity = 1e-4 * model.viscosity(0) / width;
  model.gravity[axis] = now.gravity;
  simulation<model_type, T> s(model, {solid.box(), [&](int x, int y, int z) {
                                        return site{solid.solid(x, y, z) ? site_kind::solid : site_kind::fluid, 0};
                                      }});
  std::vector<wall_cut> cuts;
  for (const auto& c : solid.cuts()) {
    cuts.push_back(
        {static_cast<std::size_t>(s.sites().node_at(c.place[0], c.place[1], c.place[2])), c.direction, c.share});
  }
  curved_walls walls(s, cuts);
  const auto run = [&](std::size_t steps) {
    for (std::size_t k = 0; k < steps; ++k) {
      s.step();
      walls.apply();
    }
  };
  const double volume = static_cast<double>(solid.box().size[0]) * solid.box().size[1] * solid.box().size[2];
  lattice_permeability r{quiet_nan<double>,
                         solid.step(),
                         static_cast<double>(s.sites().size()) / volume,
                         s.sites().size(),
                         cuts.size(),
                         cuts.size() - walls.size(),
                         0,
                         0,
                         quiet_nan<double>};
  const auto pace = static_cast<std::size_t>(100 / model.viscosity(0)) + 1;
  // as fast as inertia allows, so that rounding matters least: Re < 0.05 across the box, far below the speed of sound
  const double wanted = std::min(5e-4, 0.05 * model.viscosity(0) / width);
  const auto pull = [&](double gravity) {
    now.gravity = gravity;
    model.gravity[axis] = gravity;
    s.set_gravity(model.gravity);
  };
  kept_wait kept(how.kept, s, parameter_hash{}.add(how.steady).add(std::uint64_t{how.cap}), [&] { run(2); });
  if (kept.take_up(now)) {
    pull(now.gravity);
    r.taken_up = now.steps;
  }
  while (!now.steady && now.steps < how.cap) {
    run(pace);
    double flux = detail::flux_of(s, axis);
    run(1);
    now.steps += pace + 1;
    flux = 0.5 * (flux + detail::flux_of(s, axis)) /
           volume;  // a staggered mode, which nothing damps, changes sign each step
    if (!(std::abs(flux) < 0.1)) {
      r.steps = now.steps;
      return {r, flow_status::unstable};
    }
    if (!now.paced) {
      pull(now.gravity * (wanted / std::max(std::abs(flux), 1e-3 * wanted)));
      now.paced = true;
    } else {
      now.change = std::abs(flux / now.flux - 1);
      now.steady = now.change < how.steady;
      now.flux = flux;
    }
    if (now.steady || now.steps % 2 == 0) {
      kept.save(now);
    }
  }
  r.steps = now.steps;
  r.change = now.change;
  if (!now.steady) {
    return {r, flow_status::still_changing};
  }
  r.permeability = now.flux * model.viscosity(0) / now.gravity * solid.step() * solid.step();
  return {r, flow_status::steady};
}

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
