// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/geometry/primitives.hpp"
#include "tetrapore/geometry/status.hpp"

/// \file
/// Power centres: the points of equal power to spheres, on given planes.

namespace tetrapore::inline TETRAPORE_ABI {

/// Power of a point: squared distance to the centre less the squared radius. \par Units  [m²]
template <real T>
[[nodiscard]] constexpr T power(const vec3<T>& p, const sphere<T>& s) noexcept {
  return norm2(p - s.centre) - s.radius * s.radius;
}

namespace detail {

/// One condition on a point x near the centre of a sphere: row · x = value.
template <real T>
struct linear_condition {
  vec3<T> row;
  T value;
};

/// Equal power to both spheres, with x counted from the centre of the first.
template <real T>
[[nodiscard]] constexpr linear_condition<T> radical(const sphere<T>& origin, const sphere<T>& s) noexcept {
  const vec3<T> d = s.centre - origin.centre;
  return {d, (norm2(d) - (s.radius - origin.radius) * (s.radius + origin.radius)) * T(0.5)};
}

template <real T>
[[nodiscard]] constexpr linear_condition<T> on_plane(const sphere<T>& origin, const plane<T>& w) noexcept {
  return {w.normal, -w.distance(origin.centre)};
}

template <real T>
[[nodiscard]] outcome<vec3<T>, geometry_status> meet(const sphere<T>& origin, const linear_condition<T>& a,
                                                     const linear_condition<T>& b,
                                                     const linear_condition<T>& c) noexcept {
  const vec3<T> bc = cross(b.row, c.row);
  const vec3<T> ca = cross(c.row, a.row);
  const vec3<T> ab = cross(a.row, b.row);
  const T determinant = dot(a.row, bc);
  // the rounding of the nine products that make the determinant
  const T noise2 = norm2(a.row) * norm2(b.row) * norm2(c.row) * (T(16) * epsilon<T> * epsilon<T>);
  if (determinant * determinant > noise2) {
    const vec3<T> x = origin.centre + (bc * a.value + ca * b.value + ab * c.value) / determinant;
    const T probe = (x.x + x.y) + x.z;
    if (probe - probe == T(0)) {
      return {x, geometry_status::ok};
    }
  }
  const T nan(quiet_nan<T>);
  const T size = determinant + noise2;
  return {
      {nan, nan, nan},
      size - size == T(0) && determinant * determinant <= noise2 ? geometry_status::flat : geometry_status::not_finite};
}

}  // namespace detail

/// The point of equal power to four spheres.
/// \par Units  [m]
/// \par Domain  centres that are not coplanar to rounding, else the status is flat
/// \par Accuracy  a few epsilon times the product of the edges at the first centre over the determinant
template <real T>
[[nodiscard]] outcome<vec3<T>, geometry_status> power_centre(const sphere<T>& a, const sphere<T>& b, const sphere<T>& c,
                                                             const sphere<T>& d) noexcept {
  return detail::meet(a, detail::radical(a, b), detail::radical(a, c), detail::radical(a, d));
}

/// The point of a plane of equal power to three spheres. \par Units  [m]
template <real T>
[[nodiscard]] outcome<vec3<T>, geometry_status> power_centre(const sphere<T>& a, const sphere<T>& b, const sphere<T>& c,
                                                             const plane<T>& w) noexcept {
  return detail::meet(a, detail::radical(a, b), detail::radical(a, c), detail::on_plane(a, w));
}

/// The point of the edge of two planes of equal power to two spheres. \par Units  [m]
template <real T>
[[nodiscard]] outcome<vec3<T>, geometry_status> power_centre(const sphere<T>& a, const sphere<T>& b, const plane<T>& v,
                                                             const plane<T>& w) noexcept {
  return detail::meet(a, detail::radical(a, b), detail::on_plane(a, v), detail::on_plane(a, w));
}

/// The corner of three planes, counted from the centre of the sphere near it. \par Units  [m]
template <real T>
[[nodiscard]] outcome<vec3<T>, geometry_status> power_centre(const sphere<T>& a, const plane<T>& u, const plane<T>& v,
                                                             const plane<T>& w) noexcept {
  return detail::meet(a, detail::on_plane(a, u), detail::on_plane(a, v), detail::on_plane(a, w));
}

}  // namespace tetrapore::inline TETRAPORE_ABI
