// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/required.hpp"
#include "tetrapore/law/conductance/concept.hpp"

namespace tetrapore::inline TETRAPORE_ABI {

/// Conductance by the hydraulic radius R_h of the throat domain: K = α A (2 R_h)² / (8 μ L), A the fluid area of the
/// facet. Exact for a straight tube between two nodes.
/// \par Units   viscosity [Pa s], result [m³/(Pa s)]
/// \par Domain  throats with fluid area and two nodes; R_h > 0
/// \par Accuracy  rounding: 1e-16 (64 + κ), κ the sum of the relative changes of K by the relative changes of what the
///                throat is made of (tests/property/law/conductance_property_test.cpp). Permeability over that of
///                Stokes flow (tests/truth/system/conductance_test.cpp): 0.92 to 1.02 in cubic lattices at contact,
///                1.15 in a random packing of solid fraction 0.60; in body- and face-centred lattices 1.4 to 1.5 at
///                0.6, and 2.6 to 2.7 at 0.3
/// \par Source  Chareyre et al. 2012, Transp. Porous Media 92, 473; Chareyre et al., EPJ Web Conf. 140,
///              09027 (2017), §2.2
struct hydraulic_radius {
  required<double> viscosity;
  double factor = 1;  ///< α
  wall_condition wall = wall_condition::no_slip;

  template <real T>
  [[nodiscard]] outcome<T, conductance_status> conductance(const throat<T>& t) const noexcept {
    return conductance(t, hydraulics_of(t));
  }
  template <real T>
  [[nodiscard]] outcome<T, conductance_status> conductance(const throat<T>& t,
                                                           const hydraulics_outcome<T>& h) const noexcept {
    if (!detail::positive(viscosity) || !detail::positive(factor)) {
      return detail::no_conductance<T>(conductance_status::invalid_input);
    }
    const conductance_status first = detail::admit(t, h);
    if (first != conductance_status::ok) {
      return detail::refused_by<T>(first);
    }
    const T radius = h.value.hydraulic_radius(wall);
    if (!(radius > T(0))) {
      return detail::no_conductance<T>(conductance_status::negative_hydraulic_radius);
    }
    using value_type = underlying_t<T>;
    const T scale(static_cast<value_type>(factor) / (2 * static_cast<value_type>(viscosity.get())));
    return {scale * h.value.fluid_area * radius * radius / h.value.length, conductance_status::ok};
  }
};
static_assert(hydraulic_law<hydraulic_radius, double>);

}  // namespace tetrapore::inline TETRAPORE_ABI
