// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/network.hpp"

#include <algorithm>
#include <optional>
#include <vector>

/// \file
/// Walking around an edge: the pores and throats that share a pair of neighbours.

namespace tetrapore::inline TETRAPORE_ABI {

/// A pore seen at one of its edges, with the throat through which the walk leaves it.
/// The edge joins vertices `first` and `second` of the pore; the walk leaves through the throat opposite to `behind`
/// and came (or could come) through the one opposite to `ahead`, which is a vertex of the throat it leaves by.
struct edge_cursor {
  pore_id pore;
  std::uint8_t first;
  std::uint8_t second;
  std::uint8_t behind;
  std::uint8_t ahead;
  image offset;  ///< image of this pore relative to the pore the walk began in

  [[nodiscard]] throat_id exit(const network& net) const noexcept { return net.throats(pore)[behind]; }
  [[nodiscard]] throat_id entry(const network& net) const noexcept { return net.throats(pore)[ahead]; }
  /// The same place, facing the other way.
  [[nodiscard]] edge_cursor reversed() const noexcept { return {pore, first, second, ahead, behind, offset}; }
};

/// The slot of `to` that holds the same vertex (at the same image) as slot k of `from`, across throat t.
[[nodiscard]] inline std::uint8_t matching_slot(const network& net, pore_id from, std::size_t k, pore_id to,
                                                image to_offset) noexcept {
  const vertex v = net.vertices(from)[k];
  for (std::uint8_t j = 0; j < 4; ++j) {
    if (net.vertices(to)[j] == v && (v.is_wall() || net.image_of(to, j) + to_offset == net.image_of(from, k))) {
      return j;
    }
  }
  return 4;
}

/// Steps around the edge into the next pore; empty when the throat is a boundary.
[[nodiscard]] inline std::optional<edge_cursor> next_around(const network& net, const edge_cursor& at) noexcept {
  const throat_id t = at.exit(net);
  if (!t.valid() || net.is_boundary(t)) {
    return std::nullopt;
  }
  // A pore of a small periodic box can be its own neighbour: the side is told by pore and slot together.
  const bool from_first = net.pores(t)[0] == at.pore && net.slot(t, 0) == at.behind;
  const std::size_t side = from_first ? 1 : 0;
  const pore_id to = net.pores(t)[side];
  const image step = from_first ? net.shift(t) : image{} - net.shift(t);
  edge_cursor next{};
  next.pore = to;
  next.offset = at.offset + step;
  next.first = matching_slot(net, at.pore, at.first, to, step);
  next.second = matching_slot(net, at.pore, at.second, to, step);
  next.ahead = static_cast<std::uint8_t>(net.slot(t, side));
  TETRAPORE_EXPECTS(next.first < 4 && next.second < 4, "the two pores of a throat share its vertices");
  next.behind = static_cast<std::uint8_t>(6 - next.first - next.second - next.ahead);
  return next;
}

/// Two neighbouring vertices: the second at an image relative to the first. Grains before walls, the smaller grain
/// first.
struct vertex_pair {
  vertex first;
  vertex second;
  image at;

  [[nodiscard]] friend constexpr auto operator<=>(const vertex_pair&, const vertex_pair&) noexcept = default;
};

/// The edges of a network, each once, ascending: pairs of grains, of a grain and a wall, of two walls.
[[nodiscard]] inline std::vector<vertex_pair> edges_of(const network& net) {
  std::vector<vertex_pair> all;
  all.reserve(6 * net.pore_count());
  for (std::size_t i = 0; i < net.pore_count(); ++i) {
    const pore_id p(i);
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = a + 1; b < 4; ++b) {
        vertex u = net.vertices(p)[a];
        vertex v = net.vertices(p)[b];
        image at = v.is_wall() || u.is_wall() ? image{} : net.image_of(p, b) - net.image_of(p, a);
        const bool swap =
            (u.is_wall() && !v.is_wall()) || (u.is_wall() == v.is_wall() && v < u) || (u == v && at < image{});
        all.push_back(swap ? vertex_pair{v, u, image{} - at} : vertex_pair{u, v, at});
      }
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
