// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/bridge/rupture_fits.hpp"

namespace tetrapore::inline TETRAPORE_ABI {

/// F = πσ √(R₁R₂) (c + exp(a D/R + b)), R the larger radius, v = V/R³: a = −1.1 v^(−0.53),
/// b = (−0.148 ln v − 0.96) θ² − 0.0082 ln v + 0.48, c = 0.0018 ln v + 0.078.
/// \par Units   surface tension [N/m], angle [rad], result [N]
/// \par Domain  two spheres of radii up to 1 : 2; 1e-4 ≤ V/R³ ≤ 0.1; θ ≤ 50°; gaps from 0 on
/// \par Accuracy  equal spheres 64 / 13 % (θ = 0: 12 / 5.7 %), v = 1e-4 to 1e-3 106 / 31 %, below that several times
///                the force; radii 1 : 2 100 / 21 % (θ = 0: 30 / 16 %). √(R₁R₂) is not the limit of little liquid,
///                2R₁R₂/(R₁ + R₂): at 1 : 10 it is off by a factor of 2
/// \par Source  Soulié, Cherblanc, El Youssoufi & Saix 2006, Int. J. Numer. Anal. Methods Geomech. 30, 213; rupture as
///              there, by Lian
template <class Rupture = lian_rupture>
struct soulie {
  required<double> surface_tension;
  double contact_angle = 0;
  Rupture rupture = {};

  /// Relative error of the force over the domain, gaps up to 0.9 of the rupture gap; worst measured 1.10.
  static constexpr double stated_accuracy = 1.3;

  template <real T>
  [[nodiscard]] outcome<bridge_pull<T>, bridge_status> bridge(const edge<T>& e, given_volume<T> liquid) const noexcept {
    using std::exp;
    using std::log;
    using std::sqrt;
    const T radius = e.radius1 < e.radius2 ? e.radius2 : e.radius1;
    const T reduced = liquid.value / (radius * radius * radius);
    const bool outside = detail::before_plane(e) || contact_angle > detail::largest_fitted_angle ||
                         !detail::within(reduced, 1e-4, 0.1) || !detail::within(e.radius1 / e.radius2, 0.5, 2);
    const bridge_status found = detail::admit_fit(*this, e, liquid.value, outside);
    if (found != bridge_status::ok) {
      return detail::no_pull<T>(found);
    }
    const auto number = [](double x) { return detail::fit_number<T>(x); };
    const double square = contact_angle * contact_angle;
    const T l = log(reduced);
    const T a = number(-1.1) * exp(number(-0.53) * l);
    const T b = number(-0.96 * square + 0.48) + number(-0.148 * square - 0.0082) * l;
    const T c = number(0.0018) * l + number(0.078);
    const T scale = number(pi<double> * surface_tension);
    return {{scale * sqrt(e.radius1 * e.radius2) * (c + exp(a * e.gap / radius + b))}, bridge_status::ok};
  }
};
static_assert(bridge_law<soulie<>>);

}  // namespace tetrapore::inline TETRAPORE_ABI
