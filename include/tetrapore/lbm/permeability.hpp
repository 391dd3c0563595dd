// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/error.hpp"
#include "tetrapore/core/outcome.hpp"
#include "tetrapore/geometry/primitives.hpp"
#include "tetrapore/lbm/simulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
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
  std::size_t cap = 200000;  ///< steps
};

/// \par Units  permeability in the square of the unit of length
struct lattice_permeability {
  double permeability;
  double porosity;      ///< of the nodes
  double radius_shift;  ///< by which all radii were changed, in nodes, so that the solid volume is that of the spheres
  std::size_t fluid_nodes;
  std::size_t steps;
};

namespace detail {

/// The nodes that spheres leave free, with all radii changed by `shift` nodes.
class sphere_nodes {
 public:
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
    // how far each node lies inside the sphere that covers it most
    const auto count = [&](std::size_t a) { return static_cast<std::size_t>(box_.size[a]); };
    depth_.assign(count(0) * count(1) * count(2), -1e30);
    for (const auto& s : p.spheres) {
      if (!(s.radius > 0 && s.radius < infinity<double>) || !std::isfinite(norm(s.centre))) {
        throw parameter_error("lattice permeability, a sphere", "radius " + short_number(s.radius), "finite, above 0");
      }
      const std::array<double, 3> centre{s.centre.x / step_ - 0.5, s.centre.y / step_ - 0.5, s.centre.z / step_ - 0.5};
      const double radius = s.radius / step_;
      solid_ += 4 * std::numbers::pi / 3 * radius * radius * radius;
      const int reach = static_cast<int>(std::ceil(radius)) + 2;
      std::array<int, 3> base;
      for (std::size_t a = 0; a < 3; ++a) {
        base[a] = static_cast<int>(std::lround(centre[a]));
      }
      for (int dx = -reach; dx <= reach; ++dx) {
        for (int dy = -reach; dy <= reach; ++dy) {
          for (int dz = -reach; dz <= reach; ++dz) {
            const std::array<int, 3> at{base[0] + dx, base[1] + dy, base[2] + dz};
            const double distance = std::hypot(at[0] - centre[0], at[1] - centre[1], at[2] - centre[2]);
            std::array<int, 3> wrapped;
            bool kept = true;
            for (std::size_t a = 0; a < 3; ++a) {
              wrapped[a] = (at[a] % full_[a] + full_[a]) % full_[a];
              kept = kept && wrapped[a] < box_.size[a];
            }
            if (kept) {
              double& depth = depth_[index(wrapped[0], wrapped[1], wrapped[2])];
              depth = std::max(depth, radius - distance);
            }
          }
        }
      }
    }
    match_volume();
  }

  [[nodiscard]] const lattice_box& box() const noexcept { return box_; }
  [[nodiscard]] double step() const noexcept { return step_; }
  [[nodiscard]] double shift() const noexcept { return shift_; }
  [[nodiscard]] bool solid(int x, int y, int z) const noexcept { return depth_[index(x, y, z)] > -shift_; }

 private:
  [[nodiscard]] std::size_t index(int x, int y, int z) const noexcept {
    return (static_cast<std::size_t>(x) * static_cast<std::size_t>(box_.size[1]) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(box_.size[2]) +
           static_cast<std::size_t>(z);
  }
  /// The shift at which as many nodes are solid as the spheres have volume (overlaps counted as the spheres say).
  void match_volume() {
    double share = 1;
    for (std::size_t a = 0; a < 3; ++a) {
      share *= static_cast<double>(box_.size[a]) / full_[a];
    }
    const auto wanted = static_cast<std::size_t>(std::lround(solid_ * share));
    if (wanted == 0 || wanted >= depth_.size()) {
      throw parameter_error("lattice permeability", "a solid volume of " + short_number(solid_) + " nodes",
                            "spheres that leave fluid between them");
    }
    std::vector<double> order = depth_;
    const auto last = order.begin() + static_cast<std::ptrdiff_t>(wanted);
    std::nth_element(order.begin(), last, order.end(), [](double a, double b) { return a > b; });
    const double outside = *last;  // the first node that stays fluid
    const double inside = *std::min_element(order.begin(), last);
    shift_ = -0.5 * (outside + inside);
  }

  std::array<int, 3> full_{};
  lattice_box box_;
  double step_ = 0;
  double shift_ = 0;
  double solid_ = 0;
  std::vector<double> depth_;
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
/// \par Accuracy  first order in the width of a node: simple cubic spheres −2 % at 64 nodes to the period (solid
///                fractions 0.34 to 0.52), a random packing of fraction 0.60 +3.5 % at 4.7 nodes to the radius
/// \par Source  Ladd, J. Fluid Mech. 271, 285 (1994), for walls half-way between nodes; the shift of the radii: own
template <lattice L = d3q19, std::floating_point T = double>
[[nodiscard]] outcome<lattice_permeability, flow_status> measure_permeability(const periodic_spheres& p, int nodes,
                                                                              std::size_t axis = 0,
                                                                              const permeability_options& how = {}) {
  using model_type = mixture<L, trt, guo, linear_potential, 1>;
  if (axis > 2 || p.halved[axis]) {
    throw parameter_error("lattice permeability", "a flow along axis " + std::to_string(axis),
                          "an axis that is not halved");
  }
  const detail::sphere_nodes solid(p, nodes);
  model_type model;
  model.collisions[0].tau = how.tau;
  model.reference = {1};
  const double width = solid.box().size[0];
  double gravity = 1e-4 * model.viscosity(0) / width;
  model.gravity[axis] = gravity;
  simulation<model_type, T> s(model, {solid.box(), [&](int x, int y, int z) {
                                        return site{solid.solid(x, y, z) ? site_kind::solid : site_kind::fluid, 0};
                                      }});
  const double volume = static_cast<double>(solid.box().size[0]) * solid.box().size[1] * solid.box().size[2];
  lattice_permeability r{quiet_nan<double>, static_cast<double>(s.sites().size()) / volume, solid.shift(),
                         s.sites().size(), 0};
  const auto pace = static_cast<std::size_t>(100 / model.viscosity(0)) + 1;
  // as fast as inertia allows, so that rounding matters least: Re < 0.05 across the box, far below the speed of sound
  const double wanted = std::min(5e-4, 0.05 * model.viscosity(0) / width);
  bool paced = false;
  double before = 0;
  while (s.steps() < how.cap) {
    s.run(pace);
    double flux = detail::flux_of(s, axis);
    s.step();
    flux = 0.5 * (flux + detail::flux_of(s, axis)) /
           volume;  // a staggered mode, which nothing damps, changes sign each step
    r.steps = s.steps();
    if (!(std::abs(flux) < 0.1)) {
      return {r, flow_status::unstable};
    }
    if (!paced) {
      gravity *= wanted / std::max(std::abs(flux), 1e-3 * wanted);
      model.gravity[axis] = gravity;
      s.set_gravity(model.gravity);
      paced = true;
      continue;
    }
    if (std::abs(flux - before) < how.steady * std::abs(flux)) {
      r.permeability = flux * model.viscosity(0) / gravity * solid.step() * solid.step();
      return {r, flow_status::steady};
    }
    before = flux;
  }
  return {r, flow_status::still_changing};
}

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
