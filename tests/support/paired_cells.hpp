// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/small_networks.hpp"

#include <array>
#include <vector>

/// \file
/// Cells written down by hand, flat ones among them.

/// A cell by its grains and their images.
struct named_cell {
  std::array<std::size_t, 4> grains;
  std::array<tetrapore::image, 4> images{};

  /// The same cell kept at another image.
  [[nodiscard]] named_cell moved(tetrapore::image by) const {
    named_cell c = *this;
    for (auto& at : c.images) {
      at = at + by;
    }
    return c;
  }
  operator tetrapore::cell() const {
    tetrapore::cell c{.images = images};
    for (std::size_t k = 0; k < 4; ++k) {
      c.vertices[k] = tetrapore::vertex(tetrapore::grain_id(grains[k]));
    }
    return c;
  }
};

[[nodiscard]] inline std::vector<tetrapore::cell> paired(const tetrapore::domain& region,
                                                         const std::vector<tetrapore::sphere<double>>& grains,
                                                         const std::vector<named_cell>& names) {
  return connected(region, grains, {names.begin(), names.end()});
}

/// A square pyramid of height 2 on a square pyramid of height 3 that hangs from the same square. A pyramid is two
/// tetrahedra on both sides of one diagonal of the square; where the two pyramids take different diagonals, the square
/// itself is a flat cell between them.
struct two_pyramids {
  enum grain : std::size_t { a, b, c, d, top, bottom };

  tetrapore::domain region = tetrapore::unbounded();
  double unit = 1.0;
  std::array<double, 6> radii{0.1, 0.1, 0.1, 0.1, 0.1, 0.1};
  tetrapore::vec3<double> middle;  ///< of the square

  static constexpr named_cell upper_d{{a, c, d, top}};
  static constexpr named_cell upper_b{{a, b, c, top}};
  static constexpr named_cell lower_a{{a, b, d, bottom}};
  static constexpr named_cell lower_c{{b, c, d, bottom}};
  static constexpr named_cell lower_b{{a, b, c, bottom}};
  static constexpr named_cell lower_d{{a, c, d, bottom}};
  static constexpr named_cell flat{{b, a, c, d}};         ///< diagonal a-c above, b-d below; its first facet looks up
  static constexpr named_cell flat_turned{{a, b, d, c}};  ///< the same, its first facet looks down
  static constexpr named_cell flat_back{{a, b, c, d}};    ///< diagonal b-d above, a-c below; its first facet looks up

  [[nodiscard]] std::vector<tetrapore::sphere<double>> grains() const {
    std::vector<tetrapore::sphere<double>> out;
    const std::array<tetrapore::vec3<double>, 6> corners{
        {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 2}, {0, 0, -3}}};
    for (std::size_t k = 0; k < 6; ++k) {
      out.push_back({(corners[k] + middle) * unit, radii[k] * unit});
    }
    return out;
  }
  [[nodiscard]] std::vector<tetrapore::cell> cells(const std::vector<named_cell>& names) const {
    return paired(region, grains(), names);
  }
};
