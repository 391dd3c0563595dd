// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/connect.hpp"

#include <map>
#include <set>

/// \file
/// Networks small enough to be known by heart, made without a triangulation.

/// Cells given by their vertices alone, connected where two share three vertices; a cell whose order is negative is
/// turned. Volumes, void volumes and power centres are made up from the index of the cell.
[[nodiscard]] inline tetrapore::network network_of(const tetrapore::domain& region,
                                                   std::vector<tetrapore::sphere<double>> grains,
                                                   const std::vector<std::array<tetrapore::vertex, 4>>& vertices) {
  using namespace tetrapore;
  const auto toward = [&](vertex v, const vec3<double>& from) {
    return v.is_wall() ? -region.wall(v.wall()).normal : grains[v.grain().index()].centre - from;
  };
  std::vector<cell> cells;
  std::map<std::set<vertex>, std::pair<std::size_t, std::size_t>> open;
  for (const auto& given : vertices) {
    cell c;
    c.vertices = given;
    const vec3<double> o = grains[given[0].grain().index()].centre;
    if (triple(toward(given[1], o), toward(given[2], o), toward(given[3], o)) < 0) {
      std::swap(c.vertices[2], c.vertices[3]);
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
      }
    }
  }
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
