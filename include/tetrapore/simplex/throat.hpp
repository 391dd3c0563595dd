// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/geometry/primitives.hpp"

#include <array>
#include <cstdint>

/// \file
/// Throat: the facet between two pores.

namespace tetrapore::inline TETRAPORE_ABI {

/// A facet with its grains first, then its walls: three grains; two grains and a wall (trapezoid between the centres
/// and their feet); one grain and two walls (rectangle).
/// \par Units  [m], area_vector [m²]
template <real T>
struct throat {
  std::array<sphere<T>, 3> grains;  ///< only the first grain_count are filled
  std::array<plane<T>, 2> walls;    ///< only the first 3 - grain_count are filled
  std::uint8_t grain_count;
  vec3<T> area_vector;           ///< normal from pore 0 to pore 1 times the area of the facet
  std::array<vec3<T>, 2> nodes;  ///< the power centres of the two pores; on a boundary both are those of pore 0

  [[nodiscard]] constexpr std::size_t wall_count() const noexcept { return 3U - grain_count; }
};

}  // namespace tetrapore::inline TETRAPORE_ABI
