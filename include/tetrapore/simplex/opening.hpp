// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/geometry/primitives.hpp"

#include <array>
#include <cstdint>

/// \file
/// Opening: the plane section that a meniscus must pass.

namespace tetrapore::inline TETRAPORE_ABI {

enum class side_kind : std::uint8_t {
  disc,  ///< the section of a grain
  line   ///< the section of a wall
};

enum class gap_state : std::uint8_t {
  liquid,  ///< a ring of liquid can close the gap: the meniscus ends on an arc there
  open     ///< gas lies beyond the gap (a mirror plane, a gas-filled neighbour): no arc, no line there
};

/// One side of an opening. \par Units  [m]
template <real T>
struct opening_side {
  vec2<T> point;   ///< disc: its centre; line: any point of it
  vec2<T> normal;  ///< line: the unit normal into the fluid; disc: unused
  T radius;        ///< disc: its radius; line: unused
  side_kind kind;
};

/// A ring of 3 to 8 sides, counter-clockwise. Gap k lies between side k and side k+1 (the last: back to side 0).
/// The corner of the ring at a disc is its centre; a line between two discs is met at the feet of their centres; two
/// lines meet in their intersection. The frame's origin is the centre of the smallest disc, so that coordinates near
/// the narrow part keep their digits. Only the first `count` sides are filled.
/// \par Units  [m]
template <real T>
struct opening {
  static constexpr std::size_t max_sides = 8;

  std::size_t count = 0;
  std::array<opening_side<T>, max_sides> sides;
  std::array<gap_state, max_sides> gaps;

  [[nodiscard]] constexpr std::size_t next(std::size_t k) const noexcept { return k + 1 == count ? 0 : k + 1; }
  [[nodiscard]] constexpr std::size_t previous(std::size_t k) const noexcept { return k == 0 ? count - 1 : k - 1; }

  constexpr void add_disc(const vec2<T>& centre, const T& radius, gap_state after = gap_state::liquid) noexcept {
    TETRAPORE_EXPECTS(count < max_sides, "an opening has at most 8 sides");
    sides[count] = {centre, {}, radius, side_kind::disc};
    gaps[count] = after;
    ++count;
  }
  constexpr void add_line(const vec2<T>& point, const vec2<T>& normal, gap_state after = gap_state::liquid) noexcept {
    TETRAPORE_EXPECTS(count < max_sides, "an opening has at most 8 sides");
    sides[count] = {point, normal, T(0), side_kind::line};
    gaps[count] = after;
    ++count;
  }
};

}  // namespace tetrapore::inline TETRAPORE_ABI
