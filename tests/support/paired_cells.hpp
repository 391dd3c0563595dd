// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/connect.hpp"

#include <map>
#include <set>

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
};

/// Neighbours are the two cells that name the same three grains; where flat cells lie on each other, four or more do,
/// and pair up in the order in which they are listed. A cell with negative volume is turned; flat ones stay as given.
[[nodiscard]] inline std::vector<tetrapore::cell> paired(const tetrapore::domain& region,
                                                         const std::vector<tetrapore::sphere<double>>& grains,
                                                         const std::vector<named_cell>& names) {
  using namespace tetrapore;
  std::vector<cell> cells;
  std::map<std::set<vertex>, std::pair<std::size_t, std::size_t>> open;
  for (const auto& name : names) {
    cell c;
    std::array<vec3<double>, 4> at;
    for (std::size_t k = 0; k < 4; ++k) {
      c.vertices[k] = vertex(grain_id(name.grains[k]));
      c.images[k] = name.images[k];
      at[k] = grains[name.grains[k]].centre + region.shift(name.images[k]);
    }
    if (triple(at[1] - at[0], at[2] - at[0], at[3] - at[0]) < 0) {
      std::swap(c.vertices[2], c.vertices[3]);
      std::swap(c.images[2], c.images[3]);
    }
    const std::size_t i = cells.size();
    cells.push_back(c);
    for (std::size_t k = 0; k < 4; ++k) {
      std::set<vertex> facet(c.vertices.begin(), c.vertices.end());
      facet.erase(c.vertices[k]);
      const auto [other, first] = open.try_emplace(facet, i, k);
      if (!first) {
        const auto [j, m] = other->second;
        cells[i].neighbours[k] = static_cast<std::uint32_t>(j);
        cells[j].neighbours[m] = static_cast<std::uint32_t>(i);
        open.erase(other);
      }
    }
  }
  return cells;
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
