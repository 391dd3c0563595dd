// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/bridge/lambert.hpp"

namespace tetrapore::inline TETRAPORE_ABI {

/// The force of Lambert's form and, added to it, the pull of the surface along the contact line, 2πRσ sin a sin(a + θ),
/// a² = 2d/R. The added term counts the surface twice, for the energy holds it already: Lambert et al. took it out.
/// Kept since users know it.
/// \par Units   surface tension [N/m], angle [rad], result [N]
/// \par Domain  as Lambert's
/// \par Accuracy  179 / 43 % (θ = 0: 56 / 15 %), a plane 203 / 45 %; v = 1e-6 to 1e-3: 64 / 20 %
/// \par Source  Rabinovich, Esayanur & Moudgil 2005, Langmuir 21, 10992, Eqs. (19), (20). No rupture of its own: that
///              of Lian
template <class Rupture = lian_rupture>
struct rabinovich {
  required<double> surface_tension;
  double contact_angle = 0;
  Rupture rupture = {};

  /// Relative error of the force, v from 1e-6 on, θ ≤ 50°, gaps up to 0.9 of the rupture gap; worst measured 2.03.
  static constexpr double stated_accuracy = 2.3;

  template <real T>
  [[nodiscard]] outcome<bridge_pull<T>, bridge_status> bridge(const edge<T>& e, given_volume<T> liquid) const noexcept {
    using std::sin;
    using std::sqrt;
    const lambert<Rupture> upright{surface_tension, contact_angle, rupture};
    auto answer = upright.bridge(e, liquid);
    if (answer.ok()) {
      const T radius = detail::derjaguin_radius(e);
      const T a = sqrt(T(2) * detail::immersion(e.gap, liquid.value, radius) / radius);
      const T scale = detail::fit_number<T>(2 * pi<double> * surface_tension);
      answer.value.force = answer.value.force + scale * radius * sin(a) * sin(a + detail::fit_number<T>(contact_angle));
    }
    return answer;
  }
};
static_assert(bridge_law<rabinovich<>>);

}  // namespace tetrapore::inline TETRAPORE_ABI
