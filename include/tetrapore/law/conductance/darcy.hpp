// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/required.hpp"
#include "tetrapore/law/conductance/concept.hpp"

namespace tetrapore::inline TETRAPORE_ABI {

/// Conductance of a throat filled with a porous medium of given permeability: K = k |S| / (μ L), S the whole facet,
/// grains included. The axis of a throat is normal to its facet, so a uniform gradient is answered exactly: a network
/// of these throats has the permeability k, isotropic, whatever its grains. The right law for grains that stand for
/// a medium (aggregates, a coarse-grained packing), and a check of everything downstream of a law.
/// \par Units   permeability [m²], viscosity [Pa s], result [m³/(Pa s)]
/// \par Domain  throats with two nodes; a facet without area is closed
/// \par Accuracy  8 epsilon, beside the digits that the difference of the nodes has
/// \par Source  Darcy's law by two-point fluxes: Eymard, Gallouët & Herbin 2000, Handbook of Numerical Analysis 7, §9
struct darcy {
  required<double> permeability;
  required<double> viscosity;

  template <real T>
  [[nodiscard]] outcome<T, conductance_status> conductance(const throat<T>& t) const noexcept {
    if (!detail::positive(permeability) || !detail::positive(viscosity)) {
      return detail::no_conductance<T>(conductance_status::invalid_input);
    }
    const T area = facet_area(t);
    const T length = norm(t.nodes[1] - t.nodes[0]);
    if (!(area - area == T(0)) || !(length - length == T(0))) {
      return detail::no_conductance<T>(conductance_status::invalid_input);
    }
    if (!(area > T(0))) {
      return {T(0), conductance_status::closed};
    }
    if (!(length > T(0))) {
      return detail::no_conductance<T>(conductance_status::coincident_nodes);
    }
    using value_type = underlying_t<T>;
    const T scale(static_cast<value_type>(permeability.get()) / static_cast<value_type>(viscosity.get()));
    return {scale * area / length, conductance_status::ok};
  }
};
static_assert(conductance_law<darcy, double>);

}  // namespace tetrapore::inline TETRAPORE_ABI
