// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/real.hpp"

#include <cmath>

/// \file
/// The smallest dual number: a value and one derivative. A model of `real` that a user could write.

template <std::floating_point T>
struct dual {
  T value{};
  T slope{};

  constexpr dual() = default;
  constexpr explicit dual(T v, T s = T(0)) : value(v), slope(s) {}

  friend constexpr dual operator+(dual a, dual b) { return dual(a.value + b.value, a.slope + b.slope); }
  friend constexpr dual operator-(dual a, dual b) { return dual(a.value - b.value, a.slope - b.slope); }
  friend constexpr dual operator-(dual a) { return dual(-a.value, -a.slope); }
  friend constexpr dual operator*(dual a, dual b) {
    return dual(a.value * b.value, a.slope * b.value + a.value * b.slope);
  }
  friend constexpr dual operator/(dual a, dual b) {
    return dual(a.value / b.value, (a.slope - a.value / b.value * b.slope) / b.value);
  }
  friend constexpr bool operator==(dual a, dual b) { return a.value == b.value; }
  friend constexpr auto operator<=>(dual a, dual b) { return a.value <=> b.value; }

  friend dual sqrt(dual a) {
    const T root = std::sqrt(a.value);
    return dual(root, a.slope / (2 * root));
  }
  friend dual sin(dual a) { return dual(std::sin(a.value), std::cos(a.value) * a.slope); }
  friend dual cos(dual a) { return dual(std::cos(a.value), -std::sin(a.value) * a.slope); }
  friend dual atan2(dual y, dual x) {
    return dual(std::atan2(y.value, x.value),
                (y.slope * x.value - y.value * x.slope) / (x.value * x.value + y.value * y.value));
  }
  friend constexpr T value_of(dual a) { return a.value; }
};

template <std::floating_point T>
struct tetrapore::underlying<dual<T>> {
  using type = T;
};
