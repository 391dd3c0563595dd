// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/geometry/domain.hpp"
#include "tetrapore/geometry/polyhedron.hpp"
#include "tetrapore/geometry/solid_angle.hpp"

#include <array>
#include <cstddef>
#include <span>

/// \file
/// Exact volumes of balls: inside a polyhedron, inside the walls of a box, common to two balls, and of their union.

namespace tetrapore::inline TETRAPORE_ABI {

template <real T>
[[nodiscard]] constexpr T ball_volume(const T& radius) noexcept {
  return T(4) / T(3) * T(pi<T>) * (radius * radius * radius);
}

/// Volume of the part of a ball beyond a plane at the signed distance `height` from its centre.
/// \par Units  [m] -> [m³]
template <real T>
[[nodiscard]] constexpr T cap_volume(const T& radius, const T& height) noexcept {
  const T depth = radius - height;
  if (depth <= T(0)) {
    return T(0);
  }
  return height <= -radius ? ball_volume(radius) : T(pi<T>) / T(3) * depth * depth * (radius + radius + height);
}

/// Volume common to two balls whose centres are a distance apart.
/// \par Units  [m] -> [m³]
/// \par Accuracy  a few epsilon of the smaller ball; near contact relative, as the overlap is taken by one difference
template <real T>
[[nodiscard]] constexpr T lens_volume(const T& r1, const T& r2, const T& distance) noexcept {
  const T overlap = (r1 + r2) - distance;
  if (overlap <= T(0)) {
    return T(0);
  }
  if (distance <= detail::magnitude(r1 - r2)) {
    return ball_volume(detail::smaller(r1, r2));
  }
  const T difference = r1 - r2;
  return T(pi<T>) / T(12) * overlap * overlap *
         (distance + T(2) * (r1 + r2) - T(3) * difference * difference / distance);
}

namespace detail {

/// An edge of a face in the plane of the face, seen from the foot of the ball's centre.
template <real T>
struct edge_from_foot {
  T distance;                ///< of its line, positive when the edge runs counter-clockwise about the foot
  T begin, end;              ///< positions along the line, counted from the point nearest to the foot
  T begin_range, end_range;  ///< distances of its ends from the centre
};

/// Volume between the centre of a ball and one face, inside the ball, signed by the side of the face on which the
/// centre lies. With h the distance of the plane and a = sqrt(r² - h²) the radius of the disc that it cuts: inside the
/// disc lies a pyramid, outside a cone of the ball.
/// \param p     vertices, relative to the centre
/// \param l     their distances
/// \param edges directed edges of the face, in any order
template <real T>
[[nodiscard]] T cone_in_ball(const T& r, const workspace<vec3<T>, polyhedron<T>::max_vertices>& p,
                             const workspace<T, polyhedron<T>::max_vertices>& l, const vec3<T>& normal,
                             std::span<const typename polyhedron<T>::directed_edge> edges) noexcept {
  using std::atan2;
  using std::sqrt;
  bool all_inside = true;
  for (const auto& e : edges) {
    if (l[e.from] == T(0)) {
      return T(0);  // the face passes through the centre
    }
    all_inside = all_inside && l[e.from] <= r;
  }
  const std::size_t first = edges.front().from;
  const vec3<T>& base = p[first];
  const T signed_height = dot(base, normal);
  const T h = magnitude(signed_height);
  if (h == T(0)) {
    return T(0);
  }
  if (all_inside) {
    T six_volumes(0);
    for (const auto& e : edges) {
      six_volumes += dot(normal, cross(p[e.from] - base, p[e.to] - base));
    }
    return signed_height * six_volumes / T(6);
  }
  const T r3 = r * r * r / T(3);
  const auto whole_cone = [&]() noexcept {
    T omega(0);
    for (const auto& e : edges) {
      if (e.from != first && e.to != first) {
        omega += solid_angle(base, p[e.from], p[e.to], l[first], l[e.from], l[e.to]);
      }
    }
    return r3 * omega;
  };
  if (h >= r) {
    return whole_cone();
  }

  const T a2 = (r - h) * (r + h);
  const T a = sqrt(a2);
  const T h2 = h * h;
  workspace<edge_from_foot<T>, polyhedron<T>::max_edges> side;
  std::size_t count = 0;
  bool meets_disc = false;
  bool around = true;  // the disc lies within the face
  const T turn_sense(signed_height < T(0) ? -1 : 1);
  for (const auto& e : edges) {
    const vec3<T>& from = p[e.from];
    const vec3<T> edge = p[e.to] - from;
    const T length = norm(edge);
    if (length == T(0)) {
      continue;
    }
    const T d = dot(normal, cross(from, edge)) / length;
    const T begin = dot(from, edge) / length;
    const T end = begin + length;
    side[count++] = {d, begin, end, l[e.from], l[e.to]};
    around = around && d >= a;
    const T w2 = a2 - d * d;
    meets_disc = meets_disc || l[e.from] < r || l[e.to] < r || (w2 > T(0) && begin < T(0) && end > T(0));
  }
  if (count == 0) {
    return T(0);
  }
  const bool distant = h + h > r;
  if (!meets_disc && !around) {
    return whole_cone();
  }
  if (!meets_disc && distant) {
    return whole_cone() - turn_sense * ((r - h) * (r - h) * (r + r + h) * T(pi<T>) / T(3));
  }

  // Each edge closes a triangle with the foot. On the part of its line inside the disc the triangle carries a
  // pyramid; on the parts outside a cone r³/3 (h/r Δφ - Δψ) and a pyramid h a²/6 Δφ, with φ the angle at the foot and
  // tan ψ = h s / (d R), s along the line and R the distance from the centre. For a distant plane the difference is
  // taken analytically instead: the whole solid angle of the triangle, less its share of the cap.
  const T per_angle = distant ? -(r - h) * (r - h) * (r + r + h) / T(6) : h * (T(3) * r * r - h2) / T(6);
  T volume(0);
  for (std::size_t k = 0; k < count; ++k) {
    const auto& [d, begin, end, begin_range, end_range] = side[k];
    const T d2 = d * d;
    const auto outer = [&, &d = d](const T& sa, const T& sb, const T& ra, const T& rb) noexcept {
      const T turn = atan2(d * (sb - sa), d2 + sa * sb);
      if (distant) {
        const T omega = T(2) * atan2(d * (sb - sa), ra * rb + h * (ra + rb) + h2 + d2 + sa * sb);
        volume += r3 * omega + per_angle * turn;
      } else {
        const T run = sa * sb > T(0) ? (h2 + d2) * (sb - sa) * (sb + sa) / (ra * sb + rb * sa) : ra * sb - rb * sa;
        const T psi = atan2(h * d * run, d2 * ra * rb + h2 * sa * sb);
        volume += per_angle * turn - r3 * psi;
      }
    };
    const T w2 = a2 - d2;
    const T w = w2 > T(0) ? sqrt(w2) : T(0);
    if (!(w2 > T(0)) || begin >= w || end <= -w) {
      outer(begin, end, begin_range, end_range);
      continue;
    }
    if (begin < -w) {
      outer(begin, -w, begin_range, r);
    }
    if (end > w) {
      outer(w, end, r, end_range);
    }
    volume += h * d * (smaller(end, w) - larger(begin, -w)) / T(6);
  }
  return turn_sense * volume;
}

}  // namespace detail

/// Volume of the part of a ball inside a polyhedron, in closed form: the sum over the faces of signed cones from the
/// centre of the ball.
/// \par Units  [m] -> [m³]
/// \par Domain  any position of the centre: inside, outside, on a face, an edge or a vertex; any convex polyhedron,
/// flat ones included; an inverted one has negative volumes
/// \par Accuracy  1e-14 of (r + L)² L, with r the radius and L the size of the polyhedron (measured: 2e-16 at r = L,
/// 8e-15 of r² L at r from L to 1000 L)
/// \par Source  divergence theorem; the arc integral is asin(h sin φ / sqrt(h² + d²)), written as an atan2
template <real T>
[[nodiscard]] T ball_volume(const sphere<T>& ball, const polyhedron<T>& body) noexcept {
  detail::workspace<vec3<T>, polyhedron<T>::max_vertices> p;
  detail::workspace<T, polyhedron<T>::max_vertices> l;
  const auto vertices = body.vertices();
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    p[k] = vertices[k] - ball.centre;
    l[k] = norm(p[k]);
  }
  T volume(0);
  for (std::size_t f = 0; f < body.face_count(); ++f) {
    volume += detail::cone_in_ball<T>(ball.radius, p, l, body.normal(f), body.edges(f));
  }
  return volume;
}

namespace detail {

template <real T>
[[nodiscard]] bool is_finite(const sphere<T>& s) noexcept {
  const T probe = s.centre.x + s.centre.y + s.centre.z + s.radius;
  return probe - probe == T(0);
}

/// How ball i meets ball j, for the share of i in their union.
enum class overlap : std::uint8_t {
  none,   ///< apart, or overlapping by less than rounding can tell
  cut,    ///< the radical plane separates the shares
  hidden  ///< concentric with a larger (or, at equal radii, an earlier) ball: no share at all
};

/// The depth below which the lens of two balls is less than a rounding unit of the smaller.
template <real T>
inline constexpr underlying_t<T> negligible_overlap = [] {
  underlying_t<T> x = 1;  // sqrt(epsilon) / 4, a power of two
  while (x * x * 16 > epsilon<T>) {
    x /= 2;
  }
  return x;
}();

template <real T>
[[nodiscard]] constexpr bool overlaps(const T& distance2, const T& ra, const T& rb) noexcept {
  const T sum = ra + rb;
  return sum * sum - distance2 > sum * smaller(ra, rb) * (T(2) * T(negligible_overlap<T>));
}

template <real T>
[[nodiscard]] constexpr overlap overlap_of(const sphere<T>& a, const sphere<T>& b, bool a_first) noexcept {
  const T distance2 = norm2(b.centre - a.centre);
  if (!overlaps(distance2, a.radius, b.radius)) {
    return overlap::none;
  }
  if (distance2 > T(0)) {
    return overlap::cut;
  }
  return b.radius > a.radius || (!(a.radius > b.radius) && !a_first) ? overlap::hidden : overlap::none;
}

/// The radical plane of two balls that are not concentric, normal towards the first.
template <real T>
[[nodiscard]] plane<T> radical_plane(const sphere<T>& a, const sphere<T>& b) noexcept {
  const vec3<T> d = b.centre - a.centre;
  const T distance = norm(d);
  const vec3<T> n = d / distance;
  const T t = (distance + (a.radius - b.radius) * ((a.radius + b.radius) / distance)) * T(0.5);
  return {a.centre + n * t, -n};
}

/// Whether a face of a convex polyhedron separates it from the ball.
template <real T>
[[nodiscard]] bool apart(const sphere<T>& ball, const polyhedron<T>& body) noexcept {
  for (std::size_t f = 0; f < body.face_count(); ++f) {
    if (body.inner_side(f).distance(ball.centre) <= -ball.radius) {
      return true;
    }
  }
  return false;
}

/// The part of ball i inside the body that no other ball has a better claim to.
template <real T, class BallAt>
[[nodiscard]] outcome<T, geometry_status> share_of(const polyhedron<T>& body, std::size_t n, const BallAt& ball,
                                                   std::size_t i) noexcept {
  const sphere<T> mine = ball(i);
  if (!is_finite(mine)) {
    return refuse<T>(geometry_status::not_finite);
  }
  if (body.empty() || apart(mine, body)) {
    return {T(0), geometry_status::ok};
  }
  polyhedron<T> part;
  bool is_cut = false;
  for (std::size_t j = 0; j < n; ++j) {
    if (j == i) {
      continue;
    }
    const sphere<T> other = ball(j);
    const overlap how = overlap_of(mine, other, i < j);
    if (how == overlap::hidden) {
      return {T(0), geometry_status::ok};
    }
    if (how == overlap::cut) {
      if (!is_cut) {
        part = body;
        is_cut = true;
      }
      const geometry_status fit = part.clip(radical_plane(mine, other));
      if (fit != geometry_status::ok) {
        return refuse<T>(fit);
      }
      if (part.empty()) {
        return {T(0), geometry_status::ok};
      }
    }
  }
  return checked(ball_volume(mine, is_cut ? part : body));
}

/// \param ball  ball(i) -> sphere<T>, i < n
template <real T, class BallAt>
[[nodiscard]] outcome<T, geometry_status> union_volume(const polyhedron<T>& body, std::size_t n,
                                                       const BallAt& ball) noexcept {
  T sum(0);
  for (std::size_t i = 0; i < n; ++i) {
    const auto share = share_of(body, n, ball, i);
    if (!share.ok()) {
      return share;
    }
    sum += share.value;
  }
  return {sum, geometry_status::ok};
}

}  // namespace detail

/// Volume of the union of balls inside a convex polyhedron: each ball counts inside its own power cell.
/// \par Units  [m] -> [m³]
/// \par Domain  any balls, also equal or engulfed ones; up to about 26 balls may cut the share of one ball, else the
/// status is too_complex
/// \par Accuracy  that of ball_volume
template <real T>
[[nodiscard]] outcome<T, geometry_status> union_volume(const polyhedron<T>& body,
                                                       std::span<const sphere<T>> balls) noexcept {
  return detail::union_volume(body, balls.size(), [balls](std::size_t k) noexcept { return balls[k]; });
}

/// Volume of the part of a ball beyond the walls of a box; open and periodic faces end nothing.
/// \par Units  [m] -> [m³]
/// \par Domain  a centre inside the walls or outside them; NaN in, NaN out
/// \par Accuracy  relative 1e-15 at one wall, absolute 1e-15 of the ball at an edge or a corner
template <real T>
[[nodiscard]] T protruding_volume(const sphere<T>& ball, const domain& region) noexcept {
  std::array<plane<T>, 6> cutting;
  std::size_t count = 0;
  for (const face f : all_faces) {
    if (region.is_wall(f)) {
      const plane<double> w = region.wall(f);
      const plane<T> wall{{T(w.point.x), T(w.point.y), T(w.point.z)}, {T(w.normal.x), T(w.normal.y), T(w.normal.z)}};
      const T height = wall.distance(ball.centre);
      if (!(height >= ball.radius)) {
        cutting[count++] = {wall.normal * -height, wall.normal};  // in the frame of the centre
      }
    }
  }
  if (count == 0) {
    return T(0);
  }
  if (count == 1) {
    return cap_volume(ball.radius, -dot(cutting[0].point, cutting[0].normal));
  }
  const T reach = T(2) * ball.radius;
  polyhedron<T> inside = box_polyhedron(vec3<T>{-reach, -reach, -reach}, vec3<T>{reach, reach, reach});
  for (std::size_t k = 0; k < count; ++k) {
    if (inside.clip(cutting[k]) != geometry_status::ok) {  // a box cut by six planes fits, so only a NaN comes here
      return T(quiet_nan<T>);
    }
  }
  return ball_volume(ball.radius) - ball_volume(sphere<T>{{}, ball.radius}, inside);
}

}  // namespace tetrapore::inline TETRAPORE_ABI
