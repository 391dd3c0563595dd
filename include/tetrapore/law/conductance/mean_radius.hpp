// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/required.hpp"
#include "tetrapore/geometry/inscribed.hpp"
#include "tetrapore/law/conductance/concept.hpp"

#include <array>

namespace tetrapore::inline TETRAPORE_ABI {

namespace detail {

/// The sides of a facet in its plane, for the circle between them; a facet without walls has three discs.
template <real T>
[[nodiscard]] std::array<bounding_side2<T>, 3> sides_in_plane(const throat<T>& t) noexcept {
  const plane_polygon<T> p = facet_in_plane(t);
  const vec2<T> none{T(0), T(0)};
  if (t.grain_count == 3) {
    return {{{p.corners[0], none, t.grains[0].radius, false},
             {p.corners[1], none, t.grains[1].radius, false},
             {p.corners[2], none, t.grains[2].radius, false}}};
  }
  if (t.grain_count == 2) {  // corners: first centre, its foot, the other foot, second centre
    return {{{p.corners[0], none, t.grains[0].radius, false},
             {p.corners[1], {T(0), T(1)}, T(0), true},
             {p.corners[3], none, t.grains[1].radius, false}}};
  }
  return {{{p.corners[0], none, t.grains[0].radius, false},
           {p.corners[1], {T(-1), T(0)}, T(0), true},
           {p.corners[3], {T(0), T(-1)}, T(0), true}}};
}

}  // namespace detail

/// Conductance by the mean of two radii of the facet, that of the inscribed circle and that of the circle of equal
/// fluid area: K = A R² / (8 μ L), R = (r_inscribed + √(A/π)) / 2. It looks at the facet alone and takes no shear on
/// walls into account. Exact for a straight round tube.
/// \par Units   viscosity [Pa s], result [m³/(Pa s)]
/// \par Domain  throats with fluid area and two nodes, whose discs leave room for a circle
/// \par Accuracy  rounding: 1.1e-16 (64 + κ), κ as for hydraulic_radius. Permeability over that of Stokes flow: 0.41 to
///                0.79 in cubic lattices of solid fraction 0.3 to 0.74, 0.57 to 0.61 in a random packing of 0.60
/// \par Source  the effective radius of Bryant & Blunt 1992, Phys. Rev. A 46, 2004, and of Thompson 2002, AIChE J. 48,
///              1369, on the facets of a triangulation
struct mean_radius {
  required<double> viscosity;

  template <real T>
  [[nodiscard]] outcome<T, conductance_status> conductance(const throat<T>& t) const noexcept {
    return conductance(t, hydraulics_of(t));
  }
  template <real T>
  [[nodiscard]] outcome<T, conductance_status> conductance(const throat<T>& t,
                                                           const hydraulics_outcome<T>& h) const noexcept {
    using std::sqrt;
    if (!detail::positive(viscosity)) {
      return detail::no_conductance<T>(conductance_status::invalid_input);
    }
    const conductance_status first = detail::admit(t, h);
    if (first != conductance_status::ok) {
      return detail::refused_by<T>(first);
    }
    const auto inscribed = circle_between(detail::sides_in_plane(t));
    if (inscribed.reason != inscribed_status::ok) {
      return detail::no_conductance<T>(inscribed.reason == inscribed_status::invalid_input
                                           ? conductance_status::invalid_input
                                           : conductance_status::no_inscribed_circle);
    }
    using value_type = underlying_t<T>;
    const T area = h.value.fluid_area;
    const T radius = (inscribed.value.radius + sqrt(area / T(pi<T>))) * T(0.5);
    const T scale(1 / (8 * static_cast<value_type>(viscosity.get())));
    return {scale * area * radius * radius / h.value.length, conductance_status::ok};
  }
};
static_assert(hydraulic_law<mean_radius, double>);

}  // namespace tetrapore::inline TETRAPORE_ABI
