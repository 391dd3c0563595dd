// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/contracts.hpp"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <utility>

/// \file
/// Linear systems of a handful of unknowns.

namespace tetrapore::inline TETRAPORE_ABI {
namespace detail {

template <std::floating_point T, int Rows, int Columns>
using matrix = T[static_cast<std::size_t>(Rows)][static_cast<std::size_t>(Columns)];

/// Gaussian elimination with row pivoting of n equations with m right-hand sides, in place: the last m columns become
/// the solutions. False where a pivot is 0 or not a number.
template <int n, int m, std::floating_point T>
[[nodiscard]] inline bool eliminate(matrix<T, n, n + m>& a) noexcept {
  for (int i = 0; i < n; ++i) {
    int pivot = i;
    for (int r = i + 1; r < n; ++r) {
      pivot = std::abs(a[r][i]) > std::abs(a[pivot][i]) ? r : pivot;
    }
    if (!(std::abs(a[pivot][i]) > T(0))) {
      return false;
    }
    std::swap(a[i], a[pivot]);
    const T inverse = T(1) / a[i][i];
    for (int r = i + 1; r < n; ++r) {
      const T factor = a[r][i] * inverse;
      for (int c = i + 1; c < n + m; ++c) {
        a[r][c] -= factor * a[i][c];
      }
    }
    a[i][i] = inverse;
  }
  for (int k = n; k < n + m; ++k) {
    for (int i = n - 1; i >= 0; --i) {
      T sum = a[i][k];
      for (int c = i + 1; c < n; ++c) {
        sum -= a[i][c] * a[c][k];
      }
      a[i][k] = sum * a[i][i];
    }
  }
  return true;
}

}  // namespace detail
}  // namespace tetrapore::inline TETRAPORE_ABI
