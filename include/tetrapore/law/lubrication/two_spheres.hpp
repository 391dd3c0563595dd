// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/required.hpp"
#include "tetrapore/law/lubrication/concept.hpp"
#include "tetrapore/law/lubrication/regular_part.hpp"

namespace tetrapore::inline TETRAPORE_ABI {

/// Two spheres alone in a liquid at rest, on which no other force or torque acts: push them apart, slide, roll or twist
/// them with opposite forces and balanced torques, and this is what they resist. It is the resistance of the whole
/// two-sphere problem with the rigid motions left free, so it is zero for those, singular as leading_order at contact,
/// and has all that is bounded there as well, down to the drag of each sphere.
/// \par Units   viscosity [Pa s]; the resistance as in pair_resistance
/// \par Domain  radius ratios 1 to 0.1, no plane; 0 < gap ≤ 2a* = 2 a1 a2/(a1 + a2) (one radius between equal spheres,
///              two small radii at 0.1); beyond: not_covered, too_far
/// \par Accuracy  against the exact solution: squeeze 3e-6, shear 8e-5, coupling 3e-4 (of √(shear × roll)), roll 3e-4,
///                twist 2e-4 up to h = a*/5; 9e-6, 7e-4, 6e-4, 5e-4, 1e-3 over the whole domain. Rounding 1e-13; in
///                float 1e-4
/// \par Source  Jeffrey & Onishi 1984, J. Fluid Mech. 139, 261; elimination of the rigid motions and fit: own
struct two_spheres {
  required<double> viscosity;

  /// Relative error of shear, coupling (of √(shear × roll)), roll and twist over the whole domain; of the squeeze.
  static constexpr double stated_accuracy = 1e-3;
  static constexpr double stated_squeeze_accuracy = 1e-5;

  template <real T>
  [[nodiscard]] outcome<pair_resistance<T>, pair_status> resistance(const edge<T>& e) const noexcept {
    using std::log;
    const pair_status first = detail::admit_pair(e, viscosity);
    if (first != pair_status::ok) {
      return detail::no_resistance<T>(first);
    }
    const T margin = T(1 + 8 * epsilon<T>);
    if (!(e.radius1 < T(10) * margin * e.radius2) || !(e.radius2 < T(10) * margin * e.radius1)) {
      return detail::no_resistance<T>(pair_status::not_covered);
    }
    // few quotients wait for another: the divisions run side by side
    const T sum = e.radius1 + e.radius2;
    const T apart = e.radius1 - e.radius2;
    const T product = e.radius1 * e.radius2;
    const T thin = sum * e.gap;
    const T per_sum = T(1) / sum;
    const T x = T(4) * apart * apart / (sum * sum + T(0.5) * apart * apart) - T(1);
    const T y = T(4) * product / thin;
    const T p = thin / (thin + T(4) * product);
    const T star = product * per_sum;
    if (!(e.gap < T(2) * margin * star)) {
      return detail::no_resistance<T>(pair_status::too_far);
    }
    const T beta = apart * per_sum;
    const T square = beta * beta;
    const T logarithm = log(T(1) + y);
    const auto rest = detail::regular_part(detail::regular_of_spheres_as<underlying_t<T>>, x, p, logarithm);
    const T scale = detail::constant<T>(pi<long double>) * T(static_cast<underlying_t<T>>(viscosity.get())) * star;
    const T bulk = T(1) + T(3) * square;
    const auto tenths = [](double of) { return detail::constant<T>(static_cast<long double>(of) / 10); };
    return detail::resistance_of(
        e, T(6) * scale * (y * T(0.25) + (tenths(4.5) - T(0.25) * square) * logarithm + rest[0]),
        scale * ((T(2) + tenths(12) * square) * logarithm + rest[1]),
        scale * star * beta * (rest[2] - tenths(24) * logarithm),
        scale * star * star * (tenths(48) * logarithm + rest[3]), scale * star * star * rest[4] / (bulk * bulk));
  }
};
static_assert(lubrication_law<two_spheres, double>);

}  // namespace tetrapore::inline TETRAPORE_ABI
