// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/ids.hpp"
#include "tetrapore/geometry/primitives.hpp"

#include <array>

/// \file
/// The region that a network fills: a box with walls, periodic axes and open faces in any mix.

namespace tetrapore::inline TETRAPORE_ABI {

/// An axis-aligned box. \par Units  [m]
struct box {
  vec3<double> lo;
  vec3<double> hi;

  [[nodiscard]] constexpr vec3<double> size() const noexcept { return hi - lo; }
  [[nodiscard]] constexpr double volume() const noexcept {
    const auto s = size();
    return s.x * s.y * s.z;
  }
  /// Position of a face along its axis [m].
  [[nodiscard]] constexpr double position(face f) const noexcept { return (is_max(f) ? hi : lo)[axis_of(f)]; }
};

/// What ends the network on a face of the box.
enum class boundary : unsigned char {
  open,     ///< the hull of the grain centres; the box says nothing there
  wall,     ///< a solid plane on the face of the box
  periodic  ///< continues at the opposite face, which must be periodic too
};

/// A box and what its six faces are.
struct domain {
  box bounds;
  std::array<boundary, 6> faces{boundary::open, boundary::open, boundary::open,
                                boundary::open, boundary::open, boundary::open};

  [[nodiscard]] constexpr boundary at(face f) const noexcept { return faces[static_cast<std::size_t>(f)]; }
  [[nodiscard]] constexpr bool is_wall(face f) const noexcept { return at(f) == boundary::wall; }
  [[nodiscard]] constexpr bool is_periodic(std::size_t axis) const noexcept {
    return faces[2 * axis] == boundary::periodic;
  }
  [[nodiscard]] constexpr bool any_periodic() const noexcept {
    return is_periodic(0) || is_periodic(1) || is_periodic(2);
  }
  /// The wall plane of a face, normal into the box.
  [[nodiscard]] constexpr plane<double> wall(face f) const noexcept {
    plane<double> w{is_max(f) ? bounds.hi : bounds.lo, {}};
    w.normal[axis_of(f)] = is_max(f) ? -1.0 : 1.0;
    return w;
  }
  /// Displacement of a periodic image [m].
  [[nodiscard]] constexpr vec3<double> shift(image i) const noexcept {
    const auto s = bounds.size();
    return {i.x * s.x, i.y * s.y, i.z * s.z};
  }
};

/// All six faces walls.
[[nodiscard]] constexpr domain walled(const box& b) noexcept {
  constexpr auto w = boundary::wall;
  return {b, {w, w, w, w, w, w}};
}

/// No box: the network fills the convex hull of the grain centres.
[[nodiscard]] constexpr domain unbounded() noexcept { return {}; }

}  // namespace tetrapore::inline TETRAPORE_ABI
