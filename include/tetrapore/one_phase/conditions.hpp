// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/error.hpp"
#include "tetrapore/network/gather.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

/// \file
/// What drives a flow: conditions on faces and in pores, the fluid, a mean gradient.

namespace tetrapore::inline TETRAPORE_ABI {

/// What is known at a face of the box or in a pore.
struct flow_condition {
  enum class type : unsigned char {
    no_flow,   ///< nothing enters or leaves
    pressure,  ///< `value` is the pressure [Pa]
    flux       ///< `value` enters the network [m³/s]; on a face evenly over its area
  };
  type kind = type::no_flow;
  double value = 0;

  [[nodiscard]] friend constexpr bool operator==(const flow_condition&, const flow_condition&) noexcept = default;
};

[[nodiscard]] constexpr flow_condition no_flow() noexcept { return {}; }
/// \param value  [Pa]
[[nodiscard]] constexpr flow_condition held_pressure(double value) noexcept {
  return {flow_condition::type::pressure, value};
}
/// \param value  [m³/s] into the network
[[nodiscard]] constexpr flow_condition imposed_flux(double value) noexcept {
  return {flow_condition::type::flux, value};
}

/// A condition on one pore; it goes before those of the faces that the pore touches, and holds for all pores that are
/// one node with it (see flow_nodes). A flux of such a face is taken by the other pores.
struct pore_condition {
  pore_id pore;
  flow_condition condition;
};

/// Conditions of a flow. A pressure on a face holds all pores that touch the face, as reservoirs do. A pore that two
/// faces hold at different pressures is an error, unless it has a condition of its own.
struct flow_conditions {
  std::array<flow_condition, 6> faces{};  ///< by face
  std::vector<pore_condition> pores;
  /// Mean pressure gradient along the periodic axes [Pa/m]; along others it must be 0.
  vec3<double> mean_gradient{};

  flow_condition& at(face f) noexcept { return faces[static_cast<std::size_t>(f)]; }
  [[nodiscard]] const flow_condition& at(face f) const noexcept { return faces[static_cast<std::size_t>(f)]; }
};

/// What the pressure equation asks of the fluid beyond its viscosity, which the conductance law holds.
struct pore_fluid {
  double bulk_modulus = std::numeric_limits<double>::infinity();  ///< [Pa]; infinite: incompressible
  double density = 0;                                             ///< [kg/m³]
  vec3<double> gravity{};                                         ///< [m/s²]

  /// Pressure gradient of the fluid at rest [Pa/m].
  [[nodiscard]] constexpr vec3<double> hydrostatic_gradient() const noexcept { return gravity * density; }
};

namespace detail {

/// \throw parameter_error
inline void check(const network& net, const flow_conditions& c, const pore_fluid& fluid) {
  using kind = flow_condition::type;
  const auto finite_value = [](const flow_condition& x, const std::string& where) {
    if (x.kind != kind::no_flow && !std::isfinite(x.value)) {
      throw parameter_error(where, short_number(x.value), "a finite number");
    }
  };
  for (const face f : all_faces) {
    const std::string where = std::string("condition at ") + describe(f);
    finite_value(c.at(f), where);
    if (c.at(f).kind != kind::no_flow && net.region().at(f) == boundary::periodic) {
      throw parameter_error(where, "a periodic face", "a wall or an open face");
    }
  }
  for (const pore_condition& p : c.pores) {
    const std::string where = "condition of pore " + std::to_string(p.pore.value);
    if (p.pore.index() >= net.pore_count()) {
      throw parameter_error(where, "no such pore", "a pore below " + std::to_string(net.pore_count()));
    }
    finite_value(p.condition, where);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (!std::isfinite(c.mean_gradient[k]) || (c.mean_gradient[k] != 0 && !net.region().is_periodic(k))) {
      throw parameter_error("mean gradient along axis " + std::to_string(k), short_number(c.mean_gradient[k]),
                            "a finite number, 0 unless the axis is periodic");
    }
  }
  if (!(fluid.bulk_modulus > 0)) {
    throw parameter_error("bulk modulus", short_number(fluid.bulk_modulus), "a number above 0, or infinity");
  }
  if (!std::isfinite(fluid.density) || !finite(fluid.gravity)) {
    throw parameter_error("density or gravity", short_number(fluid.density), "finite numbers");
  }
}

}  // namespace detail

/// Area vector of the facet of pore p in a slot, outward [m²]; zero where nothing lies beyond.
[[nodiscard]] inline vec3<double> outward_area(const network& net, pore_id p, std::size_t slot) noexcept {
  const throat_id t = net.throats(p)[slot];
  if (!t.valid()) {
    return {};
  }
  const vec3<double> s = detail::facet_at(net, t).area_vector;
  return net.pores(t)[0] == p && net.slot(t, 0) == slot ? s : -s;
}

/// Area by which a pore covers a face [m²]: its foot on a wall, its facets on an open face.
[[nodiscard]] inline double covered_area(const network& net, pore_id p, face f) noexcept {
  double area = 0;
  bool on_wall = false;
  for (std::size_t k = 0; k < 4; ++k) {
    const vertex v = net.vertices(p)[k];
    on_wall = on_wall || (v.is_wall() && v.wall() == f);
    const throat_id t = net.throats(p)[k];
    if (t.valid() && net.is_boundary(t) && net.boundary_face(t) == f) {
      area += norm(outward_area(net, p, k));
    }
  }
  if (on_wall) {  // the surface of a cell is closed: its foot balances its facets
    const vec3<double> inward = net.region().wall(f).normal;
    for (std::size_t k = 0; k < 4; ++k) {
      area += dot(outward_area(net, p, k), inward);
    }
  }
  return area;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
