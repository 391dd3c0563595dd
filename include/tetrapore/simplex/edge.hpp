// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/geometry/primitives.hpp"

/// \file
/// Edge: a pair of grains, or a grain and a plane; a contact or a bridge.

namespace tetrapore::inline TETRAPORE_ABI {

/// What a pair law sees. The gap is a member, not a difference of coordinates, so that it keeps its digits near
/// contact.
/// \par Units  [m]; gap < 0 is an overlap
template <real T>
struct edge {
  T radius1;       ///< radius of the first grain
  T radius2;       ///< radius of the second grain; infinity for a plane
  T gap;           ///< shortest distance of the two surfaces
  vec3<T> normal;  ///< unit vector from the first to the second

  [[nodiscard]] constexpr bool with_plane() const noexcept { return !(value_of(radius2) < infinity<T>); }
};

}  // namespace tetrapore::inline TETRAPORE_ABI
