// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/bridge/closed_form.hpp"

/// \file
/// Gaps at which a bridge of given volume breaks, by fits: plain numbers, for they are compared, never differentiated.

namespace tetrapore::inline TETRAPORE_ABI {

/// (1 + θ/2) V^⅓.
/// \par Units   volume [m³], contact angle [rad], result [m]
/// \par Domain  any; the source has equal spheres
/// \par Accuracy  against the exact rupture gap, θ ≤ 50°, v = 1e-6 to 0.1: equal spheres −5 to +4 % (1e-3 and below −1
///                to +4 %); radii 1 : 2 up to +17 %, a plane up to +39 %
/// \par Source  Lian, Thornton & Adams 1993, J. Colloid Interface Sci. 161, 138, Eq. (15)
struct lian_rupture {
  /// Relative error of the gap, θ ≤ 50°, v = 1e-6 to 0.1, any radii, a plane among them; worst measured 0.39.
  static constexpr double stated_accuracy = 0.4;

  template <real T>
  [[nodiscard]] underlying_t<T> gap(const edge<T>&, const T& volume, double contact_angle) const noexcept {
    return static_cast<underlying_t<T>>(1 + contact_angle / 2) * std::cbrt(value_of(volume));
  }
};
static_assert(rupture_rule<lian_rupture>);

/// (1 + θ (1 + q)/4) (v^⅓ + (q/2 − 2/5) v^⅔) R, v = V/R³, q the smaller radius over the larger and R that of Derjaguin;
/// (1 + θ/2) (v^⅓ + v^⅔/10) R for equal spheres.
/// \par Units   volume [m³], contact angle [rad], result [m]
/// \par Domain  any radii; a plane is the limit q = 0
/// \par Accuracy  against the exact rupture gap, θ ≤ 50°, v = 1e-6 to 0.1: equal spheres −0.5 to +4.1 % (0.5 % at θ =
///                0), radii 1 : 2 −3.5 to +1.3 %, 1 : 10 to a plane −10 to +2 % (1.7 % at θ = 0). Against the fold
///                alone, which equal spheres with θ of some 30° and more do not reach: −2.5 to +3.8 %
/// \par Source  Willett et al. 2000, Langmuir 16, 9396, Eq. (15) and its form for unequal radii
struct willett_rupture {
  /// Relative error of the gap, θ ≤ 50°, v = 1e-6 to 0.1, any radii, a plane among them; worst measured 0.096.
  static constexpr double stated_accuracy = 0.11;

  template <real T>
  [[nodiscard]] underlying_t<T> gap(const edge<T>& e, const T& volume, double contact_angle) const noexcept {
    using number = underlying_t<T>;
    const number a = value_of(e.radius1);
    const number b = value_of(e.radius2);
    const number q = a < b ? a / b : b / a;
    const number radius = value_of(detail::derjaguin_radius(e));
    const number v = std::cbrt(value_of(volume)) / radius;
    return radius * (1 + static_cast<number>(contact_angle / 4) * (1 + q)) *
           (v + (q / 2 - static_cast<number>(0.4)) * v * v);
  }
};
static_assert(rupture_rule<willett_rupture>);

/// (0.99 + 0.62 θ) V^0.34 R for equal spheres, V in R³.
/// \par Units   volume [m³], contact angle [rad], result [m]
/// \par Domain  equal spheres
/// \par Accuracy  against the exact rupture gap, θ ≤ 50°, v = 1e-6 to 0.1: −10 to +5 %
/// \par Source  Mikami, Kamiya & Horio 1998, Chem. Eng. Sci. 53, 1927
struct mikami_rupture {
  /// Relative error of the gap, θ ≤ 50°, v = 1e-6 to 0.1, equal spheres; worst measured 0.10.
  static constexpr double stated_accuracy = 0.11;

  template <real T>
  [[nodiscard]] underlying_t<T> gap(const edge<T>& e, const T& volume, double contact_angle) const noexcept {
    using number = underlying_t<T>;
    const number radius = value_of(detail::derjaguin_radius(e));
    const number reduced = value_of(volume) / (radius * radius * radius);
    return static_cast<number>(0.99 + 0.62 * contact_angle) * std::pow(reduced, static_cast<number>(0.34)) * radius;
  }
};
static_assert(rupture_rule<mikami_rupture>);

/// Never: a formula alone, as far as it goes. \par Source  none
struct without_rupture {
  template <real T>
  [[nodiscard]] underlying_t<T> gap(const edge<T>&, const T&, double) const noexcept {
    return infinity<T>;
  }
};
static_assert(rupture_rule<without_rupture>);

}  // namespace tetrapore::inline TETRAPORE_ABI
