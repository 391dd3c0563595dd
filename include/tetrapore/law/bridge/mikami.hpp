// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/bridge/soulie.hpp"

namespace tetrapore::inline TETRAPORE_ABI {

/// F = πσR (exp(A D/R + B) + C), v = V/R³: A = −1.1 v^(−0.53), B = −0.0082 ln v + 0.48, C = 0.0018 ln v + 0.078: equal
/// spheres that the liquid wets fully. Soulié's form is this one with a contact angle and unequal radii.
/// \par Units   surface tension [N/m], angle [rad], result [N]
/// \par Domain  equal spheres, θ = 0; 1e-4 ≤ V/R³ ≤ 0.1; gaps from 0 on
/// \par Accuracy  12 / 5.7 %; v = 1e-4 to 1e-3: 42 / 10 %, within 7 % of the force at contact
/// \par Source  Mikami, Kamiya & Horio 1998, Chem. Eng. Sci. 53, 1927, with its rupture
template <class Rupture = mikami_rupture>
struct mikami {
  required<double> surface_tension;
  Rupture rupture = {};

  /// Relative error of the force over the domain, gaps up to 0.9 of the rupture gap; worst measured 0.42.
  static constexpr double stated_accuracy = 0.5;

  template <real T>
  [[nodiscard]] outcome<bridge_pull<T>, bridge_status> bridge(const edge<T>& e, given_volume<T> liquid) const noexcept {
    const auto answer = soulie<Rupture>{surface_tension, 0.0, rupture}.bridge(e, liquid);
    const bool found = answer.ok() || answer.reason == bridge_status::ruptured;
    return found && !detail::equal_radii(e) ? detail::no_pull<T>(bridge_status::not_covered) : answer;
  }
};
static_assert(bridge_law<mikami<>>);

}  // namespace tetrapore::inline TETRAPORE_ABI
