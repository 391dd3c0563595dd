// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/geometry/disc_area.hpp"
#include "tetrapore/simplex/throat.hpp"

#include <array>
#include <cstddef>

/// \file
/// Areas of a throat.

namespace tetrapore::inline TETRAPORE_ABI {

/// Area of the facet.
/// \par Units  [m²]
template <real T>
[[nodiscard]] T facet_area(const throat<T>& t) noexcept {
  return norm(t.area_vector);
}

namespace detail {

/// The facet in its own plane, with the first centre as origin; the discs of the grains are centred on the first
/// `grain_count` corners, except that the feet on a wall follow them.
template <real T>
[[nodiscard]] plane_polygon<T> facet_in_plane(const throat<T>& t) noexcept {
  plane_polygon<T> p;
  p.add({T(0), T(0)});
  if (t.grain_count == 3) {
    const vec3<T> a = t.grains[1].centre - t.grains[0].centre;
    const vec3<T> b = t.grains[2].centre - t.grains[0].centre;
    const T length = norm(a);
    const T over = length > T(0) ? T(1) / length : T(0);
    p.add({length, T(0)});
    p.add({dot(a, b) * over, norm(cross(a, b)) * over});
  } else if (t.grain_count == 2) {
    const vec3<T> along = t.grains[1].centre - t.grains[0].centre;
    const plane<T>& wall = t.walls[0];
    const T h0 = wall.distance(t.grains[0].centre);
    const T h1 = wall.distance(t.grains[1].centre);
    const T width = norm(cross(along, wall.normal));
    p.add({T(0), -h0});
    p.add({width, -h0});
    p.add({width, h1 - h0});
  } else {
    const T a = t.walls[0].distance(t.grains[0].centre);
    const T b = t.walls[1].distance(t.grains[0].centre);
    p.add({a, T(0)});
    p.add({a, b});
    p.add({T(0), b});
  }
  return p;
}

/// What lies in the facet: its own area, and that of the disc of each grain.
template <real T>
struct facet_areas {
  T whole;                ///< [m²]
  std::array<T, 3> disc;  ///< [m²] inside the facet; what discs share is split along their radical line

  [[nodiscard]] constexpr T fluid() const noexcept { return whole - (disc[0] + disc[1] + disc[2]); }
};

/// The areas where a disc is its sector less half a segment at each neighbour that it overlaps: three discs of which
/// none reaches the opposite edge or what two others share. Returns false where it is not so.
template <real T>
[[nodiscard]] bool sectors_in_facet(const throat<T>& t, facet_areas<T>& out) noexcept {
  using std::atan2;
  using std::sqrt;
  const std::array<vec3<T>, 3> edge{t.grains[2].centre - t.grains[1].centre, t.grains[0].centre - t.grains[2].centre,
                                    t.grains[1].centre - t.grains[0].centre};  // opposite to each grain
  const T twice2 = norm2(cross(edge[1], edge[2]));
  const T twice = sqrt(twice2);
  out.whole = twice * T(0.5);
  std::array<T, 3> angle;
  for (std::size_t k = 0; k < 3; ++k) {
    const T r2 = t.grains[k].radius * t.grains[k].radius;
    if (!(r2 * norm2(edge[k]) <= twice2)) {
      return false;
    }
    angle[k] = atan2(twice, -dot(edge[(k + 1) % 3], edge[(k + 2) % 3]));
    out.disc[k] = r2 * angle[k] * T(0.5);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3;
    const std::size_t j = (k + 2) % 3;
    const T length2 = norm2(edge[k]);
    const T sum = t.grains[i].radius + t.grains[j].radius;
    if (!(sum * sum > length2)) {
      continue;
    }
    const T length = sqrt(length2);
    for (const std::size_t v : {i, j}) {
      const T r = t.grains[v].radius;
      const T to = (length2 + (r - t.grains[i + j - v].radius) * sum) / (length + length);  // the radical line
      const T half2 = (r - to) * (r + to);
      if (!(to > T(0)) || !(half2 >= T(0))) {
        return false;
      }
      const T half = sqrt(half2);
      const T cap = atan2(half, to);
      angle[v] = angle[v] - cap;
      if (!(angle[v] >= T(0))) {
        return false;
      }
      out.disc[v] = out.disc[v] - (r * r * cap - to * half) * T(0.5);
    }
  }
  return true;
}

/// The same for any throat: discs clipped along their radical lines and by the facet.
template <real T>
[[nodiscard]] facet_areas<T> clipped_in_facet(const throat<T>& t) noexcept {
  const plane_polygon<T> whole = facet_in_plane(t);
  std::array<disc<T>, 3> discs{};
  for (std::size_t k = 0; k < t.grain_count; ++k) {
    // of a trapezoid the second centre is the last corner
    discs[k] = {whole.corners[t.grain_count == 2 && k == 1 ? 3 : k], t.grains[k].radius};
  }
  facet_areas<T> out{whole.area(), {T(0), T(0), T(0)}};
  for (std::size_t i = 0; i < t.grain_count; ++i) {
    plane_polygon<T> part = whole;
    for (std::size_t j = 0; j < t.grain_count; ++j) {
      if (j == i) {
        continue;
      }
      const vec2<T> d = discs[j].centre - discs[i].centre;
      const T q = dot(d, d);
      const T sum = discs[i].radius + discs[j].radius;
      if (!(q < sum * sum)) {
        continue;
      }
      if (q > T(0)) {
        const T share =
            (T(1) + (discs[i].radius - discs[j].radius) * (sum / q)) * T(0.5);  // of the radical line, along d
        part.clip(discs[i].centre + d * share, -d);
      } else if (discs[j].radius > discs[i].radius || (!(discs[i].radius > discs[j].radius) && j < i)) {
        part.count = 0;
      }
    }
    out.disc[i] = disc_area(discs[i], part);
  }
  return out;
}

template <real T>
[[nodiscard]] facet_areas<T> areas_in_facet(const throat<T>& t) noexcept {
  facet_areas<T> out{};
  return t.grain_count == 3 && sectors_in_facet(t, out) ? out : clipped_in_facet(t);
}

}  // namespace detail

/// Area of the facet outside the discs of its grains: the sectors at the corners, without the segments that stick out
/// of the opposite edge or beyond a wall, and with what discs share counted once.
/// \par Units  [m²]
/// \par Domain  any throat; flat ones have no area
/// \par Accuracy  a few epsilon of the square of the largest radius or edge
/// \par Source  Chareyre et al. 2017, §2.2, with the segments on all three sides
template <real T>
[[nodiscard]] outcome<T, geometry_status> fluid_area(const throat<T>& t) noexcept {
  TETRAPORE_EXPECTS(t.grain_count >= 1 && t.grain_count <= 3, "a throat has one to three grains");
  return detail::checked(detail::areas_in_facet(t).fluid());
}

}  // namespace tetrapore::inline TETRAPORE_ABI
