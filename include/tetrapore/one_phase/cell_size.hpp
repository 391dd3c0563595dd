// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/simplex/pore_body.hpp"

#include <algorithm>
#include <cstddef>

/// \file
/// The size of a cell.

namespace tetrapore::inline TETRAPORE_ABI {

/// Square of the longest edge of a cell; the edge to a wall is the height above it.
/// \par Units  [m²]
/// \par Accuracy  a few epsilon
template <real T>
[[nodiscard]] T longest_edge2(const pore_body<T>& body) noexcept {
  T longest(0);
  for (std::size_t i = 0; i < body.grain_count; ++i) {
    for (std::size_t j = i + 1; j < body.grain_count; ++j) {
      longest = std::max(longest, norm2(body.grains[j].centre - body.grains[i].centre));
    }
    for (std::size_t w = 0; w < body.wall_count(); ++w) {
      const T height = body.walls[w].distance(body.grains[i].centre);
      longest = std::max(longest, height * height);
    }
  }
  return longest;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
