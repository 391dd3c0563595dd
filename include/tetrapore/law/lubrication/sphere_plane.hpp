// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/required.hpp"
#include "tetrapore/law/lubrication/concept.hpp"
#include "tetrapore/law/lubrication/regular_part.hpp"

namespace tetrapore::inline TETRAPORE_ABI {

/// A sphere near a plane wall in a liquid at rest with the wall: the exact resistance, drag included. The plane is the
/// second of the pair (an infinite radius2).
/// \par Units   viscosity [Pa s]; the resistance as in pair_resistance
/// \par Domain  a plane; 0 < gap ≤ 2 radii; beyond: too_far; two spheres: not_covered
/// \par Accuracy  against the exact solution: squeeze 1e-6, shear 2e-5, coupling 3e-5 (of √(shear × roll)), roll and
///                twist 3e-4 up to h = a/5; 3e-6, 2e-5, 8e-5, 4e-4, 1.5e-3 over the whole domain. Rounding 1e-13; in
///                float 1e-4
/// \par Source  Brenner 1961, Chem. Eng. Sci. 16, 242; O'Neill 1964, Mathematika 11, 67; Goldman, Cox & Brenner 1967,
///              Chem. Eng. Sci. 22, 637; Jeffery 1915; objective form and fit: own
struct sphere_plane {
  required<double> viscosity;

  /// Relative error of shear, coupling (of √(shear × roll)), roll and twist over the whole domain; of the squeeze.
  static constexpr double stated_accuracy = 1.5e-3;
  static constexpr double stated_squeeze_accuracy = 3e-6;

  template <real T>
  [[nodiscard]] outcome<pair_resistance<T>, pair_status> resistance(const edge<T>& e) const noexcept {
    using std::log;
    const pair_status first = detail::admit_pair(e, viscosity);
    if (first != pair_status::ok) {
      return detail::no_resistance<T>(first);
    }
    if (!e.with_plane()) {
      return detail::no_resistance<T>(pair_status::not_covered);
    }
    const T radius = e.radius1;
    if (!(e.gap < T(2 + 16 * epsilon<T>) * radius)) {
      return detail::no_resistance<T>(pair_status::too_far);
    }
    const T y = T(4) * radius / e.gap;
    const T p = T(1) / (T(1) + y);
    const T logarithm = log(T(1) + y);
    const auto rest = detail::regular_part(detail::regular_of_plane_as<underlying_t<T>>, T(0), p, logarithm);
    const T scale = detail::constant<T>(pi<long double>) * T(static_cast<underlying_t<T>>(viscosity.get())) * radius;
    const T fifth = detail::constant<T>(0.2L) * logarithm;
    return detail::resistance_of(e, T(6) * scale * (y * T(0.25) + fifth + rest[0]), scale * (T(16) * fifth + rest[1]),
                                 scale * radius * (T(12) * fifth - rest[2]),
                                 scale * radius * radius * (T(24) * fifth + rest[3]),
                                 scale * radius * radius * rest[4]);
  }
};
static_assert(lubrication_law<sphere_plane, double>);

}  // namespace tetrapore::inline TETRAPORE_ABI
