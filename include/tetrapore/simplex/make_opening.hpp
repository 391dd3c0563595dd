// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/outcome.hpp"
#include "tetrapore/simplex/opening.hpp"
#include "tetrapore/simplex/throat.hpp"

#include <array>
#include <cstddef>

/// \file
/// Openings from radii and distances, from a throat, from regular shapes, and from two openings that share a gap.

namespace tetrapore::inline TETRAPORE_ABI {

/// Why an opening could not be made. A refused opening has no sides.
enum class opening_status : unsigned char {
  ok,
  not_a_triangle,  ///< refused: one distance is longer than the sum of the two others
  too_many_sides,  ///< refused: more than 8 sides
  not_shared,      ///< refused: the two gaps do not lie between the same two sides
  invalid_input    ///< refused: a number is NaN, infinite or not positive, fewer than three sides, no such gap
};

[[nodiscard]] constexpr verdict verdict_of(opening_status s) noexcept {
  return s == opening_status::ok ? verdict::ok : verdict::refused;
}

[[nodiscard]] constexpr const char* describe(opening_status s) noexcept {
  switch (s) {
    case opening_status::ok: return "ok";
    case opening_status::not_a_triangle: return "one distance is longer than the sum of the two others";
    case opening_status::too_many_sides: return "the ring has more than 8 sides";
    case opening_status::not_shared: return "the two gaps do not lie between the same two sides";
    case opening_status::invalid_input: return "a number is not finite or not positive, or there is no such gap";
  }
  return "not an opening status";
}

namespace detail {

/// Moves the origin of the frame to the centre of the smallest disc.
template <real T>
constexpr void reframe(opening<T>& o) noexcept {
  std::size_t smallest = o.count;
  for (std::size_t i = 0; i < o.count; ++i) {
    if (o.sides[i].kind == side_kind::disc && (smallest == o.count || o.sides[i].radius < o.sides[smallest].radius)) {
      smallest = i;
    }
  }
  if (smallest != o.count) {
    const vec2<T> origin = o.sides[smallest].point;
    for (std::size_t i = 0; i < o.count; ++i) {
      o.sides[i].point = o.sides[i].point - origin;
    }
  }
}

/// Three discs with the smallest at the origin; (x, y) is the third centre, the second lies on the x-axis.
template <real T>
[[nodiscard]] constexpr opening<T> three_discs(const std::array<T, 3>& radius, const T& along,
                                               const vec2<T>& third) noexcept {
  opening<T> o;
  o.add_disc({T(0), T(0)}, radius[0]);
  o.add_disc({along, T(0)}, radius[1]);
  o.add_disc(third, radius[2]);
  return o;
}

template <real T>
[[nodiscard]] bool positive_and_finite(const T& x) noexcept {
  return std::isfinite(value_of(x)) && value_of(x) > 0;
}

}  // namespace detail

/// Three discs of given radii and distances of their centres.
/// \par Units  [m]
/// \par Domain  the distances form a triangle; one that misses by round-off (8 ε of the perimeter) is collinear
/// \par Accuracy  the third centre is found from factored differences (Heron's formula as Kahan writes it), in the
///                frame of the smallest disc: nothing is lost beyond the rounding of the distances
/// \par Source  W. Kahan, Miscalculating area and angles of a needle-like triangle (2014)
template <real T>
[[nodiscard]] outcome<opening<T>, opening_status> opening_from_distances(const T& R1, const T& R2, const T& R3,
                                                                         const T& d12, const T& d13,
                                                                         const T& d23) noexcept {
  using std::sqrt;
  for (const T* x : {&R1, &R2, &R3, &d12, &d13, &d23}) {
    if (!detail::positive_and_finite(*x)) {
      return {{}, opening_status::invalid_input};
    }
  }
  // Rotate the names so that the smallest disc comes first: radii r0 r1 r2, distances d01 d02 d12.
  std::array<T, 3> r{R1, R2, R3};
  T d01 = d12;
  T d02 = d13;
  T opposite = d23;
  if (r[1] < r[0] && !(r[2] < r[1])) {
    r = {R2, R3, R1};
    d01 = d23, d02 = d12, opposite = d13;
  } else if (r[2] < r[0]) {
    r = {R3, R1, R2};
    d01 = d13, d02 = d23, opposite = d12;
  }
  T a = d01;
  T b = d02;
  T c = opposite;
  const auto order = [](T& big, T& small) {
    if (big < small) {
      const T t = big;
      big = small;
      small = t;
    }
  };
  order(a, b);
  order(b, c);
  order(a, b);
  T excess = c - (a - b);
  if (!(value_of(excess) >= 0)) {
    if (value_of(excess) < -8 * epsilon<T> * value_of(a + b + c)) {
      return {{}, opening_status::not_a_triangle};
    }
    excess = T(0);
  }
  const T product = (a + (b + c)) * excess * (c + (a - b)) * (a + (b - c));
  const T twice_area = value_of(product) > 0 ? sqrt(product) / T(2) : T(0);
  const T x = ((d02 - opposite) * (d02 + opposite) + d01 * d01) / (T(2) * d01);
  return {detail::three_discs<T>(r, d01, {x, twice_area / d01}), opening_status::ok};
}

/// The section of a throat by the plane through the centres of its grains: three discs; two discs and the wall line
/// under them; one disc and the two wall lines.
/// \par Units  [m]
/// \par Domain  walls perpendicular to each other; what is not finite or not positive is left for the law to refuse
/// \par Accuracy  differences come before products: coordinates far from the origin lose only what the input lost
template <real T>
[[nodiscard]] opening<T> opening_of(const throat<T>& t) noexcept {
  using std::sqrt;
  opening<T> o;
  if (t.grain_count == 3) {
    std::size_t s = t.grains[1].radius < t.grains[0].radius ? 1 : 0;
    s = t.grains[2].radius < t.grains[s].radius ? 2 : s;
    const auto& g0 = t.grains[s];
    const auto& g1 = t.grains[(s + 1) % 3];
    const auto& g2 = t.grains[(s + 2) % 3];
    const vec3<T> u = g1.centre - g0.centre;
    const vec3<T> w = g2.centre - g0.centre;
    const T length = norm(u);
    return detail::three_discs<T>({g0.radius, g1.radius, g2.radius}, length,
                                  {dot(u, w) / length, norm(cross(u, w)) / length});
  }
  if (t.grain_count == 2) {
    // The wall below, its normal upwards, the two discs above it from right to left: counter-clockwise.
    const auto& wall = t.walls[0];
    const std::size_t s = t.grains[1].radius < t.grains[0].radius ? 1 : 0;
    const auto& near = t.grains[s];
    const auto& far = t.grains[1 - s];
    const vec3<T> u = far.centre - near.centre;
    const T rise = dot(u, wall.normal);
    const T along = norm(u - wall.normal * rise);
    o.add_disc({T(0), T(0)}, near.radius);
    o.add_disc({-along, rise}, far.radius);
    o.add_line({T(0), -wall.distance(near.centre)}, {T(0), T(1)});
    return o;
  }
  const auto& grain = t.grains[0];
  o.add_disc({T(0), T(0)}, grain.radius);
  o.add_line({-t.walls[0].distance(grain.centre), T(0)}, {T(1), T(0)});
  o.add_line({T(0), -t.walls[1].distance(grain.centre)}, {T(0), T(1)});
  return o;
}

/// Three spheres, cut by the plane of their centres.
template <real T>
[[nodiscard]] opening<T> opening_from_spheres(const sphere<T>& a, const sphere<T>& b, const sphere<T>& c) noexcept {
  throat<T> t{};
  t.grains = {a, b, c};
  t.grain_count = 3;
  return opening_of(t);
}

/// A regular polygon of wall lines around the origin. \par Units  [m]
/// \par Domain  3 to 8 sides
template <real T>
[[nodiscard]] outcome<opening<T>, opening_status> regular_polygon(std::size_t sides, const T& inradius) noexcept {
  using std::cos;
  using std::sin;
  if (sides < 3 || !detail::positive_and_finite(inradius)) {
    return {{}, opening_status::invalid_input};
  }
  if (sides > opening<T>::max_sides) {
    return {{}, opening_status::too_many_sides};
  }
  opening<T> o;
  for (std::size_t k = 0; k < sides; ++k) {
    const T angle = T(2 * pi<T>) * T(static_cast<underlying_t<T>>(k)) / T(static_cast<underlying_t<T>>(sides));
    const vec2<T> n{-cos(angle), -sin(angle)};
    o.add_line(n * (-inradius), n);
  }
  return {o, opening_status::ok};
}

/// Equal discs whose centres form a regular polygon, neighbours a given gap apart. \par Units  [m]
/// \par Domain  3 to 8 discs; a negative gap is an overlap
template <real T>
[[nodiscard]] outcome<opening<T>, opening_status> ring_of_discs(std::size_t discs, const T& radius, const T& gap,
                                                                gap_state state = gap_state::liquid) noexcept {
  using std::cos;
  using std::sin;
  if (discs < 3 || !detail::positive_and_finite(radius) || !detail::positive_and_finite(T(2) * radius + gap)) {
    return {{}, opening_status::invalid_input};
  }
  if (discs > opening<T>::max_sides) {
    return {{}, opening_status::too_many_sides};
  }
  const T turn = T(2 * pi<T>) / T(static_cast<underlying_t<T>>(discs));
  const T side = T(2) * radius + gap;
  // The corners of the polygon, walked side by side from the origin.
  opening<T> o;
  vec2<T> at{T(0), T(0)};
  for (std::size_t k = 0; k < discs; ++k) {
    o.add_disc(at, radius, state);
    const T angle = turn * T(static_cast<underlying_t<T>>(k));
    at = at + vec2<T>{cos(angle), sin(angle)} * side;
  }
  return {o, opening_status::ok};
}

/// Two equal discs that lie on a plate, a given gap apart. \par Units  [m]
template <real T>
[[nodiscard]] outcome<opening<T>, opening_status> two_discs_on_plate(const T& radius, const T& gap) noexcept {
  if (!detail::positive_and_finite(radius) || !detail::positive_and_finite(T(2) * radius + gap)) {
    return {{}, opening_status::invalid_input};
  }
  opening<T> o;
  o.add_disc({T(0), T(0)}, radius);
  o.add_disc({-(T(2) * radius + gap), T(0)}, radius);
  o.add_line({T(0), -radius}, {T(0), T(1)});
  return {o, opening_status::ok};
}

/// Unfolds ring b about the gap it shares with ring a into the plane of a, and takes that gap away: the ring around
/// the two facets that bound the gas at an edge. Sides of a come first, from the one after the gap.
/// \param gap_a  index of the gap in a, between its sides gap_a and gap_a + 1
/// \param gap_b  index of the same gap in b, which meets the two sides in the opposite order
/// \par Units  [m]
/// \par Domain  3 to 8 sides in the result; the gap lies between two discs, or a disc and a line. The two rings must
///              agree on the two radii and on the width of the gap to 1e-9
template <real T>
[[nodiscard]] outcome<opening<T>, opening_status> merge(const opening<T>& a, std::size_t gap_a, const opening<T>& b,
                                                        std::size_t gap_b) noexcept {
  if (a.count < 3 || b.count < 3 || gap_a >= a.count || gap_b >= b.count) {
    return {{}, opening_status::invalid_input};
  }
  if (a.count + b.count - 2 > opening<T>::max_sides) {
    return {{}, opening_status::too_many_sides};
  }
  // Side p of a is side p of b, and so is q; from p to q inside a, from q to p inside b.
  const auto& pa = a.sides[gap_a];
  const auto& qa = a.sides[a.next(gap_a)];
  const auto& qb = b.sides[gap_b];
  const auto& pb = b.sides[b.next(gap_b)];
  if (pa.kind != pb.kind || qa.kind != qb.kind || (pa.kind == side_kind::line && qa.kind == side_kind::line)) {
    return {{}, opening_status::not_shared};
  }
  const bool from_p = pa.kind == side_kind::disc;
  const auto& disc_a = from_p ? pa : qa;
  const auto& disc_b = from_p ? pb : qb;
  const auto& other_a = from_p ? qa : pa;
  const auto& other_b = from_p ? qb : pb;
  const auto axis = [](const opening_side<T>& disc, const opening_side<T>& other) -> vec2<T> {
    return other.kind == side_kind::disc ? other.point - disc.point
                                         : other.normal * dot(other.normal, other.point - disc.point);
  };
  const vec2<T> axis_a = axis(disc_a, other_a);
  const vec2<T> axis_b = axis(disc_b, other_b);
  const T length_a = norm(axis_a);
  const T length_b = norm(axis_b);
  const auto agree = [](const T& x, const T& y) {
    const auto gap = value_of(x - y);
    const auto size = value_of(x + y);
    return (gap < 0 ? -gap : gap) <= underlying_t<T>(1e-9) * size + 64 * epsilon<T> * size;
  };
  if (!detail::positive_and_finite(length_a) || !agree(length_a, length_b) || !agree(disc_a.radius, disc_b.radius) ||
      !agree(other_a.radius, other_b.radius)) {
    return {{}, opening_status::not_shared};
  }
  const T scale = length_a * length_b;
  const T cosine = dot(axis_b, axis_a) / scale;
  const T sine = cross(axis_b, axis_a) / scale;
  const auto turned = [&](const vec2<T>& v) -> vec2<T> {
    return {v.x * cosine - v.y * sine, v.x * sine + v.y * cosine};
  };
  opening<T> merged;
  const auto append = [&](const opening_side<T>& s, gap_state after) {
    merged.sides[merged.count] = s;
    merged.gaps[merged.count] = after;
    ++merged.count;
  };
  for (std::size_t k = a.next(gap_a); k != gap_a; k = a.next(k)) {
    append(a.sides[k], a.gaps[k]);
  }
  const std::size_t p_in_b = b.next(gap_b);
  append(pa, b.gaps[p_in_b]);
  for (std::size_t k = b.next(p_in_b); k != gap_b; k = b.next(k)) {
    opening_side<T> s = b.sides[k];
    s.point = disc_a.point + turned(s.point - disc_b.point);
    s.normal = turned(s.normal);
    append(s, b.gaps[k]);
  }
  detail::reframe(merged);
  return {merged, opening_status::ok};
}

}  // namespace tetrapore::inline TETRAPORE_ABI
