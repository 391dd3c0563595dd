// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/required.hpp"
#include "tetrapore/geometry/inscribed.hpp"
#include "tetrapore/law/entry/concept.hpp"

#include <array>

namespace tetrapore::inline TETRAPORE_ABI {
namespace detail {

/// Surface tension and contact angle inside the domain of the entry laws.
[[nodiscard]] inline bool wets(double surface_tension, double contact_angle) noexcept {
  return surface_tension > 0 && std::isfinite(surface_tension) && contact_angle >= 0 && contact_angle < pi<double> / 2;
}

template <real T>
[[nodiscard]] constexpr bounding_side2<T> bounding(const opening_side<T>& s) noexcept {
  return {s.point, s.normal, s.radius, s.kind == side_kind::line};
}

template <real T>
[[nodiscard]] outcome<T, entry_status> no_entry(entry_status why) noexcept {
  return {T(quiet_nan<T>), why};
}

}  // namespace detail

/// Capillary pressure at which the non-wetting phase enters a throat, by the inscribed-circle rule p = 2 σ cos θ / r.
/// \par Units   surface tension [N/m], angle [rad], result [Pa]
/// \par Domain  openings of three sides, discs or wall lines, not collinear; θ < 90°. Merged rings are refused
///              (not_covered), gaps may be in any state
/// \par Accuracy  |Δp|/p at most `stated_accuracy` (32 + κ), with κ = L Σ |∂p/∂x| / p over the coordinates and radii of
///                the sides and L the distance from the origin within which they lie. Worst of the tables (truth_check,
///                docs/accuracy.md): 1.3e-15 (32 + κ) where the centres are nearly collinear, 9.1e-14 as a relative
///                error; 3.6e-17 (32 + κ) in all other rows, 9.7e-17 in 2·10⁵ random throats against long double. The
///                rule itself is above the Mayer-Stowe-Princen value, as a rule by 13-21 % at θ = 0 and twice as much
///                at 60°
/// \par Source  Chareyre et al., EPJ Web Conf. 140, 09027 (2017), §2.3
struct inscribed_circle {
  required<double> surface_tension;
  double contact_angle = 0;

  /// Relative error of the pressure per unit of 32 + κ.
  static constexpr double stated_accuracy = 2.4e-15;

  template <real T>
  [[nodiscard]] outcome<T, entry_status> entry_pressure(const opening<T>& o) const noexcept {
    using std::cos;
    if (!detail::wets(surface_tension, contact_angle) || o.count < 3 || o.count > opening<T>::max_sides) {
      return detail::no_entry<T>(entry_status::invalid_input);
    }
    if (o.count != 3) {
      return detail::no_entry<T>(entry_status::not_covered);
    }
    const auto c = circle_between(std::array<bounding_side2<T>, 3>{
        detail::bounding(o.sides[0]), detail::bounding(o.sides[1]), detail::bounding(o.sides[2])});
    switch (c.reason) {
      case inscribed_status::ok: break;
      case inscribed_status::covered: return {T(infinity<T>), entry_status::closed};
      case inscribed_status::none:
      case inscribed_status::degenerate: return detail::no_entry<T>(entry_status::no_hole);
      case inscribed_status::invalid_input: return detail::no_entry<T>(entry_status::invalid_input);
    }
    using value_type = underlying_t<T>;
    const auto tension = static_cast<value_type>(surface_tension.get()) * cos(static_cast<value_type>(contact_angle));
    return {T(2 * tension) / c.value.radius, entry_status::ok};
  }
};
static_assert(entry_law<inscribed_circle, double>);

}  // namespace tetrapore::inline TETRAPORE_ABI
