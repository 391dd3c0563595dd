// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/dual.hpp"
#include "support/openings.hpp"

#include <algorithm>
#include <cmath>

/// \file
/// How far the rounding of an opening's coordinates moves the answer of an entry law.

namespace openings {

/// Distance from the origin within which the sides lie.
[[nodiscard]] inline double extent(const opening<double>& o) {
  double largest = 0;
  for (std::size_t k = 0; k < o.count; ++k) {
    largest = std::max(largest, norm(o.sides[k].point) + o.sides[k].radius);
  }
  return largest;
}

/// By how many units of rounding a pressure may be wrong: the relative changes of the pressure by the changes of the
/// coordinates and radii relative to the extent, summed over them (what the rounding of the opening alone does), and 32
/// for the roundings of the law's own arithmetic. The slopes are the law's own where it has them, else those of dual
/// numbers.
template <class Law>
[[nodiscard]] double condition(const Law& law, const opening<double>& o) {
  double sum = 0;
  if constexpr (requires { law.derivative(o); }) {
    const auto slopes = law.derivative(o).value;
    for (std::size_t k = 0; k < o.count; ++k) {
      sum += std::abs(slopes.by_centre[k].x) + std::abs(slopes.by_centre[k].y) + std::abs(slopes.by_radius[k]);
    }
    sum /= slopes.pressure;
  } else {
    for (std::size_t k = 0; k < o.count; ++k) {
      const int axes = o.sides[k].kind == side_kind::disc ? 3 : 2;
      for (int axis = 0; axis < axes; ++axis) {
        auto moving = as<dual<double>>(o);
        auto& s = moving.sides[k];
        (axis == 0 ? s.point.x : axis == 1 ? s.point.y : s.radius).slope = 1;
        const auto answer = law.entry_pressure(moving).value;
        sum += std::abs(answer.slope / answer.value);
      }
    }
  }
  return 32 + sum * extent(o);
}

}  // namespace openings
