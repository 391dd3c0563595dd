// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/geometry/primitives.hpp"
#include "tetrapore/geometry/status.hpp"

#include <array>
#include <cstddef>

/// \file
/// Exact area of discs inside a convex polygon: the plane counterpart of ball_volume.hpp.

namespace tetrapore::inline TETRAPORE_ABI {

/// A disc in the plane of a section. \par Units  [m]
template <real T>
struct disc {
  vec2<T> centre;
  T radius{};
};

/// A convex polygon of up to eight corners, counter-clockwise; without allocation. \par Units  [m]
template <real T>
struct plane_polygon {
  static constexpr std::size_t max_corners = 8;

  std::array<vec2<T>, max_corners> corners;
  std::size_t count = 0;

  constexpr void add(const vec2<T>& p) noexcept {
    TETRAPORE_EXPECTS(count < max_corners, "a plane polygon has at most 8 corners");
    corners[count++] = p;
  }
  [[nodiscard]] constexpr const vec2<T>& after(std::size_t k) const noexcept {
    return corners[k + 1 == count ? 0 : k + 1];
  }

  /// Signed area [m²].
  [[nodiscard]] constexpr T area() const noexcept {
    T twice(0);
    for (std::size_t k = 1; k + 1 < count; ++k) {
      twice = twice + cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
    }
    return twice / T(2);
  }

  /// Keeps the side of the line through `point` to which `normal` points. At most one corner is added.
  constexpr void clip(const vec2<T>& point, const vec2<T>& normal) noexcept {
    const plane_polygon whole = *this;
    count = 0;
    for (std::size_t k = 0; k < whole.count; ++k) {
      const vec2<T>& p = whole.corners[k];
      const vec2<T>& q = whole.after(k);
      const T dp = dot(p - point, normal);
      const T dq = dot(q - point, normal);
      if (dp >= T(0)) {
        add(p);
      }
      if ((dp > T(0) && dq < T(0)) || (dp < T(0) && dq > T(0))) {
        add(p + (q - p) * (dp / (dp - dq)));
      }
    }
  }
};

/// Area of the part of a disc inside a convex polygon, in closed form: each edge closes a triangle with the centre,
/// which counts whole where its edge is inside the circle and as a sector where it is outside.
/// \par Units  [m] -> [m²]
/// \par Accuracy  a few epsilon of r²
template <real T>
[[nodiscard]] T disc_area(const disc<T>& d, const plane_polygon<T>& body) noexcept {
  using std::atan2;
  using std::sqrt;
  const T r = d.radius;
  T twice(0);
  for (std::size_t k = 0; k < body.count; ++k) {
    const vec2<T> from = body.corners[k] - d.centre;
    const vec2<T> edge = body.after(k) - body.corners[k];
    const T length = norm(edge);
    if (length == T(0)) {
      continue;
    }
    const T height = cross(from, edge) / length;
    const T begin = dot(from, edge) / length;
    const T end = begin + length;
    const auto sector = [&](const T& sa, const T& sb) noexcept {
      return r * r * atan2(height * (sb - sa), height * height + sa * sb);
    };
    const T w2 = (r - height) * (r + height);
    const T w = w2 > T(0) ? sqrt(w2) : T(0);
    if (!(w2 > T(0)) || begin >= w || end <= -w) {
      twice = twice + sector(begin, end);
      continue;
    }
    if (begin < -w) {
      twice = twice + sector(begin, -w);
    }
    if (end > w) {
      twice = twice + sector(w, end);
    }
    twice = twice + height * (detail::smaller(end, w) - detail::larger(begin, -w));
  }
  return twice / T(2);
}

}  // namespace tetrapore::inline TETRAPORE_ABI
