// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/required.hpp"
#include "tetrapore/law/lubrication/concept.hpp"

namespace tetrapore::inline TETRAPORE_ABI {

/// What grows without bound where two grains meet, for any two radii, a plane among them: the paper's Eq. 2 and Eq. 3
/// for equal grains, and with a* = a1 a2/(a1 + a2) and x_i = a_i/(a1 + a2) in general
///
///   squeeze   6 π μ a*²/h                                (Eq. 2 with a = 2 a*)
///   shear     π μ Λ (8/5) a* (2 x1² + x1 x2 + 2 x2²)     (a for equal grains: Eq. 3)
///   coupling  π μ Λ (12/5) a*² (x2 − x1)                 (0 for equal grains)
///   roll      π μ Λ (24/5) a*³                           ((3/5) a³ for equal grains)
///   twist     0                                          (bounded at contact)
///
///   Λ = (1 + h/4a*) ln(1 + 4a*/h) − 1, which is Eq. 3 for equal grains and ln(a*/h) near contact.
///
/// No single radius makes Eq. 3 right for unequal grains: slip and roll are coupled. Positive definite, for
/// shear × roll − coupling² = (π μ Λ)² (48/5) a*⁴ for any radii.
/// \par Units   viscosity [Pa s]; the resistance as in pair_resistance
/// \par Domain  any radii, sphere and plane; gap > 0 (decays as 1/h beyond the radius, without a limit of its own)
/// \par Accuracy  rounding: 8 epsilon. Of the physics, against two_spheres: docs/lubrication.md. Squeeze is short, to
///                leading order by (9/10) ξ ln(1/ξ) of itself for equal grains (1.1e-3 at ξ = h/a = 1e-4, 6.4 % at
///                0.01, 33 % at 0.1); shear, coupling and roll by a bounded part beside ln(1/ξ)
/// \par Source  Chareyre et al., EPJ Web Conf. 140, 09027 (2017), §2.2, Eq. (2) and (3); unequal radii: own derivation,
///              the singular parts of Jeffrey & Onishi 1984, J. Fluid Mech. 139, 261, put into objective form
struct leading_order {
  required<double> viscosity;

  /// Relative error against two grains alone in the liquid, or a grain beside a plane, of shear, coupling (of √(shear ×
  /// roll)) and roll in units of 4 / (4 + L), and of the squeeze in units of L / y, where y = 4a*/h and L = ln(1 + y):
  /// how it fades as the gap closes. Radii 1 to 0.1 and a plane, gaps 1e-8 a1 to 10 a1; worst measured 1.25 and 2.42.
  static constexpr double stated_accuracy = 1.5;
  static constexpr double stated_squeeze_accuracy = 2.6;

  template <real T>
  [[nodiscard]] outcome<pair_resistance<T>, pair_status> resistance(const edge<T>& e) const noexcept {
    const pair_status first = detail::admit_pair(e, viscosity);
    if (first != pair_status::ok) {
      return detail::no_resistance<T>(first);
    }
    // no quotient waits for another: the divisions run side by side
    const bool wall = e.with_plane();
    const T sum = wall ? T(1) : e.radius1 + e.radius2;
    const T product = wall ? e.radius1 : e.radius1 * e.radius2;
    const T per_sum = T(1) / sum;
    const T x1 = wall ? T(0) : e.radius1 * per_sum;
    const T x2 = wall ? T(1) : e.radius2 * per_sum;
    const T star = product * per_sum;
    const T thin = sum * e.gap;
    const T y = T(4) * product / thin;
    const T inverse = thin / (T(4) * product);
    const T scale = detail::constant<T>(pi<long double>) * T(static_cast<underlying_t<T>>(viscosity.get()));
    const T shearing = scale * star * logarithm(y, inverse) * T(0.8);
    const T squeeze = T(1.5) * scale * star * y;
    return detail::resistance_of(e, squeeze, shearing * (T(4) * (x1 * x1 + x2 * x2) + T(2) * x1 * x2),
                                 T(3) * shearing * star * (x2 - x1), T(6) * shearing * star * star, T(0));
  }

  /// Λ by y = 4a*/h and 1/y: (1 + 1/y) ln(1 + y) − 1, where it is small by its series y/2 − y²/6 + y³/12 − …
  template <real T>
  [[nodiscard]] static T logarithm(const T& y, const T& inverse) noexcept {
    using std::log;
    if (y < T(0.0625)) {
      T sum(0);
      for (int k = 16; k >= 1; --k) {  // 0.0625^17 is below the rounding of long double
        sum = T(static_cast<underlying_t<T>>(1) / static_cast<underlying_t<T>>(k * (k + 1))) - y * sum;
      }
      return y * sum;
    }
    return (T(1) + inverse) * log(T(1) + y) - T(1);
  }
};
static_assert(lubrication_law<leading_order, double>);

}  // namespace tetrapore::inline TETRAPORE_ABI
