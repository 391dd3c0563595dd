// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/geometry/solid_angle.hpp"
#include "tetrapore/one_phase/flow.hpp"
#include "tetrapore/simplex/throat_hydraulics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

/// \file
/// What the fluid does to the grains and walls: forces, torques, stress.

namespace tetrapore::inline TETRAPORE_ABI {

/// Which part of a facet's area loads each of its vertices (grains first, then walls): the force on vertex k is
/// (p_0 − p_1) n (pressure[k] + viscous[k]), n from pore 0 to pore 1. All parts sum to the area of the facet.
struct facet_load {
  std::array<double, 3> pressure{};  ///< [m²]
  std::array<double, 3> viscous{};   ///< [m²]
  bool replaced = false;             ///< the rule of the sharing failed here, and its second rule was taken
};

/// Shares the load of a facet among its vertices: any function of a throat that gives a facet_load.
template <class S>
concept load_sharing = requires(const S s, const throat<double> t) {
  { s(t) } -> std::same_as<facet_load>;
};

/// A sharing that asks a throat's hydraulics, and so can be given them.
template <class S>
concept hydraulic_sharing =
    load_sharing<S> && requires(const S s, const throat<double> t, const throat_hydraulics<double> h) {
      { s(t, h) } -> std::same_as<facet_load>;
    };

/// Pressure acts on the disc of each grain in the facet (segments that stick out and lenses taken off, so that discs
/// and fluid area make up the facet); what the fluid area carries goes to the grains and walls by the surface that they
/// wet in the throat domain.
/// \par Domain  any throat. Where signed wetted areas have no common sign, as in a mesh that is no longer regular,
///              their magnitudes count, and where they vanish, the discs: `replaced` says so
/// \par Accuracy  the parts sum to the area to 1e-14 of the largest square of a radius or edge; from the conductances
///                of another code, its forces on the grains to 5e-11 (tests/truth/system/peer_flow_test.cpp)
/// \par Source  Chareyre et al. 2012, Transp. Porous Media 92, 473; Chareyre et al. 2017, §2.2
struct share_by_wetted_area {
  wall_condition wall = wall_condition::no_slip;

  [[nodiscard]] facet_load operator()(const throat<double>& t) const noexcept {
    return (*this)(t, hydraulics_of(t).value);
  }
  [[nodiscard]] facet_load operator()(const throat<double>&, const throat_hydraulics<double>& h) const noexcept {
    facet_load load;
    load.pressure = h.disc_area;
    std::array<double, 3> weight{};
    const auto sum_up = [&](const auto& of) {
      for (std::size_t k = 0; k < 3; ++k) {
        weight[k] = std::abs(of(k));
      }
      return weight[0] + weight[1] + weight[2];
    };
    double sum = sum_up([&](std::size_t k) { return h.sheared_area(k, wall); });
    load.replaced = sum != std::abs(h.sheared_area(wall));
    if (!(sum > 0)) {
      load.replaced = true;
      sum = sum_up([&](std::size_t k) { return h.disc_area[k]; });
    }
    for (std::size_t k = 0; k < 3 && sum > 0; ++k) {
      load.viscous[k] = h.fluid_area * (weight[k] / sum);
    }
    return load;
  }
};
static_assert(hydraulic_sharing<share_by_wetted_area>);

/// Forces and torques of the fluid.
struct fluid_forces {
  std::vector<vec3<double>> pressure;    ///< per grain [N]
  std::vector<vec3<double>> viscous;     ///< per grain [N]
  std::vector<vec3<double>> torques;     ///< per grain, about its centre [N m]
  std::array<vec3<double>, 6> walls{};   ///< shear on each wall [N]; the pressure on it: pressure_on_walls
  std::array<vec3<double>, 3> stress{};  ///< mean stress of the grains by the fluid, tension positive [Pa]
  std::size_t replaced = 0;              ///< facets where the sharing took its second rule: see facet_load

  [[nodiscard]] vec3<double> on(grain_id g) const noexcept { return pressure[g.index()] + viscous[g.index()]; }
  /// Sum over grains and walls [N].
  [[nodiscard]] vec3<double> total() const noexcept {
    vec3<double> sum;
    for (std::size_t g = 0; g < pressure.size(); ++g) {
      sum += pressure[g] + viscous[g];
    }
    for (const vec3<double>& w : walls) {
      sum += w;
    }
    return sum;
  }
};

namespace detail {

/// The load of throat t, from its hydraulics where they were kept.
template <load_sharing Sharing>
[[nodiscard]] facet_load load_of(const Sharing& sharing, const throat<double>& seen, throat_id t,
                                 std::span<const throat_hydraulics<double>> kept) {
  if constexpr (hydraulic_sharing<Sharing>) {
    if (!kept.empty()) {
      return sharing(seen, kept[t.index()]);
    }
  }
  return sharing(seen);
}

/// Unit vectors along the edges of a facet; nothing along an edge without length.
[[nodiscard]] inline std::array<vec3<double>, 3> directions_of_facet(const throat<double>& t) noexcept {
  std::array<vec3<double>, 3> out = edges_of_facet(t);
  for (vec3<double>& d : out) {
    const double length = norm(d);
    d = length > 0 ? d / length : vec3<double>{};
  }
  return out;
}

/// Solid angle of a cell at its grain k [sr]; a wall is a direction.
[[nodiscard]] inline double angle_of_grain(const pore_body<double>& body, std::size_t k) noexcept {
  const auto towards = [&](std::size_t other) {
    return other < body.grain_count ? body.grains[other].centre - body.grains[k].centre
                                    : -body.walls[other - body.grain_count].normal;
  };
  const auto& f = facet_vertices[k];
  return solid_angle(towards(f[0]), towards(f[1]), towards(f[2]));
}

inline void add_outer(std::array<vec3<double>, 3>& rows, const vec3<double>& a, const vec3<double>& b) noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    rows[i] += b * a[i];
  }
}

}  // namespace detail

/// What is computed beside forces and torques.
struct force_options {
  bool stress = false;  ///< the mean stress; it needs the solid angles of all cells
};

/// Forces of a pressure field on grains and walls, facet by facet.
///
/// Σ over the vertices of a facet is Δp S, so the sum of all is − Σ_i p_i S_i over the outer surfaces S_i of the pores:
/// −V ∇p where a periodic box has a mean gradient, and nothing for a uniform pressure. Facets on the hull of an open
/// region carry no force: beyond them the pressure is that of their pore.
///
/// Torque: pressure on a sphere has none. The shear of a throat is taken to act on the surface of the grain, midway
/// along the arc that its disc has in the facet: an assumption of ours, of no published source, that is exact where the
/// throat is symmetric about that line; nothing holds the size of the torque against Stokes flow. No torque comes from
/// shear between grains that move, for which there are lubrication laws.
///
/// Stress: (1/V) Σ ∫ x ⊗ t dA over the surfaces of all grains, x from the centre of each, V the volume of the network.
/// It is (1/V) Σ over the sectors of (c ⊗ F − p V_sector I), with c the centroid of the sector of a facet for its
/// pressure force, and the point of action of the shear. First index: x; second: t. Tension is positive, a pressure
/// negative. Exact for the pressure of facets in which no disc is cut by the opposite edge and no two discs overlap: a
/// disc that loses a segment or half of a lens keeps the centroid of its sector.
/// \par Accuracy  force, torque and stress of single facets by hand, to 1e-14 (tests/analytical/one_phase/); pressure
///                forces and stress of random packings are the tractions integrated over the spheres, to the 3e-9 of
///                the quadrature (tests/property/system/fluid_forces_test.cpp)
/// \param pressure       the one that drives the flow: saturated_flow::driving_pressure; see `buoyancy` for the rest
/// \param mean_gradient  of a periodic box [Pa/m]
/// \param kept           hydraulics of the throats, from throat_conductances, or none
template <load_sharing Sharing = share_by_wetted_area>
[[nodiscard]] fluid_forces forces_of_pressure(const network& net, const flow_nodes& nodes,
                                              const pressure_field& pressure, const vec3<double>& mean_gradient = {},
                                              const Sharing& sharing = {}, const force_options& how = {},
                                              std::span<const throat_hydraulics<double>> kept = {}) {
  TETRAPORE_EXPECTS(pressure.belongs_to(net), "the pressure belongs to the network");
  TETRAPORE_EXPECTS(kept.empty() || kept.size() == net.throat_count(), "the hydraulics belong to the network");
  fluid_forces out;
  out.pressure.assign(net.grain_count(), {});
  out.viscous.assign(net.grain_count(), {});
  out.torques.assign(net.grain_count(), {});
  for (std::size_t i = 0; i < net.throat_count(); ++i) {
    const throat_id t(i);
    if (net.is_boundary(t)) {
      continue;
    }
    const auto& [a, b] = net.pores(t);
    const double drop = pressure[a] - pressure[b] - dot(mean_gradient, net.region().shift(net.shift(t)));
    if (drop == 0) {
      continue;
    }
    const throat<double> seen = nodes.throat_between(net, t);
    const double area = norm(seen.area_vector);
    if (!(area > 0)) {
      continue;
    }
    const facet_load load = detail::load_of(sharing, seen, t, kept);
    out.replaced += load.replaced ? 1U : 0U;
    const vec3<double> push = seen.area_vector * (drop / area);
    const auto slots = facet_slots(net, a, net.slot(t, 0));
    const auto edges = detail::directions_of_facet(seen);
    for (std::size_t k = 0; k < 3; ++k) {
      const vertex v = net.vertices(a)[slots[k]];
      if (v.is_wall()) {
        out.walls[static_cast<std::size_t>(v.wall())] += push * (load.pressure[k] + load.viscous[k]);
        continue;
      }
      const std::size_t g = v.grain().index();
      out.pressure[g] += push * load.pressure[k];
      out.viscous[g] += push * load.viscous[k];
      const vec3<double>& e1 = edges[k];  // the arms of its sector
      const vec3<double> e2 = -edges[(k + 2) % 3];
      const vec3<double> middle = e1 + e2;
      const double size = norm(middle);
      if (!(size > 0)) {
        continue;  // a straight angle: the facet is flat
      }
      const double r = seen.grains[k].radius;
      const vec3<double> lever = middle * (r / size);
      const vec3<double> shear = push * load.viscous[k];
      out.torques[g] += cross(lever, shear);
      if (how.stress) {
        // centroid of a sector of half angle α: 2/3 r sin α / α along its middle; 2 cos α = |e1 + e2|
        const double half = std::atan2(norm(e1 - e2), size);
        const double centroid = half > 0 ? 2.0 / 3.0 * std::sin(half) / half : 2.0 / 3.0;
        detail::add_outer(out.stress, lever, shear + push * (load.pressure[k] * centroid));
      }
    }
  }
  if (!how.stress) {
    return out;
  }
  double volume = 0;
  double isotropic = 0;
  for (std::size_t i = 0; i < net.pore_count(); ++i) {
    const pore_id p(i);
    volume += net.volume(p);
    const pore_body<double> body = pore_body_at(net, p);
    for (std::size_t k = 0; k < body.grain_count; ++k) {
      const double r = body.grains[k].radius;
      const double at_home = pressure[p] - dot(mean_gradient, net.region().shift(net.image_of(p, k)));
      isotropic += at_home * r * r * r * detail::angle_of_grain(body, k) / 3.0;
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    out.stress[k][k] -= isotropic;
    out.stress[k] = out.stress[k] / volume;
  }
  return out;
}

/// Whether the fluid of a law slips along walls: what a free function `tetrapore_wall_condition(law)` says that
/// argument-dependent lookup finds (the customisation point), else the law's member `wall`. Where a law says neither,
/// the fluid sticks; so one that wraps another must hand on what that says.
template <conductance_law Law>
[[nodiscard]] constexpr wall_condition wall_condition_of(const Law& law) {
  if constexpr (requires {
                  { tetrapore_wall_condition(law) } -> std::convertible_to<wall_condition>;
                }) {
    return tetrapore_wall_condition(law);
  } else if constexpr (requires {
                         { law.wall } -> std::convertible_to<wall_condition>;
                       }) {
    return law.wall;
  } else {
    return wall_condition::no_slip;
  }
}

/// The sharing that goes with a law: walls that it lets slip take no shear, if the sharing can be made of a
/// wall_condition.
template <load_sharing Sharing = share_by_wetted_area, conductance_law Law>
[[nodiscard]] Sharing sharing_of(const Law& law) {
  if constexpr (requires(wall_condition w) { Sharing{w}; }) {
    return Sharing{wall_condition_of(law)};
  } else {
    return Sharing{};
  }
}

/// Forces of the last solution, shared as the caller asks.
template <class Law, class Solver, class Cores, load_sharing Sharing>
[[nodiscard]] fluid_forces forces_on_grains(const saturated_flow<Law, Solver, Cores>& flow, const Sharing& sharing,
                                            const force_options& how = {}) {
  return forces_of_pressure(flow.net(), flow.system().nodes(), flow.driving_pressure(),
                            flow.system().conditions().mean_gradient, sharing, how, flow.conductances().hydraulics);
}
/// Forces of the last solution, shared as the law treats the walls: see wall_condition_of.
template <class Law, class Solver, class Cores>
[[nodiscard]] fluid_forces forces_on_grains(const saturated_flow<Law, Solver, Cores>& flow) {
  return forces_on_grains(flow, sharing_of(flow.law()));
}

/// Force of the fluid at rest on each grain [N]: its weight less, upwards (Archimedes). A grain counts whole.
[[nodiscard]] inline std::vector<vec3<double>> buoyancy(const network& net, const pore_fluid& fluid) {
  std::vector<vec3<double>> out(net.grain_count());
  for (std::size_t g = 0; g < out.size(); ++g) {
    const double r = net.grains()[g].radius;
    out[g] = fluid.hydrostatic_gradient() * (-4.0 / 3.0 * pi<double> * r * r * r);
  }
  return out;
}

/// Force of the pressure of the pores on each wall [N], outward.
[[nodiscard]] inline std::array<vec3<double>, 6> pressure_on_walls(const network& net, const pressure_field& pressure) {
  std::array<vec3<double>, 6> out{};
  for (std::size_t i = 0; i < net.pore_count(); ++i) {
    const pore_id p(i);
    for (std::size_t k = net.grain_vertices(p); k < 4; ++k) {
      const face f = net.vertices(p)[k].wall();
      out[static_cast<std::size_t>(f)] -= net.region().wall(f).normal * (pressure[p] * covered_area(net, p, f));
    }
  }
  return out;
}

/// Force of the surroundings on the network by pressure alone [N]: − Σ p S over the outer surface, and −V times a mean
/// gradient along periodic axes. The forces on grains and walls sum to it, whatever the conductances.
[[nodiscard]] inline vec3<double> boundary_force(const network& net, const pressure_field& pressure,
                                                 const vec3<double>& mean_gradient = {}) {
  vec3<double> sum;
  for (const vec3<double>& w : pressure_on_walls(net, pressure)) {
    sum -= w;
  }
  for (std::size_t i = 0; i < net.throat_count(); ++i) {
    const throat_id t(i);
    const vec3<double> s = detail::facet_at(net, t).area_vector;
    if (net.is_boundary(t)) {
      sum -= s * pressure[net.pores(t)[0]];
    } else if (net.shift(t) != image{}) {
      sum -= s * dot(mean_gradient, net.region().shift(net.shift(t)));
    }
  }
  return sum;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
