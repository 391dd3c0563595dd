// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/error.hpp"
#include "tetrapore/lbm/lattice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// \file
/// The nodes of a lattice that hold fluid, and where the populations that leave each of them arrive.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

enum class site_kind : std::uint8_t {
  fluid,
  solid,      ///< a wall: populations come back; its tag says which, and so which density it shows
  reservoir,  ///< fluid of given densities; its tag says which reservoir
  image       ///< beyond a mirror that no face of the box is: populations come back, ψ is that of the mirrored point
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

  /// What the mirrored point of an image shows: a share of each of up to 8 places, which may be walls but no images.
  struct share {
    std::array<int, 3> place;
    double weight;
  };
  struct image_point {
    std::array<share, 8> shares;
    std::size_t count = 0;
  };
  struct no_images {
    [[nodiscard]] image_point operator()(int, int, int) const noexcept { return {}; }
  };

  /// `kind(x, y, z)` says what stands where, `image(x, y, z)` what the mirrored point of an image shows. Throws
  /// parameter_error for a box without fluid, with more nodes than an index holds, or periodic on one side of an axis
  /// only.
  template <class Kind, class Image = no_images>
    requires std::convertible_to<std::invoke_result_t<Kind&, int, int, int>, site> &&
             std::convertible_to<std::invoke_result_t<Image&, int, int, int>, image_point>
  site_map(const lattice_box& box, Kind kind, Image image = {}) : box_(box) {
    check();
    const auto volume = count(0) * count(1) * count(2);
    what_.resize(volume);
    index_.assign(volume, none);
    std::size_t cell = 0;
    for (int x = 0; x < box.size[0]; ++x) {
      for (int y = 0; y < box.size[1]; ++y) {
        for (int z = 0; z < box.size[2]; ++z, ++cell) {
          what_[cell] = kind(x, y, z);
          if (what_[cell].kind == site_kind::fluid || what_[cell].kind == site_kind::reservoir) {
            index_[cell] = static_cast<std::int32_t>(places_.size());
            places_.push_back({x, y, z});
          }
        }
      }
    }
    if (places_.empty()) {
      throw parameter_error("lattice", "no fluid node", "at least one");
    }
    gather_images(image);
  }

  [[nodiscard]] const lattice_box& box() const noexcept { return box_; }
  [[nodiscard]] std::size_t size() const noexcept { return places_.size(); }
  [[nodiscard]] std::size_t plane_count() const noexcept { return count(0); }
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

  /// What a node sees in direction k: a node, an image, or the tag of a wall.
  struct sight {
    std::int32_t node;
    std::int32_t image;
    std::uint8_t wall;
  };
  [[nodiscard]] sight seen(std::size_t node, int k) const noexcept {
    const beyond b = look(node, k);
    return {b.node, b.image, b.wall};
  }

  /// What an image shows: Σ weight × ψ of nodes and walls.
  struct image_source {
    std::int32_t node;  ///< `none`: the wall
    std::uint8_t wall;
    double weight;
  };
  struct image_of_nodes {
    std::array<image_source, 8> from;
    std::size_t count;
    int last_plane;  ///< x of the last plane it needs
    int first_user;  ///< x of the first plane whose nodes see it
  };
  [[nodiscard]] const std::vector<image_of_nodes>& images() const noexcept { return images_; }

 private:
  struct beyond {
    std::int32_t node;
    std::int32_t image;
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
        case face_kind::wall: return {none, none, 0, opposite(k)};
      }
    }
    const std::size_t cell = cell_of(p);
    const int as = direction_of<L>(c[0], c[1], c[2]);
    if (what_[cell].kind == site_kind::image) {
      return {none, index_[cell], 0, as};
    }
    return {index_[cell], none, what_[cell].tag, as};
  }

  /// Only images that a node sees are kept; `index_` of their place then counts them.
  template <class Image>
  void gather_images(Image& image) {
    for (std::size_t n = 0; n < places_.size(); ++n) {
      for (int k = 1; k < static_cast<int>(directions); ++k) {
        std::array<int, 3> p = places_[n];
        bool inside = true;
        for (std::size_t a = 0; a < 3; ++a) {
          p[a] += L::velocity[static_cast<std::size_t>(k)][a];
          inside = inside && p[a] >= 0 && p[a] < box_.size[a];
        }
        if (!inside || what_[cell_of(p)].kind != site_kind::image) {
          continue;
        }
        std::int32_t& index = index_[cell_of(p)];
        if (index == none) {
          index = static_cast<std::int32_t>(images_.size());
          images_.push_back(point_of(p, image(p[0], p[1], p[2])));
        }
        auto& of = images_[static_cast<std::size_t>(index)];
        of.first_user = std::min(of.first_user, places_[n][0]);
      }
    }
  }
  [[nodiscard]] image_of_nodes point_of(const std::array<int, 3>& p, const image_point& shows) const {
    image_of_nodes of{};
    of.count = shows.count;
    of.first_user = std::numeric_limits<int>::max();
    double whole = 0;
    for (std::size_t s = 0; s < shows.count; ++s) {
      const auto& from = shows.shares[s];
      bool inside = true;
      for (std::size_t a = 0; a < 3; ++a) {
        inside = inside && from.place[a] >= 0 && from.place[a] < box_.size[a];
      }
      if (!inside || what_[cell_of(from.place)].kind == site_kind::image) {
        throw parameter_error(image_name(p), "a mirrored point outside the fluid and its walls",
                              "shares of these alone");
      }
      const std::size_t cell = cell_of(from.place);
      of.from[s] = {index_[cell], what_[cell].tag, from.weight};
      of.last_plane = std::max(of.last_plane, from.place[0]);
      whole += from.weight;
    }
    if (!(std::abs(whole - 1) < 1e-9)) {
      throw parameter_error(image_name(p), "weights that add up to " + short_number(whole), "1");
    }
    return of;
  }
  [[nodiscard]] static std::string image_name(const std::array<int, 3>& p) {
    return "image at " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]);
  }

  lattice_box box_;
  std::vector<site> what_;
  std::vector<std::int32_t> index_;
  std::vector<std::array<int, 3>> places_;
  std::vector<image_of_nodes> images_;
};

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
