// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/error.hpp"
#include "tetrapore/geometry/domain.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

/// \file
/// A packing: grains, and the box that holds them.

namespace tetrapore::inline TETRAPORE_ABI {

/// Grains in the order of their source; their index is their grain_id.
/// \par Units  [m]
struct packing {
  std::vector<sphere<double>> grains;
  std::optional<box> bounds;       ///< none: the packing fills the hull of its centres
  std::array<bool, 3> periodic{};  ///< axes along which the box repeats; needs `bounds`
};

/// The domain of a packing: its box with walls on the axes that are not periodic, or open faces there when `walls` is
/// false; unbounded when it has no box.
/// \throw packing_error  a periodic axis without a box
[[nodiscard]] inline domain domain_of(const packing& p, bool walls = true) {
  if (!p.bounds) {
    for (const bool repeats : p.periodic) {
      if (repeats) {
        throw packing_error("box", "none", "a box, because an axis is periodic");
      }
    }
    return unbounded();
  }
  domain d{*p.bounds};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto kind = p.periodic[axis] ? boundary::periodic : (walls ? boundary::wall : boundary::open);
    d.faces[2 * axis] = d.faces[2 * axis + 1] = kind;
  }
  return d;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
