// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/connect.hpp"

#include <map>
#include <set>

/// \file
/// Networks small enough to be known by heart, made without a triangulation.

/// Cells given by their vertices alone, connected where two share three vertices; a cell whose order is negative is
/// turned. Volumes are those of the cells; void volumes and power centres are made up: 0.25 of the volume, and the index.
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

/// The box [0,4] × [0,2] × [0,3] with four grains: one tetrahedron, and all that walls can make: prisms, wedges, cuboids.
/// The cells are those of the hull of the grains joined to the walls; 1 + 4 + 6 + ... of them fill the box.
[[nodiscard]] inline tetrapore::network one_grain_in_a_box() {
  using namespace tetrapore;
  std::vector<std::array<vertex, 4>> cells;
  const vertex g{grain_id(0)};
  for (const face x : {face::x_min, face::x_max}) {
    for (const face y : {face::y_min, face::y_max}) {
      for (const face z : {face::z_min, face::z_max}) {
        cells.push_back({g, vertex(x), vertex(y), vertex(z)});
      }
    }
  }
  return network_of(walled({{0, 0, 0}, {4, 2, 3}}), {{{1, 1.5, 1}, 0.5}}, cells);
}
