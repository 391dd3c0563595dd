// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/geometry/primitives.hpp"
#include "tetrapore/geometry/status.hpp"

#include <array>
#include <cstddef>
#include <span>

/// \file
/// Area vectors and elementary volumes, from differences of coordinates.

namespace tetrapore::inline TETRAPORE_ABI {

/// Area vector of the triangle a, b, c: its normal by the right-hand rule times its area.
/// \par Units  [m] -> [m²]
template <real T>
[[nodiscard]] constexpr vec3<T> triangle_area(const vec3<T>& a, const vec3<T>& b, const vec3<T>& c) noexcept {
  return cross(b - a, c - a) * T(0.5);
}

/// Area vector of the plane quadrangle a, b, c, d: half the product of its diagonals.
/// \par Units  [m] -> [m²]
template <real T>
[[nodiscard]] constexpr vec3<T> quadrangle_area(const vec3<T>& a, const vec3<T>& b, const vec3<T>& c,
                                                const vec3<T>& d) noexcept {
  return cross(c - a, d - b) * T(0.5);
}

/// Area vector of the trapezoid between two points and their feet on a wall, ordered a, b, foot of b, foot of a.
/// \par Units  [m] -> [m²]
template <real T>
[[nodiscard]] constexpr vec3<T> trapezoid_area(const vec3<T>& a, const vec3<T>& b, const plane<T>& wall) noexcept {
  return cross(wall.normal, b - a) * ((wall.distance(a) + wall.distance(b)) * T(0.5));
}

/// Area vector of the rectangle between a point, its feet on two perpendicular walls and the edge of the walls, ordered
/// a, foot on the first wall, edge, foot on the second wall.
/// \par Units  [m] -> [m²]
template <real T>
[[nodiscard]] constexpr vec3<T> rectangle_area(const vec3<T>& a, const plane<T>& first,
                                               const plane<T>& second) noexcept {
  return cross(first.normal, second.normal) * (first.distance(a) * second.distance(a));
}

/// Signed volume of the tetrahedron spanned by three differences to one vertex.
/// \par Units  [m] -> [m³]
template <real T>
[[nodiscard]] constexpr T tetrahedron_volume(const vec3<T>& a, const vec3<T>& b, const vec3<T>& c) noexcept {
  return triple(a, b, c) / T(6);
}

/// A plane convex polygon of three or four corners, such as a facet. \par Units  [m]
template <real T>
struct small_polygon {
  std::array<vec3<T>, 4> corners;
  std::size_t count = 0;

  [[nodiscard]] constexpr std::span<const vec3<T>> points() const noexcept { return {corners.data(), count}; }
  [[nodiscard]] constexpr vec3<T> area() const noexcept {
    return count == 4 ? quadrangle_area(corners[0], corners[1], corners[2], corners[3])
                      : triangle_area(corners[0], corners[1], corners[2]);
  }
};

namespace detail {

/// Squared sine of the angle below which a normal made from two edges has lost too many digits to place a plane.
inline constexpr double needle2 = 0x1p-40;

}  // namespace detail

/// Whether the ball reaches the plane convex polygon: whether their distance is below the radius. A polygon without
/// area is its outline.
/// \par Units  [m]
template <real T>
[[nodiscard]] bool reaches(const sphere<T>& ball, const small_polygon<T>& facet) noexcept {
  const T r2 = ball.radius * ball.radius;
  std::array<vec3<T>, 4> p;
  for (std::size_t k = 0; k < facet.count; ++k) {
    p[k] = facet.corners[k] - ball.centre;
  }
  const vec3<T> across = facet.count == 4 ? p[2] - p[0] : p[1] - p[0];
  const vec3<T> along_other = facet.count == 4 ? p[3] - p[1] : p[2] - p[0];
  const vec3<T> area = cross(across, along_other);
  const T height = dot(area, p[0]);
  const T size2 = norm2(area);
  const bool in_plane = height * height < r2 * size2;
  // the normal of a needle is rounding, and only its outline counts
  if (!in_plane && size2 > norm2(across) * norm2(along_other) * T(static_cast<underlying_t<T>>(detail::needle2))) {
    return false;
  }
  bool foot_inside = in_plane;
  for (std::size_t k = 0; k < facet.count; ++k) {
    const vec3<T>& a = p[k];
    const vec3<T>& b = p[k + 1 == facet.count ? 0 : k + 1];
    const vec3<T> edge = b - a;
    const T along = -dot(a, edge);
    const T length2 = norm2(edge);
    const T distance2 = along <= T(0) ? norm2(a) : along >= length2 ? norm2(b) : norm2(cross(a, edge)) / length2;
    if (distance2 < r2) {
      return true;
    }
    foot_inside = foot_inside && dot(area, cross(a, edge)) > T(0);
  }
  return foot_inside;
}

namespace detail {

/// A unit vector at a right angle to a vector that is not zero.
template <real T>
[[nodiscard]] vec3<T> any_perpendicular(const vec3<T>& a) noexcept {
  const T x = magnitude(a.x);
  const T y = magnitude(a.y);
  const T z = magnitude(a.z);
  const vec3<T> axis = x <= y && x <= z ? vec3<T>{T(1), T(0), T(0)}
                       : y <= z         ? vec3<T>{T(0), T(1), T(0)}
                                        : vec3<T>{T(0), T(0), T(1)};
  const vec3<T> side = cross(a, axis);
  return side / norm(side);
}

/// Unit vector along `direction`, made exactly normal to the unit-free vector `along`: for a needle, whose own normal
/// has no digits along its length. A direction without length gives any normal of `along`.
template <real T>
[[nodiscard]] vec3<T> normal_across(const vec3<T>& direction, const vec3<T>& along) noexcept {
  const T l2 = norm2(along);
  if (!(l2 > T(0))) {
    const T d = norm(direction);
    return d > T(0) ? direction / d : vec3<T>{T(0), T(0), T(1)};
  }
  vec3<T> n = direction;
  for (int pass = 0; pass < 2; ++pass) {
    const T d = norm(n);
    if (!(d > T(0))) {
      return any_perpendicular(along);
    }
    n = n / d;
    n -= along * (dot(n, along) / l2);
  }
  const T d = norm(n);
  return d > T(0) ? n / d : any_perpendicular(along);
}

}  // namespace detail
}  // namespace tetrapore::inline TETRAPORE_ABI
