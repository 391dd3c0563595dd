// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/geometry/primitives.hpp"

#include <array>
#include <cstdint>

/// \file
/// Pore body: the cavity between four grains, or between fewer grains and the walls of a box.

namespace tetrapore::inline TETRAPORE_ABI {

/// A cell with its grains first, then its walls (mutually perpendicular planes):
///   4 grains          the tetrahedron of the centres;
///   3 grains + 1 wall the prism between the triangle of the centres and its projection on the wall;
///   2 grains + 2 walls the wedge between the segment of the centres and its projections on both walls and their edge;
///   1 grain + 3 walls the cuboid between the centre and the corner.
/// The order of the vertices is positive: for four grains triple(c1-c0, c2-c0, c3-c0) >= 0; a wall counts as a vertex
/// at infinity in the direction against its normal.
/// \par Units  [m]
template <real T>
struct pore_body {
  std::array<sphere<T>, 4> grains;  ///< only the first grain_count are filled
  std::array<plane<T>, 3> walls;    ///< only the first 4 - grain_count are filled
  std::uint8_t grain_count;

  [[nodiscard]] constexpr std::size_t wall_count() const noexcept { return 4U - grain_count; }
};

}  // namespace tetrapore::inline TETRAPORE_ABI
