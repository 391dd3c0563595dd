// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/contracts.hpp"

#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>

/// \file
/// The scalars that laws are written in.

namespace tetrapore::inline TETRAPORE_ABI {

/// The plain floating-point type behind a scalar. A dual number specialises it: `struct underlying<dual> { using type
/// = double; };` and gives a free function `value_of(dual)`.
template <class T>
struct underlying {
  using type = T;
};

template <class T>
using underlying_t = typename underlying<T>::type;

/// The value of a scalar without its derivatives.
template <std::floating_point T>
[[nodiscard]] constexpr T value_of(T x) noexcept {
  return x;
}

/// A scalar of the local laws.
/// Syntax: the four operations, comparison, construction from its underlying type, `value_of`, and sqrt, sin, cos and
/// atan2 found by argument-dependent lookup.
/// Semantics: an ordered field up to rounding; a dual number compares by value.
/// Models: float, double, long double; a dual number.
template <class T>
concept real = std::copyable<T> && std::floating_point<underlying_t<T>> &&
               std::constructible_from<T, underlying_t<T>> && requires(const T a, const T b) {
                 { a + b } -> std::convertible_to<T>;
                 { a - b } -> std::convertible_to<T>;
                 { a* b } -> std::convertible_to<T>;
                 { a / b } -> std::convertible_to<T>;
                 { -a } -> std::convertible_to<T>;
                 { a < b } -> std::convertible_to<bool>;
                 { value_of(a) } -> std::convertible_to<underlying_t<T>>;
               };

/// Rounding unit of the scalar: the distance from 1 to the next number.
template <real T>
inline constexpr underlying_t<T> epsilon = std::numeric_limits<underlying_t<T>>::epsilon();

template <real T>
inline constexpr underlying_t<T> infinity = std::numeric_limits<underlying_t<T>>::infinity();

template <real T>
inline constexpr underlying_t<T> quiet_nan = std::numeric_limits<underlying_t<T>>::quiet_NaN();

template <real T>
inline constexpr underlying_t<T> pi = static_cast<underlying_t<T>>(3.141592653589793238462643383279502884L);

}  // namespace tetrapore::inline TETRAPORE_ABI
