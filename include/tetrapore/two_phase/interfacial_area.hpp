// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/two_phase/entry_rule.hpp"

#include <cmath>

/// \file
/// Area of the menisci between gas and liquid.

namespace tetrapore::inline TETRAPORE_ABI {

/// Menisci in the throats between gas and wet pores.
struct meniscus_area {
  double area = 0;          ///< [m²]
  std::size_t menisci = 0;  ///< throats counted
  std::size_t passed = 0;   ///< of these: the pressure is above the threshold (an outlet, a trapped pore): taken at it
  std::size_t unknown = 0;  ///< throats between gas and wet pores without a threshold: not in the area
};

/// Estimate of the area between gas and liquid at the throats. A throat of entry pressure p_e counts as a round opening
/// of the same entry pressure, of radius a = 2 σ cos θ / p_e; its meniscus is the cap of the sphere of radius 2σ/p
/// over it, A = 2π a² / (1 + √(1 − (a p / 2σ)²)). p is the capillary pressure of the state, for a trapped pore that
/// of its cluster. Rings of liquid around contacts are not included.
/// \par Units     [N/m], [rad] -> [m²]
/// \par Accuracy  exact for a round opening. The gas section A_nw of a facet is larger than its round one: at θ = 0 the
///                latter is 0.69 to 0.84 of it (median 0.83, the 36,807 facets of a packing of 10,000 spheres that have
///                a threshold of their own), so this is a low estimate
template <entry_rule Rule>
[[nodiscard]] meniscus_area interfacial_area(const network& net, const two_phase_state& state, Rule& rule,
                                             double surface_tension, double contact_angle = 0) {
  meniscus_area sum;
  const double cosine = std::cos(contact_angle);
  for (std::size_t i = 0; i < net.throat_count(); ++i) {
    const throat_id t(i);
    const auto& [a, b] = net.pores(t);
    if (!b.valid() || state.is_gas(a) == state.is_gas(b)) {
      continue;
    }
    const threshold_outcome answer = rule.threshold(net, state, t);
    if (answer.kind() == verdict::absent) {
      continue;
    }
    if (!answer.ok()) {
      ++sum.unknown;
      continue;
    }
    const pore_id wet = state.is_wet(a) ? a : b;
    const double p = state.is_trapped(wet) ? state.clusters()[state.cluster(wet)].pressure : state.pressure();
    const double entry = answer.value.value();
    const double radius = 2 * surface_tension * cosine / entry;
    const double share = cosine * (p < entry ? p / entry : 1);
    sum.area += 2 * pi<double> * radius * radius / (1 + std::sqrt((1 - share) * (1 + share)));
    sum.passed += p > entry ? 1 : 0;
    ++sum.menisci;
  }
  return sum;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
