// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/network.hpp"

#include <stdexcept>
#include <utility>
#include <vector>

/// \file
/// Networks that are graphs only, for algorithms that never look at the geometry.

/// A pore of a graph: its void volume and the walls it touches (at most 3).
struct graph_pore {
  double void_volume = 1;
  std::vector<tetrapore::face> walls{};
};

/// A network of the given pores and links; at most four links per pore. Throat k is link k.
[[nodiscard]] inline tetrapore::network graph_network(const std::vector<graph_pore>& pores,
                                                      const std::vector<std::pair<std::size_t, std::size_t>>& links,
                                                      std::uint64_t epoch = 0) {
  using namespace tetrapore;
  network_arrays a;
  a.region = walled({{0, 0, 0}, {1, 1, 1}});
  a.grains = {{{0, 0, 0}, 0.1}, {{1, 0, 0}, 0.1}, {{0, 1, 0}, 0.1}, {{0, 0, 1}, 0.1}};
  std::vector<std::size_t> used(pores.size(), 0);
  for (const graph_pore& p : pores) {
    std::array<vertex, 4> v;
    for (std::size_t k = 0; k < 4; ++k) {
      v[k] = vertex(grain_id(k));
    }
    for (std::size_t k = 0; k < p.walls.size(); ++k) {
      v.at(4 - p.walls.size() + k) = vertex(p.walls[k]);
    }
    a.pore_vertices.push_back(v);
    a.pore_throats.push_back({});
    a.power_centres.push_back({0, 0, 0});
    a.volumes.push_back(2 * p.void_volume);
    a.void_volumes.push_back(p.void_volume);
  }
  for (std::size_t t = 0; t < links.size(); ++t) {
    const auto& [i, j] = links[t];
    const std::size_t si = used.at(i)++;
    const std::size_t sj = used.at(j)++;
    a.pore_throats[i].at(si) = throat_id(t);
    a.pore_throats[j].at(sj) = throat_id(t);
    a.throat_pores.push_back({pore_id(i), pore_id(j)});
    a.throat_slots.push_back(static_cast<std::uint8_t>(si | (sj << 2U)));
  }
  return network(std::move(a), epoch);
}
