// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/real.hpp"

#include <array>
#include <cstddef>

/// \file
/// Nodes and weights of Gauss and Legendre, computed by the compiler in long double.
/// \par Source  Newton's method on the Legendre polynomial from Tricomi's estimate of its zeros; Abramowitz & Stegun,
///              22.16.6 and 25.4.29

namespace tetrapore::inline TETRAPORE_ABI {
namespace detail {

/// The positive half of the rule of 2 N points on [-1, 1]: the sum of weight × f(node) is the integral of an even f
/// over [0, 1], exact for polynomials of degree 4 N − 1.
template <std::floating_point T, int N>
struct half_rule {
  std::array<T, static_cast<std::size_t>(N)> node{};
  std::array<T, static_cast<std::size_t>(N)> square{};  ///< of the node
  std::array<T, static_cast<std::size_t>(N)> weight{};
};

consteval long double cosine_series(long double x) {
  long double term = 1;
  long double sum = 1;
  for (int i = 1; i < 40; ++i) {
    term *= -x * x / static_cast<long double>((2 * i - 1) * (2 * i));
    sum += term;
  }
  return sum;
}

template <std::floating_point T, int N>
consteval half_rule<T, N> make_half_rule() {
  static_assert(N >= 1);
  constexpr int order = 2 * N;
  half_rule<T, N> rule;
  for (int i = 0; i < N; ++i) {
    long double x = cosine_series(pi<long double> * (static_cast<long double>(N - i) - 0.25L) /
                                  (static_cast<long double>(order) + 0.5L));
    long double slope = 0;
    for (int iteration = 0; iteration < 8; ++iteration) {
      long double before = 1;
      long double value = x;
      for (int n = 2; n <= order; ++n) {
        const long double next =
            (static_cast<long double>(2 * n - 1) * x * value - static_cast<long double>(n - 1) * before) /
            static_cast<long double>(n);
        before = value;
        value = next;
      }
      slope = static_cast<long double>(order) * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    const auto k = static_cast<std::size_t>(i);
    rule.node[k] = static_cast<T>(x);
    rule.square[k] = static_cast<T>(x * x);
    rule.weight[k] = static_cast<T>(2 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

template <std::floating_point T, int N>
inline constexpr half_rule<T, N> gauss = make_half_rule<T, N>();

}  // namespace detail
}  // namespace tetrapore::inline TETRAPORE_ABI
