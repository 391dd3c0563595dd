// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/edges.hpp"
#include "tetrapore/network/gather.hpp"
#include "tetrapore/simplex/make_opening.hpp"

#include <array>
#include <optional>

/// \file
/// Openings gathered from a network: the section of a facet, with the names of its sides, and the facet with which it
/// shares a meniscus at one of its gaps.

namespace tetrapore::inline TETRAPORE_ABI {

/// The opening of a facet, with the vertex that each side stands for.
struct facet_opening {
  opening<double> ring;               ///< three sides; gap k lies between the vertices slots[k] and slots[k + 1]
  std::array<std::uint8_t, 3> slots;  ///< vertices of the pore from which the facet was seen
};

/// The opening of the facet opposite to vertex `slot` of pore p. Whether it is seen from inside or outside is left
/// open: an opening and its mirror image are the same to every law.
[[nodiscard]] inline facet_opening facet_opening_at(const network& net, pore_id p, std::size_t slot) noexcept {
  facet_opening out;
  std::array<std::uint8_t, 3>& f = out.slots;
  f = facet_vertices[slot];
  const auto& vertices = net.vertices(p);
  throat<double> t{};
  // Grains first, by a turn; then the smallest grain first, so that sides keep the order in which they are given.
  const auto is_wall = [&](std::size_t k) { return vertices[f[k]].is_wall(); };
  while (is_wall(0) || (is_wall(1) && !is_wall(2))) {
    f = {f[1], f[2], f[0]};
  }
  std::size_t grains = 0;
  for (; grains < 3 && !is_wall(grains); ++grains) {
    t.grains[grains] = net.grain_sphere(p, f[grains]);
  }
  for (std::size_t k = grains; k < 3; ++k) {
    t.walls[k - grains] = net.region().wall(vertices[f[k]].wall());
  }
  t.grain_count = static_cast<std::uint8_t>(grains);
  const auto smaller = [&](std::size_t i, std::size_t j) { return t.grains[i].radius < t.grains[j].radius; };
  if (grains == 3) {
    if (smaller(1, 0) && !smaller(2, 1)) {
      t.grains = {t.grains[1], t.grains[2], t.grains[0]};
      f = {f[1], f[2], f[0]};
    } else if (smaller(2, 0)) {
      t.grains = {t.grains[2], t.grains[0], t.grains[1]};
      f = {f[2], f[0], f[1]};
    }
  } else if (grains == 2 && smaller(1, 0)) {
    std::swap(t.grains[0], t.grains[1]);
    std::swap(f[0], f[1]);
  }
  out.ring = opening_of(t);
  return out;
}

/// The opening of throat t alone, as it is while every ring in its gaps holds.
[[nodiscard]] inline opening<double> opening_at(const network& net, throat_id t) noexcept {
  return facet_opening_at(net, net.pores(t)[0], net.slot(t, 0)).ring;
}

/// The same opening seen from the other side.
template <real T>
[[nodiscard]] constexpr opening<T> mirrored(const opening<T>& o) noexcept {
  opening<T> m;
  m.count = o.count;
  for (std::size_t k = 0; k < o.count; ++k) {
    const std::size_t from = o.count - 1 - k;
    m.sides[k] = o.sides[from];
    m.sides[k].point.x = -m.sides[k].point.x;
    m.sides[k].normal.x = -m.sides[k].normal.x;
    m.gaps[k] = o.gaps[o.previous(from)];
  }
  return m;
}

/// Walks around an edge from the pore of `at`, which is gas, through pores that are gas, to the facet that bounds them:
/// the exit of the cursor returned. Empty where the network ends first.
template <class IsGas>
[[nodiscard]] std::optional<edge_cursor> end_of_gas(const network& net, edge_cursor at, const IsGas& is_gas) noexcept {
  for (;;) {
    const throat_id t = at.exit(net);
    if (!t.valid() || net.is_boundary(t)) {
      return std::nullopt;
    }
    if (!is_gas(net.across(at.pore, t))) {
      return at;
    }
    const auto next = next_around(net, at);
    if (!next) {
      return std::nullopt;
    }
    at = *next;
  }
}

/// A ring of facets of the front that share one meniscus, which grows facet by facet across its gaps.
class gathered_ring {
 public:
  /// Why a ring did not grow.
  enum class growth : unsigned char {
    grown,
    no_partner,        ///< the network ends before another facet bounds the gas
    closed_on_itself,  ///< the other facet is in the ring already
    not_a_ring         ///< merging was refused: more than 8 sides
  };

  /// The facet opposite to vertex `slot` of the gas pore p.
  gathered_ring(const network& net, pore_id p, std::size_t slot) noexcept {
    const facet_opening f = facet_opening_at(net, p, slot);
    ring_ = f.ring;
    for (std::size_t k = 0; k < 3; ++k) {
      gaps_[k] = {p, f.slots[k], f.slots[(k + 1) % 3], static_cast<std::uint8_t>(slot)};
    }
    facets_[0] = net.throats(p)[slot];
    facet_count_ = 1;
  }

  [[nodiscard]] const opening<double>& ring() const noexcept { return ring_; }
  /// The edge in gap k; empty where two walls meet.
  [[nodiscard]] std::optional<edge<double>> edge_in_gap(const network& net, std::size_t k) const noexcept {
    const named_gap& g = gaps_[k];
    const auto& v = net.vertices(g.pore);
    if (v[g.first].is_wall() && v[g.second].is_wall()) {
      return std::nullopt;
    }
    return edge_at(net, g.pore, g.first, g.second);
  }
  /// The facets looked at so far: those of the ring, and last the one that could not be joined.
  [[nodiscard]] std::span<const throat_id> facets() const noexcept { return {facets_.data(), facet_count_}; }

  /// Joins the facet that bounds the gas on the other side of gap k.
  template <class IsGas>
  growth grow(const network& net, std::size_t k, const IsGas& is_gas) noexcept {
    const named_gap g = gaps_[k];
    const edge_cursor from{g.pore,  g.first, g.second, static_cast<std::uint8_t>(6 - g.first - g.second - g.facet),
                           g.facet, {}};
    const auto end = end_of_gas(net, from, is_gas);
    if (!end) {
      return growth::no_partner;
    }
    const throat_id other = end->exit(net);
    for (const throat_id t : facets()) {
      if (t == other) {
        return growth::closed_on_itself;
      }
    }
    if (facet_count_ == facets_.size()) {
      return growth::not_a_ring;
    }
    facets_[facet_count_++] = other;
    facet_opening b = facet_opening_at(net, end->pore, end->behind);
    // The shared gap is met in the opposite order.
    std::size_t gap_b = 3;
    for (int turn = 0; turn < 2 && gap_b == 3; ++turn) {
      if (turn == 1) {
        b.ring = mirrored(b.ring);
        std::swap(b.slots[0], b.slots[2]);
      }
      for (std::size_t j = 0; j < 3; ++j) {
        if (b.slots[j] == end->second && b.slots[(j + 1) % 3] == end->first) {
          gap_b = j;
        }
      }
    }
    const auto merged = merge(ring_, k, b.ring, gap_b);
    if (!merged.ok()) {
      return growth::not_a_ring;
    }
    std::array<named_gap, opening<double>::max_sides> names;
    std::size_t n = 0;
    for (std::size_t j = ring_.next(k); j != k; j = ring_.next(j)) {
      names[n++] = gaps_[j];
    }
    for (std::size_t j = (gap_b + 1) % 3; j != gap_b; j = (j + 1) % 3) {
      names[n++] = {end->pore, b.slots[j], b.slots[(j + 1) % 3], end->behind};
    }
    gaps_ = names;
    ring_ = merged.value;
    return growth::grown;
  }

 private:
  /// A gap of the ring: the edge between two vertices of a gas pore, as an edge of one of its facets.
  struct named_gap {
    pore_id pore;
    std::uint8_t first;
    std::uint8_t second;
    std::uint8_t facet;
  };

  opening<double> ring_;
  std::array<named_gap, opening<double>::max_sides> gaps_;
  std::array<throat_id, opening<double>::max_sides - 1> facets_;
  std::size_t facet_count_ = 0;
};

}  // namespace tetrapore::inline TETRAPORE_ABI
