// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/lubrication/concept.hpp"

/// \file
/// From the motion of two grains and the resistance of the pair to forces and torques on both: the one place
/// where slip, opposite forces and the balance of torques are written.

namespace tetrapore::inline TETRAPORE_ABI {

/// How the two grains move; for a plane the velocity of its foot point under grain 1.
/// \par Units  velocities [m/s], spins [rad/s]
template <real T>
struct pair_motion {
  vec3<T> velocity1;
  vec3<T> spin1;
  vec3<T> velocity2;
  vec3<T> spin2;
};

/// Forces on both grains, and torques about their centres (of a plane: about its foot point).
/// \par Units  [N], [N m]
template <real T>
struct pair_forces {
  vec3<T> force1;
  vec3<T> torque1;
  vec3<T> force2;
  vec3<T> torque2;
};

/// What is left of the motion when the rigid motions of the pair are taken out.
/// \par Units  [m/s]; roll and twist [rad/s]
template <real T>
struct relative_motion {
  T opening;     ///< (V2 − V1)·n, the rate of the gap
  vec3<T> slip;  ///< (V2 − V1)_t − (b1 ω1 + b2 ω2) × n: of surface 2 on surface 1, in the middle of the gap
  vec3<T> roll;  ///< (ω1 − ω2) × n
  T twist;       ///< (ω2 − ω1)·n
};

/// \par Units   as of the arguments
/// \par Domain  arms that add up to the distance of the centres; a unit normal
/// \par Accuracy  rounding. A rigid motion of the pair has no part in any of the four
/// \par Source  own derivation; with arms b = a in place of a + h/2 a rigid rotation Ω would leave a slip h Ω × n
template <real T>
[[nodiscard]] constexpr relative_motion<T> relative_motion_of(const pair_motion<T>& m, const vec3<T>& normal, T arm1,
                                                              T arm2) noexcept {
  const vec3<T> apart = m.velocity2 - m.velocity1;
  const vec3<T> spread = m.spin1 - m.spin2;
  const T opening = dot(apart, normal);
  return {opening, apart - normal * opening - cross(m.spin1 * arm1 + m.spin2 * arm2, normal), cross(spread, normal),
          -dot(spread, normal)};
}

namespace detail {

/// Forces of a pair from what drags: opening force, slip force (on grain 1), roll force and twist torque.
template <real T>
[[nodiscard]] constexpr pair_forces<T> forces_of(const vec3<T>& normal, T arm1, T arm2, T pull, const vec3<T>& drag,
                                                 const vec3<T>& rolling, T twisting) noexcept {
  const vec3<T> force = normal * pull + drag;
  const vec3<T> lever = cross(normal, drag);
  const vec3<T> couple = cross(normal, rolling) - normal * twisting;
  return {force, lever * arm1 - couple, -force, lever * arm2 + couple};
}

}  // namespace detail

/// Forces and torques of the liquid on both grains: opposite forces, torques that balance about any point.
/// \par Units   [N], [N m]
/// \par Domain  any motion; a resistance with NaN gives NaN
/// \par Accuracy  rounding
/// \par Source  minus half the slopes of the power by the velocities and spins; Chareyre et al., EPJ Web Conf. 140,
///              09027 (2017), §2.2, for the two terms of translation
template <real T>
[[nodiscard]] constexpr pair_forces<T> apply(const pair_resistance<T>& r, const pair_motion<T>& m) noexcept {
  const relative_motion<T> v = relative_motion_of(m, r.normal, r.arm1, r.arm2);
  return detail::forces_of(r.normal, r.arm1, r.arm2, r.squeeze * v.opening, v.slip * r.shear + v.roll * r.coupling,
                           v.slip * r.coupling + v.roll * r.roll, r.twist * v.twist);
}

/// The power that the liquid takes out of a motion, never negative.
/// \par Units   [W]
/// \par Domain  any motion
/// \par Accuracy  rounding
/// \par Source  the quadratic form of pair_resistance
template <real T>
[[nodiscard]] constexpr T power(const pair_resistance<T>& r, const pair_motion<T>& m) noexcept {
  const relative_motion<T> v = relative_motion_of(m, r.normal, r.arm1, r.arm2);
  return r.squeeze * v.opening * v.opening + r.shear * norm2(v.slip) + T(2) * r.coupling * dot(v.slip, v.roll) +
         r.roll * norm2(v.roll) + r.twist * v.twist * v.twist;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
