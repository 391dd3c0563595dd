// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/bridge/rupture_fits.hpp"

namespace tetrapore::inline TETRAPORE_ABI {

namespace detail {

/// Depth by which each of two equal spheres dips into a liquid disc with upright rim: V = 2πRd (D/2 + d/2)·2, solved
/// without cancellation at D → 0.
template <real T>
[[nodiscard]] T immersion(const T& gap, const T& volume, const T& radius) noexcept {
  using std::sqrt;
  const T w = volume / (T(pi<T>) * radius);  // 2 d (D + d)
  return w / (gap + sqrt(gap * gap + T(2) * w));
}

}  // namespace detail

/// F = 2πRσ cos θ · 2d / (D + 2d): the derivative by the gap of the surface energy of a disc of liquid with an upright
/// rim between two paraboloids, d = (D/2) (−1 + √(1 + 2V / πRD²)) its depth on each. Unequal radii and planes by the
/// radius of Derjaguin, exact for paraboloids.
/// \par Units   surface tension [N/m], angle [rad], result [N]
/// \par Domain  any radii, a plane; V/R³ ≤ 0.1, R of Derjaguin; gaps from 0 on
/// \par Accuracy  63 / 27 % (θ = 0: 27 / 16 %), a plane 75 / 23 %; at contact exact for v → 0, 1.7 % off at 1e-6, 6 %
///                at 1e-4 and θ = 0, 61 % at 0.1 and 50°; v = 1e-6 to 1e-3: 60 / 27 %, within 11 % of the force at
///                contact
/// \par Source  Lambert et al. 2008, Langmuir 24, 3157, Eq. (65), the energy term of Rabinovich et al. 2005; derived
///              anew. No rupture of its own: that of Lian
template <class Rupture = lian_rupture>
struct lambert {
  required<double> surface_tension;
  double contact_angle = 0;
  Rupture rupture = {};

  /// Relative error of the force, v from 1e-6 on, θ ≤ 50°, gaps up to 0.9 of the rupture gap; worst measured 0.75.
  static constexpr double stated_accuracy = 0.9;

  template <real T>
  [[nodiscard]] outcome<bridge_pull<T>, bridge_status> bridge(const edge<T>& e, given_volume<T> liquid) const noexcept {
    const T radius = detail::derjaguin_radius(e);
    const bool outside = !detail::within(liquid.value / (radius * radius * radius), 0, 0.1);
    const bridge_status found = detail::admit_fit(*this, e, liquid.value, outside);
    if (found != bridge_status::ok) {
      return detail::no_pull<T>(found);
    }
    const T twice = T(2) * detail::immersion(e.gap, liquid.value, radius);
    const T scale = detail::fit_number<T>(2 * pi<double> * surface_tension * std::cos(contact_angle));
    return {{scale * radius * twice / (e.gap + twice)}, bridge_status::ok};
  }
};
static_assert(bridge_law<lambert<>>);

}  // namespace tetrapore::inline TETRAPORE_ABI
