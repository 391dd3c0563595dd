// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/bridge/rupture_fits.hpp"

namespace tetrapore::inline TETRAPORE_ABI {

/// A half filling angle β fitted to the volume, V = 0.12 (2R)³ sin⁴β (1 + 3 D/R) (1 + 1.1 sin θ), and the force of the
/// toroid at the contact line: πR²σ sin²β (1/r₁ − 1/r₂) + 2πRσ sin β sin(β + θ),
/// r₁ = (2R (1 − cos β) + D) / (2 cos(β + θ)), r₂ = R sin β + r₁ (sin(β + θ) − 1). For equal spheres.
/// \par Units   surface tension [N/m], angle [rad], result [N]
/// \par Domain  equal spheres; 10° ≤ β ≤ 40°, D ≤ R/5, θ ≤ 50°; gaps from 0 on
/// \par Accuracy  at contact 6.9 / 2.9 %; up to half the rupture gap 128 / 37 %, beyond 200 / 109 %: the volume grows
///                with the gap by far more than the fit has it
/// \par Source  Weigert & Ripperger 1999, Part. Part. Syst. Charact. 16, 238, Eqs. (5), (6), (15)-(17), (22). No
///              rupture of its own: that of Lian
template <class Rupture = lian_rupture>
struct weigert_ripperger {
  required<double> surface_tension;
  double contact_angle = 0;
  Rupture rupture = {};

  /// Relative error of the force over the domain, gaps up to 0.9 of the rupture gap; worst measured 2.00.
  static constexpr double stated_accuracy = 2.3;

  template <real T>
  [[nodiscard]] outcome<bridge_pull<T>, bridge_status> bridge(const edge<T>& e, given_volume<T> liquid) const noexcept {
    using std::sqrt;
    const T radius = e.radius1;
    const T reduced = liquid.value / (radius * radius * radius);
    const T gap = e.gap / radius;
    const double sine = std::sin(contact_angle);
    const double cosine = std::cos(contact_angle);
    const T square = sqrt(reduced / (detail::fit_number<T>(0.96 * (1 + 1.1 * sine)) * (T(1) + T(3) * gap)));  // sin² β
    const bool outside = !detail::equal_radii(e) || contact_angle > detail::largest_fitted_angle ||
                         gap > detail::fit_number<T>(0.2) || !detail::within(square, least_square, largest_square);
    const bridge_status found = detail::admit_fit(*this, e, liquid.value, outside);
    if (found != bridge_status::ok) {
      return detail::no_pull<T>(found);
    }
    const T s = sqrt(square);
    const T c = sqrt(T(1) - square);
    const T sum_sine = s * detail::fit_number<T>(cosine) + c * detail::fit_number<T>(sine);  // sin(β + θ)
    const T sum_cosine = c * detail::fit_number<T>(cosine) - s * detail::fit_number<T>(sine);
    const T r1 = (T(2) * square / (T(1) + c) + gap) / (T(2) * sum_cosine);
    const T r2 = s + r1 * (sum_sine - T(1));
    const T scale = detail::fit_number<T>(pi<double> * surface_tension);
    return {{scale * radius * (square * (T(1) / r1 - T(1) / r2) + T(2) * s * sum_sine)}, bridge_status::ok};
  }

 private:
  static constexpr double least_square = 0.0301536896;    // sin² 10°
  static constexpr double largest_square = 0.4131759112;  // sin² 40°
};
static_assert(bridge_law<weigert_ripperger<>>);

}  // namespace tetrapore::inline TETRAPORE_ABI
