// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/vec3.hpp"

/// \file
/// Signed solid angle of a triangle.

namespace tetrapore::inline TETRAPORE_ABI {

namespace detail {

/// The complex number whose argument is half the solid angle: (real part, triple product).
template <real T>
[[nodiscard]] constexpr T half_angle_cosine(const vec3<T>& a, const vec3<T>& b, const vec3<T>& c, const T& la,
                                            const T& lb, const T& lc) noexcept {
  return la * lb * lc + dot(a, b) * lc + dot(a, c) * lb + dot(b, c) * la;
}

template <real T>
[[nodiscard]] T solid_angle(const vec3<T>& a, const vec3<T>& b, const vec3<T>& c, const T& la, const T& lb,
                            const T& lc) noexcept {
  using std::atan2;
  // a narrow cone keeps its digits when the longer vectors are counted from the shortest
  const T volume = la <= lb && la <= lc ? triple(a, b - a, c - a)
                   : lb <= lc           ? triple(b, c - b, a - b)
                                        : triple(c, a - c, b - c);
  return T(2) * atan2(volume, half_angle_cosine(a, b, c, la, lb, lc));
}

}  // namespace detail

/// Solid angle of the cone spanned by three vectors from its apex, positive when triple(a, b, c) > 0. The vectors are
/// differences to the apex and need not be of unit length; a direction at infinity is any vector along it.
/// \par Units  vectors in any one unit each, result [sr] in (-2 pi, 2 pi]
/// \par Domain  vectors that are not zero; two opposite vectors leave the cone undefined
/// \par Accuracy  1e-15 absolute, slivers of height 1e-10 included; relative for narrow cones of vectors that are exact
/// \par Source  Van Oosterom and Strackee 1983, IEEE Trans. Biomed. Eng. 30, 125, Eq. (8)
template <real T>
[[nodiscard]] T solid_angle(const vec3<T>& a, const vec3<T>& b, const vec3<T>& c) noexcept {
  return detail::solid_angle(a, b, c, norm(a), norm(b), norm(c));
}

}  // namespace tetrapore::inline TETRAPORE_ABI
