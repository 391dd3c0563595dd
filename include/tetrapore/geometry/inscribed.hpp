// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/outcome.hpp"
#include "tetrapore/geometry/primitives.hpp"

#include <array>
#include <cstddef>

/// \file
/// The circle that touches three sides of a plane section, and the sphere that touches four walls of a pore: closed
/// forms of the problem of Apollonius, in the frame of the smallest grain.

namespace tetrapore::inline TETRAPORE_ABI {

/// A circle of a plane section. \par Units  [m]
template <class T>
struct circle {
  vec2<T> centre;
  T radius{};
};

/// What bounds a section or a pore from one side: a round grain or a flat wall.
/// \par Units  point [m], normal a unit vector into the fluid, radius [m]
template <class Vector, class T>
struct bounding_side {
  Vector point;   ///< round: its centre; flat: any point of it
  Vector normal;  ///< flat only
  T radius{};     ///< round only
  bool flat = false;
};

template <class T>
using bounding_side2 = bounding_side<vec2<T>, T>;
template <class T>
using bounding_side3 = bounding_side<vec3<T>, T>;

template <class T>
[[nodiscard]] constexpr bounding_side3<T> round_side(const sphere<T>& s) noexcept {
  return {s.centre, {}, s.radius, false};
}
template <class T>
[[nodiscard]] constexpr bounding_side3<T> flat_side(const plane<T>& p) noexcept {
  return {p.point, p.normal, T(0), true};
}

enum class inscribed_status : unsigned char {
  ok,            ///< a circle or sphere of positive radius touches every side from the fluid
  covered,       ///< the sides overlap: the radius is zero or negative, by how far they do
  none,          ///< nothing touches all sides
  degenerate,    ///< the sides do not bound a region: collinear or coplanar centres, parallel walls
  invalid_input  ///< NaN or infinite, or a radius that is not positive
};

[[nodiscard]] constexpr verdict verdict_of(inscribed_status s) noexcept {
  switch (s) {
    case inscribed_status::ok: return verdict::ok;
    case inscribed_status::covered: return verdict::absent;
    case inscribed_status::none:
    case inscribed_status::degenerate:
    case inscribed_status::invalid_input: break;
  }
  return verdict::refused;
}

[[nodiscard]] constexpr const char* describe(inscribed_status s) noexcept {
  switch (s) {
    case inscribed_status::ok: return "ok";
    case inscribed_status::covered: return "covered: the sides overlap where the circle or sphere would be";
    case inscribed_status::none: return "nothing touches all sides";
    case inscribed_status::degenerate: return "the sides do not bound a region";
    case inscribed_status::invalid_input: return "a coordinate or radius is not a number, or a radius is not positive";
  }
  return "not an inscribed status";
}

namespace detail {

/// The condition "the circle (x, r) touches this side", minus the same condition for the round side at the origin:
/// along · x + slope r = offset.
template <class Vector, class T>
struct touching {
  Vector along;
  T slope;
  T offset;
};

/// `base_radius` belongs to the round side at `origin`.
template <class Vector, class T>
[[nodiscard]] touching<Vector, T> touching_condition(const bounding_side<Vector, T>& s, const Vector& origin,
                                                     const T& base_radius) noexcept {
  const Vector c = s.point - origin;
  if (s.flat) {
    return {s.normal, T(-1), dot(s.normal, c)};
  }
  const T d = norm(c);
  return {c, s.radius - base_radius, T(0.5) * ((d - s.radius) * (d + s.radius) + base_radius * base_radius)};
}

/// Radius from |centre_0 + centre_1 r / det| = R + r with the smaller root, without cancellation.
template <class T>
struct apollonius_root {
  T radius;
  bool exists;
};

template <class Vector, class T>
[[nodiscard]] apollonius_root<T> touch_base(const Vector& x0, const Vector& x1, const T& base_radius) noexcept {
  using std::sqrt;
  const T a = dot(x1, x1) - T(1);
  const T b = base_radius - dot(x0, x1);
  const T size = sqrt(dot(x0, x0));
  const T c = (size - base_radius) * (size + base_radius);
  const T discriminant = b * b - a * c;
  if (!(discriminant >= T(0))) {
    return {T(0), false};
  }
  const T root = sqrt(discriminant);
  if (b + root > T(0)) {
    return {c / (b + root), true};
  }
  // b < 0: both roots of a r² - 2 b r + c lie on one side; the smaller in size is c / (b - root).
  if (!(b - root < T(0)) || !(c < T(0))) {
    return {T(0), false};
  }
  return {c / (b - root), true};
}

template <class T>
[[nodiscard]] bool is_finite(const T& x) noexcept {
  return std::isfinite(value_of(x));
}

template <class Vector, class T>
[[nodiscard]] bool usable(const bounding_side<Vector, T>& s) noexcept {
  return is_finite(dot(s.point, s.point)) &&
         (s.flat ? is_finite(dot(s.normal, s.normal)) : (is_finite(s.radius) && s.radius > T(0)));
}

template <std::size_t N, class Vector, class T>
[[nodiscard]] std::size_t smallest_round(const std::array<bounding_side<Vector, T>, N>& sides) noexcept {
  std::size_t best = N;
  for (std::size_t i = 0; i < N; ++i) {
    if (!sides[i].flat && (best == N || sides[i].radius < sides[best].radius)) {
      best = i;
    }
  }
  return best;
}

/// A determinant of the directions `along` counts as zero below this share of the product of their lengths.
template <real T>
inline constexpr underlying_t<T> flatness = underlying_t<T>(64) * epsilon<T>;

template <class V>
[[nodiscard]] constexpr outcome<V, inscribed_status> touched(V answer) noexcept {
  const bool open = value_of(answer.radius) > 0;
  return {answer, open ? inscribed_status::ok : inscribed_status::covered};
}

template <class Vector, class T, class Answer>
[[nodiscard]] outcome<Answer, inscribed_status> not_touched(inscribed_status why) noexcept {
  Answer answer;
  answer.radius = T(quiet_nan<T>);
  return {answer, why};
}

}  // namespace detail

/// The circle that touches three sides from the fluid.
/// \par Units  [m]
/// \par Domain  any mix of discs and wall lines, not collinear; overlapping discs give a radius that is not positive
/// \par Accuracy  relative 64 ε / (radius of the smallest disc, in units of the largest distance), where the triangle
///                is not a sliver; worst on open_msp.csv 9.1e-14 (a throat nearly
///                closed), 1e-15 as a rule
/// \par Source  problem of Apollonius: differences of the three tangency conditions are linear in the centre; the
///              radius is a root of a quadratic. Chareyre et al. 2017, §2.3
template <real T>
[[nodiscard]] outcome<circle<T>, inscribed_status> circle_between(
    const std::array<bounding_side2<T>, 3>& sides) noexcept {
  constexpr auto failed = detail::not_touched<vec2<T>, T, circle<T>>;
  for (const auto& s : sides) {
    if (!detail::usable(s)) {
      return failed(inscribed_status::invalid_input);
    }
  }
  const std::size_t base = detail::smallest_round(sides);
  if (base == 3) {
    // n · x - r = n · p for three lines, relative to a point of the first.
    const vec2<T> origin = sides[0].point;
    const vec2<T> e1 = sides[1].normal - sides[0].normal;
    const vec2<T> e2 = sides[2].normal - sides[0].normal;
    const T k1 = dot(sides[1].normal, sides[1].point - origin);
    const T k2 = dot(sides[2].normal, sides[2].point - origin);
    const T det = cross(e1, e2);
    if (!(value_of(det * det) > detail::flatness<T> * detail::flatness<T>)) {
      return failed(inscribed_status::degenerate);
    }
    const vec2<T> x{(k1 * e2.y - k2 * e1.y) / det, (e1.x * k2 - e2.x * k1) / det};
    return detail::touched(circle<T>{origin + x, dot(sides[0].normal, x)});
  }
  const vec2<T> origin = sides[base].point;
  const T radius = sides[base].radius;
  const auto p = detail::touching_condition(sides[(base + 1) % 3], origin, radius);
  const auto q = detail::touching_condition(sides[(base + 2) % 3], origin, radius);
  const T det = cross(p.along, q.along);
  const T size2 = dot(p.along, p.along) * dot(q.along, q.along);
  if (!(value_of(det * det) > detail::flatness<T> * detail::flatness<T> * value_of(size2))) {
    return failed(inscribed_status::degenerate);
  }
  const T inverse = T(1) / det;
  const vec2<T> x0{(p.offset * q.along.y - q.offset * p.along.y) * inverse,
                   (p.along.x * q.offset - q.along.x * p.offset) * inverse};
  const vec2<T> x1{(q.slope * p.along.y - p.slope * q.along.y) * inverse,
                   (q.along.x * p.slope - p.along.x * q.slope) * inverse};
  const auto root = detail::touch_base(x0, x1, radius);
  if (!root.exists) {
    return failed(inscribed_status::none);
  }
  return detail::touched(circle<T>{origin + x0 + x1 * root.radius, root.radius});
}

/// The sphere that touches four sides of a pore from the fluid.
/// \par Units  [m]
/// \par Domain  any mix of spheres and wall planes, not coplanar; overlapping grains give a radius that is not positive
/// \par Accuracy  relative 64 ε / (radius of the smallest grain, in units of the largest distance), where the
///                tetrahedron is not a sliver
/// \par Source  problem of Apollonius in three dimensions: a quadratic, as for the circle
template <real T>
[[nodiscard]] outcome<sphere<T>, inscribed_status> sphere_between(
    const std::array<bounding_side3<T>, 4>& sides) noexcept {
  constexpr auto failed = detail::not_touched<vec3<T>, T, sphere<T>>;
  for (const auto& s : sides) {
    if (!detail::usable(s)) {
      return failed(inscribed_status::invalid_input);
    }
  }
  const std::size_t base = detail::smallest_round(sides);
  const bool all_flat = base == 4;
  const std::size_t first = all_flat ? 0 : base;
  const vec3<T> origin = sides[first].point;
  const T radius = sides[first].radius;
  std::array<detail::touching<vec3<T>, T>, 3> t;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& s = sides[(first + 1 + i) % 4];
    t[i] = detail::touching_condition(s, origin, radius);
    if (all_flat) {
      t[i].along -= sides[0].normal;
      t[i].slope = T(0);
    }
  }
  const vec3<T> c12 = cross(t[1].along, t[2].along);
  const vec3<T> c20 = cross(t[2].along, t[0].along);
  const vec3<T> c01 = cross(t[0].along, t[1].along);
  const T det = dot(t[0].along, c12);
  const T size2 = all_flat ? T(1) : norm2(t[0].along) * norm2(t[1].along) * norm2(t[2].along);
  if (!(value_of(det * det) > detail::flatness<T> * detail::flatness<T> * value_of(size2))) {
    return failed(inscribed_status::degenerate);
  }
  const T inverse = T(1) / det;
  const vec3<T> x0 = (c12 * t[0].offset + c20 * t[1].offset + c01 * t[2].offset) * inverse;
  if (all_flat) {
    return detail::touched(sphere<T>{origin + x0, dot(sides[0].normal, x0)});
  }
  const vec3<T> x1 = (c12 * t[0].slope + c20 * t[1].slope + c01 * t[2].slope) * (-inverse);
  const auto root = detail::touch_base(x0, x1, radius);
  if (!root.exists) {
    return failed(inscribed_status::none);
  }
  return detail::touched(sphere<T>{origin + x0 + x1 * root.radius, root.radius});
}

}  // namespace tetrapore::inline TETRAPORE_ABI
