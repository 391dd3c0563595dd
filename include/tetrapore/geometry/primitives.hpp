// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/vec3.hpp"

/// \file
/// Spheres, planes, and points of a plane section.

namespace tetrapore::inline TETRAPORE_ABI {

/// \par Units  [m]
template <class T>
struct sphere {
  vec3<T> centre;
  T radius{};

  [[nodiscard]] friend constexpr bool operator==(const sphere&, const sphere&) = default;
};

/// A wall: the plane through `point`; the fluid and the grains lie on the side that `normal` points to.
/// \par Units  point [m], normal a unit vector
template <class T>
struct plane {
  vec3<T> point;
  vec3<T> normal;

  /// Signed distance [m], positive inside.
  [[nodiscard]] constexpr T distance(const vec3<T>& p) const noexcept { return dot(p - point, normal); }
  [[nodiscard]] constexpr vec3<T> project(const vec3<T>& p) const noexcept { return p - normal * distance(p); }
};

/// Two coordinates in the plane of a section. \par Units  [m] where it is a position
template <class T>
struct vec2 {
  T x{};
  T y{};

  [[nodiscard]] friend constexpr vec2 operator+(const vec2& a, const vec2& b) noexcept {
    return {a.x + b.x, a.y + b.y};
  }
  [[nodiscard]] friend constexpr vec2 operator-(const vec2& a, const vec2& b) noexcept {
    return {a.x - b.x, a.y - b.y};
  }
  [[nodiscard]] friend constexpr vec2 operator-(const vec2& a) noexcept { return {-a.x, -a.y}; }
  [[nodiscard]] friend constexpr vec2 operator*(const vec2& a, const T& s) noexcept { return {a.x * s, a.y * s}; }
  [[nodiscard]] friend constexpr vec2 operator*(const T& s, const vec2& a) noexcept { return a * s; }
};

template <class T>
[[nodiscard]] constexpr T dot(const vec2<T>& a, const vec2<T>& b) noexcept {
  return a.x * b.x + a.y * b.y;
}

/// Signed area of the parallelogram: positive when b lies counter-clockwise of a.
template <class T>
[[nodiscard]] constexpr T cross(const vec2<T>& a, const vec2<T>& b) noexcept {
  return a.x * b.y - a.y * b.x;
}

template <class T>
[[nodiscard]] T norm(const vec2<T>& a) noexcept {
  using std::sqrt;
  return sqrt(dot(a, a));
}

namespace detail {

template <class G>
concept hooked_sphere = requires(const G& g) {
  { tetrapore_sphere(g) } -> std::convertible_to<sphere<double>>;
};

template <class G>
concept centre_and_radius = requires(const G& g) {
  { coordinates(g.centre) } -> std::same_as<vec3<double>>;
  { g.radius } -> std::convertible_to<double>;
};

template <class G>
concept position_and_radius = requires(const G& g) {
  { coordinates(g.position) } -> std::same_as<vec3<double>>;
  { g.radius } -> std::convertible_to<double>;
};

template <class G>
concept pair_of_position_and_radius = requires(const G& g) {
  { coordinates(g.first) } -> std::same_as<vec3<double>>;
  { g.second } -> std::convertible_to<double>;
};

}  // namespace detail

/// A grain of the caller: by a free function `tetrapore_sphere(g)` found by argument-dependent lookup (the
/// customisation point), else members centre (or position) and radius, else a pair (position, radius).
template <class G>
concept grain_like = detail::hooked_sphere<G> || detail::centre_and_radius<G> || detail::position_and_radius<G> ||
                     detail::pair_of_position_and_radius<G>;

template <grain_like G>
[[nodiscard]] constexpr sphere<double> as_sphere(const G& g) {
  if constexpr (detail::hooked_sphere<G>) {
    return tetrapore_sphere(g);
  } else if constexpr (detail::centre_and_radius<G>) {
    return {coordinates(g.centre), static_cast<double>(g.radius)};
  } else if constexpr (detail::position_and_radius<G>) {
    return {coordinates(g.position), static_cast<double>(g.radius)};
  } else {
    return {coordinates(g.first), static_cast<double>(g.second)};
  }
}

}  // namespace tetrapore::inline TETRAPORE_ABI
