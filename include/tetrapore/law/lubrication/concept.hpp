// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/outcome.hpp"
#include "tetrapore/simplex/edge.hpp"

/// \file
/// What a lubrication law is: the resistance of the liquid between two grains, or a grain and a plane, to their motion
/// relative to each other.

namespace tetrapore::inline TETRAPORE_ABI {

/// Why a pair resistance is what it is.
enum class pair_status : unsigned char {
  ok,
  touching,      ///< refused: no gap, the resistance has no bound; roughness or a contact law takes over
  too_far,       ///< refused: beyond the gap that the law covers
  not_covered,   ///< refused: the law does not cover this pair (a plane, no plane, its range of radius ratios)
  invalid_input  ///< refused: NaN, a radius or parameter outside its domain
};

[[nodiscard]] constexpr verdict verdict_of(pair_status s) noexcept {
  return s == pair_status::ok ? verdict::ok : verdict::refused;
}

[[nodiscard]] constexpr const char* describe(pair_status s) noexcept {
  switch (s) {
    case pair_status::ok: return "ok";
    case pair_status::touching: return "there is no gap between the grains";
    case pair_status::too_far: return "the gap is wider than the law covers";
    case pair_status::not_covered: return "the law does not cover a pair like this";
    case pair_status::invalid_input: return "a radius, gap or parameter outside the domain";
  }
  return "not a pair status";
}
static_assert(status<pair_status>);

/// Resistance of a pair to relative motion: the quadratic form of the power that the liquid takes,
///
///   P = squeeze v² + shear |s|² + 2 coupling s·ρ + roll |ρ|² + twist τ²,
///
/// in the four motions that no rigid motion of the pair has a part in: v, closing or opening of the gap; s, slip of the
/// two surfaces; ρ = (ω1 − ω2) × n, rolling; τ = (ω2 − ω1)·n, twisting. relative_motion_of has the formulas, apply the
/// forces. A plane moves as a grain whose centre is its foot point under grain 1.
/// \par Units  squeeze, shear [N s/m]; coupling [N s]; roll, twist [N m s]; arms [m]
template <real T>
struct pair_resistance {
  T squeeze;
  T shear;
  T coupling;
  T roll;
  T twist;
  T arm1;          ///< from the centre of grain 1 to the middle of the gap
  T arm2;          ///< from the middle of the gap to the centre of grain 2, or to the foot point on a plane
  vec3<T> normal;  ///< unit vector from the first to the second
};

/// The lubrication of a pair.
/// Syntax: `l.resistance(edge)`, const and noexcept, gives an outcome<pair_resistance, pair_status>.
/// Semantics: linear in the viscosity; positive semi-definite: squeeze, shear, roll, twist ≥ 0 and coupling² ≤ shear ×
/// roll; the same pair seen from its other end has the same numbers but for the sign of the coupling and the order of
/// the arms; the arms add up to the distance of the centres; NaN where the law has no answer; pure: no state, safe in
/// threads. Forces and torques, slip included, are not the law's: apply(resistance, motion) owns them for all laws.
/// Models: leading_order, two_spheres, sphere_plane, rough<Law>; a user's own.
/// \par Source  Chareyre et al., EPJ Web Conf. 140, 09027 (2017), §2.2, Eq. (2) and (3); the form: own derivation
template <class L, class T = double>
concept lubrication_law = real<T> && std::copyable<L> && requires(const L l, const edge<T> e) {
  { l.resistance(e) } noexcept -> std::same_as<outcome<pair_resistance<T>, pair_status>>;
};

namespace detail {

template <real T>
[[nodiscard]] constexpr outcome<pair_resistance<T>, pair_status> no_resistance(pair_status why) noexcept {
  const T none(quiet_nan<T>);
  return {{none, none, none, none, none, none, none, {none, none, none}}, why};
}

/// Whether a normal has the length 1, to what a float keeps of it.
template <real T>
[[nodiscard]] constexpr bool unit(const vec3<T>& normal) noexcept {
  const T off = dot(normal, normal) - T(1);
  const T slack(static_cast<underlying_t<T>>(1e-5));
  return off < slack && -slack < off;
}

/// Whether a law may look at the pair: a viscosity, two radii, a gap and a normal. A plane has an infinite radius2.
template <real T>
[[nodiscard]] constexpr pair_status admit_pair(const edge<T>& e, double viscosity) noexcept {
  const T limit(infinity<T>);
  if (!(viscosity > 0 && viscosity < infinity<double>) || !(e.radius1 > T(0)) || !(e.radius1 < limit) ||
      !(e.radius2 > T(0)) || !(e.gap < limit) || !(-limit < e.gap) || !unit(e.normal)) {
    return pair_status::invalid_input;
  }
  return e.gap > T(0) ? pair_status::ok : pair_status::touching;
}

/// The answer, with the arms b = a + h/2 that add up to the distance of the centres; refused where the gap is so narrow
/// that the numbers overflow.
template <real T>
[[nodiscard]] constexpr outcome<pair_resistance<T>, pair_status> resistance_of(const edge<T>& e, T squeeze, T shear,
                                                                               T coupling, T roll, T twist) noexcept {
  if (!(squeeze > T(0))) {  // lengths whose products underflow
    return no_resistance<T>(pair_status::invalid_input);
  }
  if (!(squeeze < T(infinity<T>))) {
    return no_resistance<T>(pair_status::touching);
  }
  const T half = e.gap * T(0.5);
  return {{squeeze, shear, coupling, roll, twist, e.radius1 + half, e.with_plane() ? half : e.radius2 + half, e.normal},
          pair_status::ok};
}

/// A decimal constant in the scalar's own precision.
template <real T>
[[nodiscard]] constexpr T constant(long double x) noexcept {
  return T(static_cast<underlying_t<T>>(x));
}

}  // namespace detail
}  // namespace tetrapore::inline TETRAPORE_ABI
