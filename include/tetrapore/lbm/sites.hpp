// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/error.hpp"
#include "tetrapore/lbm/lattice.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

/// \file
/// The nodes of a lattice that hold fluid, and where the populations that leave each of them arrive.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

enum class site_kind : std::uint8_t {
  fluid,
  solid,     ///< a wall: populations come back; its tag says which, and so which density it shows
  reservoir  ///< fluid of given densities; its tag says which reservoir
};

/// What stands at a node of the box.
struct site {
  site_kind kind = site_kind::fluid;
  std::uint8_t tag = 0;
};

/// What lies beyond a face of the box.
enum class face_kind : std::uint8_t {
  periodic,  ///< the other side
  mirror,    ///< the image of the box; the plane lies half a node outside the last nodes
  wall       ///< a wall half a node outside the last nodes, of tag 0
};

/// A box of nodes. \par Units  nodes
struct lattice_box {
  std::array<int, 3> size{1, 1, 1};
  std::array<face_kind, 3> low{};
  std::array<face_kind, 3> high{};
};

/// The fluid nodes of a box in the order z fastest, x slowest; nodes of one x are a plane.
///
/// What leaves a node in direction k arrives at `to` as direction `as`; at a wall it comes back to its node. Links are
/// reversible: what leaves `to` against `as` arrives at the node against k.
template <lattice L>
class site_map {
 public:
  static constexpr std::size_t directions = L::directions;
  static constexpr std::int32_t none = -1;

  struct link {
    std::int32_t to;
    std::uint8_t as;
  };

  /// `kind(x, y, z)` says what stands where. Throws parameter_error for a box without fluid, with more nodes than an
  /// index holds, or periodic on one side of an axis only.
  template <class Kind>
    requires std::convertible_to<std::invoke_result_t<Kind&, int, int, int>, site>
  site_map(const lattice_box& box, Kind kind) : box_(box) {
    check();
    const auto volume = count(0) * count(1) * count(2);
    what_.resize(volume);
    index_.assign(volume, none);
    planes_.reserve(count(0) + 1);
    std::size_t cell = 0;
    for (int x = 0; x < box.size[0]; ++x) {
      planes_.push_back(static_cast<std::int32_t>(places_.size()));
      for (int y = 0; y < box.size[1]; ++y) {
        for (int z = 0; z < box.size[2]; ++z, ++cell) {
          what_[cell] = kind(x, y, z);
          if (what_[cell].kind != site_kind::solid) {
            index_[cell] = static_cast<std::int32_t>(places_.size());
            places_.push_back({x, y, z});
          }
        }
      }
    }
    planes_.push_back(static_cast<std::int32_t>(places_.size()));
    if (places_.empty()) {
      throw parameter_error("lattice", "no fluid node", "at least one");
    }
  }

  [[nodiscard]] const lattice_box& box() const noexcept { return box_; }
  [[nodiscard]] std::size_t size() const noexcept { return places_.size(); }
  [[nodiscard]] std::size_t plane_count() const noexcept { return planes_.size() - 1; }
  [[nodiscard]] std::int32_t plane_begin(std::size_t x) const noexcept { return planes_[x]; }
  [[nodiscard]] const std::array<int, 3>& place(std::size_t node) const noexcept { return places_[node]; }
  [[nodiscard]] site at(std::size_t node) const noexcept { return what_[cell_of(places_[node])]; }

  /// The node at a place of the box; `none` where there is a wall.
  [[nodiscard]] std::int32_t node_at(int x, int y, int z) const noexcept { return index_[cell_of({x, y, z})]; }

  /// Where what leaves a node in direction k arrives.
  [[nodiscard]] link leaving(std::size_t node, int k) const noexcept {
    const beyond b = look(node, k);
    return b.node == none ? link{static_cast<std::int32_t>(node), static_cast<std::uint8_t>(opposite(k))}
                          : link{b.node, static_cast<std::uint8_t>(b.as)};
  }
  /// Where what arrives at a node in direction i has come from: the node, and in which direction it left.
  [[nodiscard]] link arriving(std::size_t node, int i) const noexcept {
    const link l = leaving(node, opposite(i));
    return {l.to, static_cast<std::uint8_t>(opposite(l.as))};
  }

  /// What a node sees in direction k: a node, or the tag of a wall.
  struct sight {
    std::int32_t node;
    std::uint8_t wall;
  };
  [[nodiscard]] sight seen(std::size_t node, int k) const noexcept {
    const beyond b = look(node, k);
    return {b.node, b.wall};
  }

 private:
  struct beyond {
    std::int32_t node;
    std::uint8_t wall;
    int as;
  };

  [[nodiscard]] std::size_t count(std::size_t axis) const noexcept { return static_cast<std::size_t>(box_.size[axis]); }
  [[nodiscard]] std::size_t cell_of(const std::array<int, 3>& p) const noexcept {
    return (static_cast<std::size_t>(p[0]) * count(1) + static_cast<std::size_t>(p[1])) * count(2) +
           static_cast<std::size_t>(p[2]);
  }

  void check() const {
    std::size_t volume = 1;
    for (std::size_t a = 0; a < 3; ++a) {
      if (box_.size[a] < 1) {
        throw parameter_error("lattice, axis " + std::to_string(a), std::to_string(box_.size[a]) + " nodes",
                              "at least 1");
      }
      if ((box_.low[a] == face_kind::periodic) != (box_.high[a] == face_kind::periodic)) {
        throw parameter_error("lattice, axis " + std::to_string(a), "one periodic face", "both faces or none");
      }
      volume *= count(a);
      if (volume > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()) / directions) {
        throw parameter_error("lattice", "more nodes than an index holds", "fewer than 2^31 populations");
      }
    }
  }

  [[nodiscard]] beyond look(std::size_t node, int k) const noexcept {
    std::array<int, 3> p = places_[node];
    auto c = L::velocity[static_cast<std::size_t>(k)];
    for (std::size_t a = 0; a < 3; ++a) {
      p[a] += c[a];
      const bool below = p[a] < 0;
      if (!below && p[a] < box_.size[a]) {
        continue;
      }
      switch (below ? box_.low[a] : box_.high[a]) {
        case face_kind::periodic: p[a] = below ? box_.size[a] - 1 : 0; break;
        case face_kind::mirror:
          p[a] -= c[a];
          c[a] = -c[a];
          break;
        case face_kind::wall: return {none, 0, opposite(k)};
      }
    }
    const std::size_t cell = cell_of(p);
    return {index_[cell], what_[cell].tag, direction_of<L>(c[0], c[1], c[2])};
  }

  lattice_box box_;
  std::vector<site> what_;
  std::vector<std::int32_t> index_;
  std::vector<std::array<int, 3>> places_;
  std::vector<std::int32_t> planes_;
};

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
