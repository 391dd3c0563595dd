// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/connect.hpp"

#include <map>
#include <set>

/// \file
/// Networks small enough to be known by heart, made without a triangulation.

/// Finds neighbours: the two cells that name the same three vertices; where flat cells lie on each other, four or more
/// do, and pair up in the order in which they are listed. A cell with negative volume is turned; flat ones stay.
[[nodiscard]] inline std::vector<tetrapore::cell> connected(const tetrapore::domain& region,
                                                            const std::vector<tetrapore::sphere<double>>& grains,
                                                            std::vector<tetrapore::cell> cells) {
  using namespace tetrapore;
  std::map<std::set<vertex>, std::pair<std::size_t, std::size_t>> open;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cell& c = cells[i];
    const auto place = [&](std::size_t k) {
      return grains[c.vertices[k].grain().index()].centre + region.shift(c.images[k]);
    };
    const auto toward = [&](std::size_t k) {
      return c.vertices[k].is_wall() ? -region.wall(c.vertices[k].wall()).normal : place(k) - place(0);
    };
    if (triple(toward(1), toward(2), toward(3)) < 0) {
      std::swap(c.vertices[2], c.vertices[3]);
      std::swap(c.images[2], c.images[3]);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      std::set<vertex> facet(c.vertices.begin(), c.vertices.end());
      facet.erase(c.vertices[k]);
      const auto [other, first] = open.try_emplace(facet, i, k);
      if (!first) {
        const auto [j, m] = other->second;
        c.neighbours[k] = static_cast<std::uint32_t>(j);
        cells[j].neighbours[m] = static_cast<std::uint32_t>(i);
        open.erase(other);
      }
    }
  }
  return cells;
}

/// Cells given by their vertices alone. Volumes, void volumes and power centres are made up from the index of the cell.
[[nodiscard]] inline tetrapore::network network_of(const tetrapore::domain& region,
                                                   std::vector<tetrapore::sphere<double>> grains,
                                                   const std::vector<std::array<tetrapore::vertex, 4>>& vertices) {
  using namespace tetrapore;
  std::vector<cell> cells;
  for (const auto& v : vertices) {
    cells.push_back({.vertices = v});
  }
  cells = connected(region, grains, std::move(cells));
  network_arrays a = connect(region, std::move(grains), std::move(cells));
  for (std::size_t i = 0; i < a.pore_vertices.size(); ++i) {
    a.power_centres.push_back({static_cast<double>(i), 0.5, -1.0});
    a.volumes.push_back(1.0 + static_cast<double>(i));
    a.void_volumes.push_back(0.25 * a.volumes.back());
  }
  return network(std::move(a), 7);
}

/// Two grains in the box [0,4] x [0,2] x [0,3]: four wedges around their axis and eight cuboids in the corners fill it.
[[nodiscard]] inline tetrapore::network two_grains_in_a_box() {
  using namespace tetrapore;
  std::vector<std::array<vertex, 4>> cells;
  for (const face y : {face::y_min, face::y_max}) {
    for (const face z : {face::z_min, face::z_max}) {
      const vertex a{grain_id(0)};
      const vertex b{grain_id(1)};
      cells.push_back({a, b, vertex(y), vertex(z)});
      cells.push_back({a, vertex(face::x_min), vertex(y), vertex(z)});
      cells.push_back({b, vertex(face::x_max), vertex(y), vertex(z)});
    }
  }
  return network_of(walled({{0, 0, 0}, {4, 2, 3}}), {{{1, 1.5, 1}, 0.4}, {{2.5, 1, 2}, 0.3}}, cells);
}

/// One tetrahedron between four grains, without a box.
[[nodiscard]] inline tetrapore::network one_tetrahedron() {
  using namespace tetrapore;
  return network_of(unbounded(), {{{0, 0, 0}, 0.1}, {{1, 0, 0}, 0.2}, {{0, 1, 0}, 0.3}, {{0, 0, 1}, 0.4}},
                    {{vertex(grain_id(0)), vertex(grain_id(1)), vertex(grain_id(2)), vertex(grain_id(3))}});
}

/// One prism between three grains and the wall z_max of the box [0,1]³.
[[nodiscard]] inline tetrapore::network one_prism() {
  using namespace tetrapore;
  return network_of(walled({{0, 0, 0}, {1, 1, 1}}), {{{0, 0, 0.5}, 0.1}, {{1, 0, 0.25}, 0.2}, {{0, 1, 0.75}, 0.3}},
                    {{vertex(grain_id(0)), vertex(grain_id(1)), vertex(grain_id(2)), vertex(face::z_max)}});
}
