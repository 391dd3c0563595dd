// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/packing/packing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

/// \file
/// Lattices of equal touching spheres: exact answers for whatever is computed on a packing.

namespace tetrapore::inline TETRAPORE_ABI {

enum class lattice_kind : unsigned char {
  simple_cubic,    ///< 1 sphere per cell, 6 contacts, solid fraction π/6
  body_centred,    ///< 2 per cell, 8 contacts, π√3/8
  face_centred,    ///< 4 per cell, 12 contacts, π/√18
  hexagonal_close  ///< 4 per rectangular cell, 12 contacts, π/√18
};

/// The repeating cell of a lattice of spheres of radius 1.
struct lattice_cell {
  vec3<double> size;
  std::vector<vec3<double>> sites;  ///< as fractions of the size
};

[[nodiscard]] inline lattice_cell cell_of(lattice_kind kind) {
  using std::sqrt;
  switch (kind) {
    case lattice_kind::simple_cubic: return {{2.0, 2.0, 2.0}, {{0, 0, 0}}};
    case lattice_kind::body_centred: {
      const double a = 4.0 / sqrt(3.0);
      return {{a, a, a}, {{0, 0, 0}, {0.5, 0.5, 0.5}}};
    }
    case lattice_kind::face_centred: {
      const double a = 2.0 * sqrt(2.0);
      return {{a, a, a}, {{0, 0, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}, {0.5, 0.5, 0}}};
    }
    case lattice_kind::hexagonal_close:
      return {{2.0, 2.0 * sqrt(3.0), 4.0 * sqrt(2.0 / 3.0)},
              {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 1.0 / 6.0, 0.5}, {0, 2.0 / 3.0, 0.5}}};
  }
  throw parameter_error("lattice kind", std::to_string(static_cast<int>(kind)), "one of the four");
}

/// A block of nx × ny × nz cells of a lattice. Along a periodic axis the box is the cells' length; along the others
/// walls touch the outermost spheres. The first sphere is at the origin.
/// \par Units  [m]
/// \par Accuracy  contact distances to 4 rounding units of the box
/// \throw parameter_error  no cells, or a radius that is not above 0
inline packing lattice(lattice_kind kind, std::array<std::size_t, 3> cells, double radius,
                       const std::array<bool, 3>& periodic = {}) {
  if (!(radius > 0) || !std::isfinite(radius)) {
    throw parameter_error("radius", short_number(radius), "a finite number above 0");
  }
  if (cells[0] == 0 || cells[1] == 0 || cells[2] == 0) {
    throw parameter_error("cells", "0 along an axis", "at least 1 along each");
  }
  const auto cell = cell_of(kind);
  packing p;
  p.periodic = periodic;
  p.grains.reserve(cells[0] * cells[1] * cells[2] * cell.sites.size());
  vec3<double> outermost{};
  for (std::size_t x = 0; x < cells[0]; ++x) {
    for (std::size_t y = 0; y < cells[1]; ++y) {
      for (std::size_t z = 0; z < cells[2]; ++z) {
        for (const auto& site : cell.sites) {
          const vec3<double> at{(static_cast<double>(x) + site.x) * cell.size.x * radius,
                                (static_cast<double>(y) + site.y) * cell.size.y * radius,
                                (static_cast<double>(z) + site.z) * cell.size.z * radius};
          p.grains.push_back({at, radius});
          for (std::size_t k = 0; k < 3; ++k) {
            outermost[k] = std::max(outermost[k], at[k]);
          }
        }
      }
    }
  }
  box b{};
  for (std::size_t k = 0; k < 3; ++k) {
    b.lo[k] = periodic[k] ? 0.0 : -radius;
    b.hi[k] = periodic[k] ? static_cast<double>(cells[k]) * cell.size[k] * radius : outermost[k] + radius;
  }
  p.bounds = b;
  return p;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
