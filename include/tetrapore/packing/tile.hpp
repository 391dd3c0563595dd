// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/packing/packing.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

/// \file
/// Large packings from small ones: copies of a periodic packing, side by side.

namespace tetrapore::inline TETRAPORE_ABI {

/// copies[0] × copies[1] × copies[2] copies of a packing, periodic along every axis that has more than one. The result
/// has the same periodic axes, in the larger box; grain g of copy c is number c · N + g, copies counted with z fastest.
/// \par Units  [m]
/// \par Accuracy  a copy's centres are off by at most one rounding of the larger coordinates
/// \throw parameter_error  no copies, or more than 2³¹ grains
/// \throw packing_error    several copies along an axis that is not periodic
inline packing tile(const packing& p, std::array<std::size_t, 3> copies) {
  constexpr std::array<const char*, 3> axis_name{"x", "y", "z"};
  const auto d = domain_of(p);
  std::size_t total = p.grains.size();
  for (std::size_t k = 0; k < 3; ++k) {
    if (copies[k] == 0) {
      throw parameter_error(std::string("copies along ") + axis_name[k], "0", "at least 1");
    }
    if (copies[k] > 1 && !d.is_periodic(k)) {
      throw packing_error(std::string("box along ") + axis_name[k], "walls", "a periodic axis, to repeat the packing");
    }
    if (total > std::numeric_limits<std::uint32_t>::max() / 2 / copies[k]) {
      throw parameter_error("copies", "more than 2^31 grains", "fewer");
    }
    total *= copies[k];
  }
  packing tiled;
  tiled.periodic = p.periodic;
  tiled.bounds = p.bounds;
  tiled.grains.reserve(total);
  const auto size = d.bounds.size();
  for (std::size_t x = 0; x < copies[0]; ++x) {
    for (std::size_t y = 0; y < copies[1]; ++y) {
      for (std::size_t z = 0; z < copies[2]; ++z) {
        const vec3<double> shift{static_cast<double>(x) * size.x, static_cast<double>(y) * size.y,
                                 static_cast<double>(z) * size.z};
        for (const auto& g : p.grains) {
          tiled.grains.push_back({g.centre + shift, g.radius});
        }
      }
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (copies[k] > 1) {
      tiled.bounds->hi[k] = tiled.bounds->lo[k] + static_cast<double>(copies[k]) * size[k];
    }
  }
  return tiled;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
