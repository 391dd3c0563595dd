// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/required.hpp"
#include "tetrapore/law/bridge/concept.hpp"

/// \file
/// What the closed forms of a bridge share: the checks of their input, their reduced variables, and the wrapper that
/// carries them into an overlap. The errors that their pages state are relative to the exact force of
/// young_laplace, for one contact angle of 0 to 50° on both surfaces, v = V/R³ (R of Derjaguin) from 1e-3 to 0.1 unless
/// said otherwise, and gaps up to 0.9 of the rupture gap, where the force has fallen to some percent of that at
/// contact: worst / root of the mean square (tests/truth/law/closed_form_bridge_map_test.cpp).
/// \par Source  Chareyre et al., EPJ Web Conf. 140, 09027 (2017), §2.3, whose bridges these forms approximate

namespace tetrapore::inline TETRAPORE_ABI {

/// Where a bridge of given volume breaks, by a fit: the gap [m], from the volume and the one contact angle of the pair.
/// Syntax: `r.gap(edge, volume, contact_angle)`, const and noexcept.
/// Models: lian_rupture, willett_rupture, mikami_rupture, without_rupture.
template <class R, class T = double>
concept rupture_rule = real<T> && std::copyable<R> && requires(const R r, const edge<T> e, const T v, const double a) {
  { r.gap(e, v, a) } noexcept -> std::convertible_to<underlying_t<T>>;
};

namespace detail {

template <real T>
using pull_outcome = outcome<bridge_pull<T>, bridge_status>;

/// The answer without a bridge: no force where the bridge is absent, NaN where the law has no answer.
template <real T>
[[nodiscard]] pull_outcome<T> no_pull(bridge_status why) noexcept {
  return {{verdict_of(why) == verdict::absent ? T(0) : T(quiet_nan<T>)}, why};
}

/// A constant of a fit in the precision of the scalar.
template <real T>
[[nodiscard]] constexpr T fit_number(double x) noexcept {
  return T(static_cast<underlying_t<T>>(x));
}

template <real T>
[[nodiscard]] bool finite_and_positive(const T& x) noexcept {
  return value_of(x) > 0 && value_of(x) < infinity<T>;
}

/// A plane on either side: the laws of bridges take a pair from both of its ends.
template <real T>
[[nodiscard]] bool before_plane(const edge<T>& e) noexcept {
  return !(value_of(e.radius1) < infinity<T>) || !(value_of(e.radius2) < infinity<T>);
}

/// What every law of a pair asks of its input: ok or invalid_input.
template <real T>
[[nodiscard]] bridge_status admit_pair(const edge<T>& e, double surface_tension, double angle1,
                                       double angle2) noexcept {
  const bool angles = angle1 >= 0 && angle1 < pi<double> / 2 && angle2 >= 0 && angle2 < pi<double> / 2;
  const T& smaller = e.radius1 < e.radius2 ? e.radius1 : e.radius2;
  const bool good = angles && finite_and_positive(surface_tension) && finite_and_positive(smaller) &&
                    value_of(e.radius1) > 0 && value_of(e.radius2) > 0 && value_of(e.gap) > -value_of(smaller) &&
                    value_of(e.gap) < infinity<T>;
  return good ? bridge_status::ok : bridge_status::invalid_input;
}

/// The same for a closed form of one contact angle: ok, or why it has no answer. Closed forms know no overlap.
/// \param outside  whether the pair and the reduced volume, where the input is any good, lie outside of its range
template <class Law, real T>
[[nodiscard]] bridge_status admit_fit(const Law& law, const edge<T>& e, const T& volume, bool outside) noexcept {
  const bridge_status pair = admit_pair(e, law.surface_tension, law.contact_angle, law.contact_angle);
  if (pair != bridge_status::ok || !(value_of(volume) >= 0) || !(value_of(volume) < infinity<T>)) {
    return bridge_status::invalid_input;
  }
  if (!(value_of(volume) > 0)) {
    return bridge_status::no_liquid;
  }
  if (value_of(e.gap) < 0 || outside) {
    return bridge_status::not_covered;
  }
  return value_of(e.gap) > law.rupture.gap(e, volume, law.contact_angle) ? bridge_status::ruptured : bridge_status::ok;
}

/// The largest contact angle of the fits, 50°, however it was rounded.
inline constexpr double largest_fitted_angle = 50 * pi<double> / 180 * (1 + 1e-12);

/// Radius of the equal spheres whose gap opens as that of the pair does at its narrowest: 2 R₁ R₂ / (R₁ + R₂); twice
/// that of the sphere before a plane. \par Source  Derjaguin 1934, Kolloid-Z. 69, 155
template <real T>
[[nodiscard]] T derjaguin_radius(const edge<T>& e) noexcept {
  return value_of(e.radius1) < infinity<T> ? T(2) * e.radius1 / (T(1) + e.radius1 / e.radius2) : T(2) * e.radius2;
}

/// Radii that differ by less than what a fit can tell, 1 in 10⁶.
template <real T>
[[nodiscard]] bool equal_radii(const edge<T>& e) noexcept {
  const auto a = value_of(e.radius1);
  const auto b = value_of(e.radius2);
  const auto difference = a > b ? a - b : b - a;
  return difference <= (a < b ? a : b) * static_cast<underlying_t<T>>(1e-6);
}

/// A range in which a fit holds, ends included however they were rounded.
template <real T>
[[nodiscard]] bool within(const T& x, double least, double largest) noexcept {
  const auto slack = static_cast<underlying_t<T>>(1) + 16 * epsilon<T>;
  return value_of(x) * slack >= static_cast<underlying_t<T>>(least) &&
         value_of(x) <= static_cast<underlying_t<T>>(largest) * slack;
}

}  // namespace detail

/// A law carried into an overlap: grains that overlap pull as grains that touch. What most DEM codes do. The closed
/// forms alone refuse an overlap; the exact law takes the two spheres as they cut each other.
/// \par Accuracy  the exact force of an overlap δ is 1 + 1.1 (δ/R) / √v times that at contact, v = V/R³, while δ/R is
///                small beside √v: 3.5 % for δ/R = 1e-3 and v = 1e-3
/// \par Source  a convention, without a source of its own
template <class Law>
struct held_at_contact {
  Law law;

  template <real T, class Given>
    requires bridge_law<Law, T, Given>
  [[nodiscard]] auto bridge(edge<T> e, const Given& given) const noexcept {
    if (e.gap < T(0) && detail::admit_pair(e, 1.0, 0.0, 0.0) == bridge_status::ok) {
      e.gap = T(0);
    }
    return law.bridge(e, given);
  }
};

}  // namespace tetrapore::inline TETRAPORE_ABI
