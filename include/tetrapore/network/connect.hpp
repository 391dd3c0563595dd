// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/gather.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

/// \file
/// From cells and their neighbours to the topology of a network.

namespace tetrapore::inline TETRAPORE_ABI {

/// A cell of any triangulation: four vertices in positive order and the cell opposite to each. A wall of the box may
/// stand for a vertex. Vertices may come in any positive order; `connect` puts the walls last.
struct cell {
  static constexpr std::uint32_t outside = 0xffffffffU;  ///< no cell beyond this facet

  std::array<vertex, 4> vertices{};
  std::array<image, 4> images{};
  std::array<std::uint32_t, 4> neighbours{outside, outside, outside, outside};
};

namespace detail {

/// Puts grains before walls by an even permutation.
inline void walls_last(cell& c) noexcept {
  bool odd = false;
  const auto exchange = [&](std::size_t i, std::size_t j) {
    std::swap(c.vertices[i], c.vertices[j]);
    std::swap(c.images[i], c.images[j]);
    std::swap(c.neighbours[i], c.neighbours[j]);
    odd = !odd;
  };
  std::size_t grains = 4;
  for (std::size_t i = 0; i < grains;) {
    if (c.vertices[i].is_wall()) {
      exchange(i, --grains);
      odd = (i == grains) ? !odd : odd;  // exchanging a vertex with itself changes nothing
    } else {
      ++i;
    }
  }
  if (odd) {
    grains >= 2 ? exchange(0, 1) : exchange(2, 3);
  }
}

[[nodiscard]] inline std::string name_of_facet(std::size_t pore, std::size_t slot) {
  return "pore " + std::to_string(pore) + ", facet " + std::to_string(slot);
}

/// Whether facet k of a and facet j of b have the same vertices when b is moved by `shift`.
[[nodiscard]] inline bool same_facet(const cell& a, std::size_t k, const cell& b, std::size_t j, image shift) noexcept {
  for (std::size_t i = 0; i < 4; ++i) {
    if (i == k) {
      continue;
    }
    bool found = false;
    for (std::size_t m = 0; m < 4 && !found; ++m) {
      found =
          m != j && b.vertices[m] == a.vertices[i] && (a.vertices[i].is_wall() || b.images[m] + shift == a.images[i]);
    }
    if (!found) {
      return false;
    }
  }
  return true;
}

struct facet_match {
  std::size_t slot = 4;
  image shift;
};

/// The facet of b that is facet k of a, and the image by which b must be moved to lie beside a.
[[nodiscard]] inline facet_match match_facet(const cell& a, std::uint32_t a_index, std::size_t k, const cell& b,
                                             bool periodic) noexcept {
  const std::size_t first = k == 0 ? 1 : 0;  // grains come first: one of the first two slots is a grain of the facet
  for (std::size_t j = 0; j < 4; ++j) {
    if (b.neighbours[j] != a_index) {
      continue;
    }
    if (!periodic) {
      if (same_facet(a, k, b, j, image{})) {
        return {j, {}};
      }
      continue;
    }
    for (std::size_t m = 0; m < 4; ++m) {
      if (m != j && b.vertices[m] == a.vertices[first] && !a.vertices[first].is_wall()) {
        const image shift = a.images[first] - b.images[m];
        if (same_facet(a, k, b, j, shift)) {
          return {j, shift};
        }
      }
    }
  }
  return {};
}

}  // namespace detail

/// Builds the topology of a network from cells: pore i is cell i; throats are numbered in the order of the cells.
/// Volumes and power centres are left to `measure`.
/// \throw network_error when a neighbour is not mutual, a facet does not match, or an index is out of range; it names
///        the cell and the facet.
[[nodiscard]] inline network_arrays connect(const domain& region, std::vector<sphere<double>> grains,
                                            std::vector<cell> cells) {
  const bool periodic = region.any_periodic();
  const std::size_t n = cells.size();
  for (std::size_t i = 0; i < n; ++i) {
    detail::walls_last(cells[i]);
    for (std::size_t k = 0; k < 4; ++k) {
      const vertex v = cells[i].vertices[k];
      if (!v.is_wall() && v.grain().index() >= grains.size()) {
        throw network_error("pore " + std::to_string(i), "vertex " + std::to_string(v.grain().index()),
                            "a grain below " + std::to_string(grains.size()));
      }
      if (v.is_wall() && !region.is_wall(v.wall())) {
        throw network_error("pore " + std::to_string(i), std::string("the wall ") + describe(v.wall()),
                            "a face that is a wall of the domain");
      }
      if (cells[i].neighbours[k] != cell::outside && cells[i].neighbours[k] >= n) {
        throw network_error(detail::name_of_facet(i, k), "neighbour " + std::to_string(cells[i].neighbours[k]),
                            "a pore below " + std::to_string(n) + ", or outside");
      }
    }
    if (cells[i].vertices[0].is_wall()) {
      throw network_error("pore " + std::to_string(i), "four walls", "at least one grain");
    }
  }

  network_arrays a;
  a.region = region;
  a.grains = std::move(grains);
  a.pore_vertices.resize(n);
  a.pore_throats.resize(n);
  a.pore_images.resize(periodic ? n : 0);
  a.throat_pores.reserve(2 * n + n / 16);
  a.throat_slots.reserve(2 * n + n / 16);
  if (periodic) {
    a.throat_shifts.reserve(2 * n + n / 16);
  }
  for (std::size_t i = 0; i < n; ++i) {
    a.pore_vertices[i] = cells[i].vertices;
    if (periodic) {
      a.pore_images[i] = cells[i].images;
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const cell& c = cells[i];
    for (std::size_t k = 0; k < 4; ++k) {
      if (a.pore_throats[i][k].valid()) {
        continue;
      }
      const std::uint32_t other = c.neighbours[k];
      const throat_id t(a.throat_pores.size());
      std::uint8_t slots = static_cast<std::uint8_t>(k);
      if (other == cell::outside) {
        const std::size_t first = k == 0 ? 1 : 0;
        if (c.vertices[first].is_wall()) {
          continue;  // three walls: the corner of the box, no throat
        }
        a.throat_pores.push_back({pore_id(i), pore_id{}});
      } else {
        const auto match = detail::match_facet(c, static_cast<std::uint32_t>(i), k, cells[other], periodic);
        if (match.slot == 4) {
          throw network_error(detail::name_of_facet(i, k),
                              "a neighbour (" + std::to_string(other) + ") without that facet",
                              "mutual neighbours that share three vertices");
        }
        if (other == i && match.slot == k) {
          throw network_error(detail::name_of_facet(i, k), "a facet that is its own neighbour", "two facets");
        }
        slots = static_cast<std::uint8_t>(slots | (match.slot << 2U));
        a.throat_pores.push_back({pore_id(i), pore_id(other)});
        a.pore_throats[other][match.slot] = t;
        if (periodic) {
          a.throat_shifts.resize(a.throat_pores.size());
          a.throat_shifts.back() = match.shift;
        }
      }
      a.throat_slots.push_back(slots);
      a.pore_throats[i][k] = t;
      if (periodic) {
        a.throat_shifts.resize(a.throat_pores.size());
      }
    }
  }
  a.throat_pores.shrink_to_fit();
  a.throat_slots.shrink_to_fit();
  a.throat_shifts.shrink_to_fit();
  return a;
}

namespace detail {

/// Names each boundary throat by the face of the box that its normal points to most.
inline void name_boundaries(network& net) noexcept {
  for (std::size_t i = 0; i < net.throat_count(); ++i) {
    const throat_id t(i);
    if (!net.is_boundary(t)) {
      continue;
    }
    const vec3<double> s = facet_at(net, t).area_vector;
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      axis = std::abs(s[k]) > std::abs(s[axis]) ? k : axis;
    }
    const auto f = static_cast<unsigned>(2 * axis + (s[axis] > 0 ? 1 : 0));
    auto& slots = net.mutable_arrays().throat_slots[i];
    slots = static_cast<std::uint8_t>((slots & 0x0fU) | (f << 4U));
  }
}

}  // namespace detail

}  // namespace tetrapore::inline TETRAPORE_ABI
