// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/real.hpp"

#include <cmath>
#include <cstddef>

/// \file
/// Three coordinates, and the one customisation point by which any other position type gives them.

namespace tetrapore::inline TETRAPORE_ABI {

/// Three Cartesian coordinates. \par Units [m] where it is a position
template <class T>
struct vec3 {
  T x{};
  T y{};
  T z{};

  [[nodiscard]] constexpr T& operator[](std::size_t i) noexcept { return i == 0 ? x : (i == 1 ? y : z); }
  [[nodiscard]] constexpr const T& operator[](std::size_t i) const noexcept { return i == 0 ? x : (i == 1 ? y : z); }

  constexpr vec3& operator+=(const vec3& b) noexcept { return *this = *this + b; }
  constexpr vec3& operator-=(const vec3& b) noexcept { return *this = *this - b; }
  constexpr vec3& operator*=(const T& s) noexcept { return *this = *this * s; }

  [[nodiscard]] friend constexpr vec3 operator+(const vec3& a, const vec3& b) noexcept {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  [[nodiscard]] friend constexpr vec3 operator-(const vec3& a, const vec3& b) noexcept {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  [[nodiscard]] friend constexpr vec3 operator-(const vec3& a) noexcept { return {-a.x, -a.y, -a.z}; }
  [[nodiscard]] friend constexpr vec3 operator*(const vec3& a, const T& s) noexcept {
    return {a.x * s, a.y * s, a.z * s};
  }
  [[nodiscard]] friend constexpr vec3 operator*(const T& s, const vec3& a) noexcept { return a * s; }
  [[nodiscard]] friend constexpr vec3 operator/(const vec3& a, const T& s) noexcept {
    return {a.x / s, a.y / s, a.z / s};
  }
  [[nodiscard]] friend constexpr bool operator==(const vec3&, const vec3&) = default;
};

template <class T>
[[nodiscard]] constexpr T dot(const vec3<T>& a, const vec3<T>& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
[[nodiscard]] constexpr vec3<T> cross(const vec3<T>& a, const vec3<T>& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class T>
[[nodiscard]] constexpr T norm2(const vec3<T>& a) noexcept {
  return dot(a, a);
}

template <class T>
[[nodiscard]] T norm(const vec3<T>& a) noexcept {
  using std::sqrt;
  return sqrt(norm2(a));
}

template <class T>
[[nodiscard]] constexpr T triple(const vec3<T>& a, const vec3<T>& b, const vec3<T>& c) noexcept {
  return dot(a, cross(b, c));
}

/// True when no coordinate is NaN or infinite.
template <std::floating_point T>
[[nodiscard]] bool finite(const vec3<T>& a) noexcept {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

namespace detail {

template <class P>
concept hooked_position = requires(const P& p) {
  { tetrapore_position(p) } -> std::convertible_to<vec3<double>>;
};

template <class P>
concept member_position = requires(const P& p) {
  { p.x } -> std::convertible_to<double>;
  { p.y } -> std::convertible_to<double>;
  { p.z } -> std::convertible_to<double>;
};

template <class P>
concept indexed_position = requires(const P& p) {
  { p[0] } -> std::convertible_to<double>;
};

}  // namespace detail

/// A type that gives three coordinates: by a free function `tetrapore_position(p)` found by argument-dependent lookup
/// (the customisation point), else by members x, y, z, else by p[0], p[1], p[2].
template <class P>
concept position = detail::hooked_position<P> || detail::member_position<P> || detail::indexed_position<P>;

/// The three coordinates of any position.
template <position P>
[[nodiscard]] constexpr vec3<double> coordinates(const P& p) {
  if constexpr (detail::hooked_position<P>) {
    return tetrapore_position(p);
  } else if constexpr (detail::member_position<P>) {
    return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
  } else {
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  }
}

}  // namespace tetrapore::inline TETRAPORE_ABI
