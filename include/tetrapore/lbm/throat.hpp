// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/error.hpp"
#include "tetrapore/lbm/sites.hpp"
#include "tetrapore/simplex/opening.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

/// \file
/// The nodes of a throat: the prism over the triangle of three grains' centres, less the grains, between a reservoir
/// above and one below.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// What stands behind a side of the prism.
enum class prism_side : std::uint8_t {
  mirror,  ///< the throat's own image: gas may cross the gap there
  wetting  ///< wetting liquid, as in a neighbour that is still wet
};

/// Tags of a throat's walls and reservoirs.
inline constexpr std::uint8_t grain_wall = 1;
inline constexpr std::uint8_t liquid_wall = 2;
inline constexpr std::uint8_t reservoir_below = 0;
inline constexpr std::uint8_t reservoir_above = 1;

/// How a throat is laid on a lattice.
/// \par Units  lengths in nodes but where said
struct throat_resolution {
  double nodes_per_length = 1;  ///< nodes per unit of length of the opening
  double retraction = 0;        ///< by how much each grain's radius is reduced: room for the film on it
  double above = 0;             ///< from the plane of the centres up to the reservoir
  double below = 0;
  double plug = 0;                   ///< reservoirs keep as far from grains and wetting sides: films end at a mirror
  bool halved = false;               ///< a throat that is its own mirror image is solved by one half
  bool fitted = false;               ///< radii shift so that the neck has as many nodes as it has volume, where it
                                     ///< can be told (`throat_on_lattice::fitted`)
  std::size_t most_nodes = 1000000;  ///< fluid nodes that are allowed
};

/// A throat of three grains on a lattice: x along its longest side, z along its axis. A throat with two equal grains at
/// equal distances from the third is cut along its own mirror, the two on both sides of it.
/// \par Domain  openings of three discs whose triangle is not degenerate; grains that leave fluid between them
class throat_on_lattice {
 public:
  /// Throws parameter_error for an opening of other sides than three discs or a lattice that leaves no room.
  throat_on_lattice(const opening<double>& o, const std::array<prism_side, 3>& sides, const throat_resolution& r)
      : resolution_(r) {
    if (o.count != 3) {
      throw parameter_error("throat", std::to_string(o.count) + " sides", "three grains");
    }
    std::array<vec2<double>, 3> corner;
    std::size_t longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (o.sides[k].kind != side_kind::disc) {
        throw parameter_error("throat", "a wall as side " + std::to_string(k), "three grains");
      }
      corner[k] = o.sides[k].point * r.nodes_per_length;
    }
    if (!(r.nodes_per_length > 0) || !(r.above > 0) || !(r.below > 0) || !(r.retraction >= 0)) {
      throw parameter_error("throat", "a resolution of " + short_number(r.nodes_per_length) + " nodes",
                            "nodes, above and below more than 0, a retraction of 0 or more");
    }
    const auto length_of = [&](std::size_t k) { return norm(corner[(k + 1) % 3] - corner[k % 3]); };
    for (std::size_t k = 1; k < 3; ++k) {
      longest = length_of(k) > length_of(longest) ? k : longest;
    }
    for (std::size_t k = 0; r.halved && !half_ && k < 3; ++k) {
      const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-9 * (a + b); };
      half_ = same(length_of(k + 1), length_of(k + 2)) && same(o.sides[k].radius, o.sides[(k + 1) % 3].radius) &&
              sides[(k + 1) % 3] == sides[(k + 2) % 3];
      longest = half_ ? k : longest;
    }
    first_side_ = longest;
    // the first side lies half a node below the nodes y = 0, so that its mirror is a face of the box; so does the
    // throat's own mirror behind the last nodes of x
    const vec2<double> along = corner[(longest + 1) % 3] - corner[longest];
    const double length = norm(along);
    const int across = static_cast<int>(std::ceil(half_ ? length / 2 : length)) + 1;
    const double first = half_ ? across - 0.5 - length / 2 : -0.5;
    const vec2<double> e = along * (1 / length);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t from = (longest + k) % 3;
      const vec2<double> d = corner[from] - corner[longest];
      grains_[k] = {{dot(d, e) + first, cross(e, d) - 0.5}, o.sides[from].radius * r.nodes_per_length - r.retraction};
      given_[k] = o.sides[from].radius * r.nodes_per_length;
      sides_[k] = sides[from];
      if (!(grains_[k].radius > 0)) {
        throw parameter_error("throat",
                              "a grain of " + short_number(o.sides[from].radius * r.nodes_per_length) + " nodes",
                              "more than the retraction of " + short_number(r.retraction));
      }
    }
    const double height = grains_[2].centre.y + 0.5;
    if (!(height > 1e-6 * length)) {
      throw parameter_error("throat", "centres on a line", "a triangle");
    }
    // the prism's volume: nodes are counted only where not nearly all of it can be solid
    const double volume = 0.5 * length * height * (half_ ? 0.5 : 1) * (r.above + r.below);
    if (!(volume < 32 * static_cast<double>(r.most_nodes))) {
      too_many(volume, r.most_nodes);
    }
    box_.size = {across, static_cast<int>(std::ceil(height)) + 1, static_cast<int>(std::ceil(r.above + r.below)) + 1};
    middle_ = std::round(r.below);  // nodes in the plane of the centres, and as many above as below
    box_.low = {face_kind::wall, sides_[0] == prism_side::mirror ? face_kind::mirror : face_kind::wall,
                face_kind::mirror};
    box_.high = {half_ ? face_kind::mirror : face_kind::wall, face_kind::wall, face_kind::mirror};
    fitted_ = r.fitted && fit();
    if (const std::size_t fluid = fluid_nodes(); fluid > r.most_nodes) {
      too_many(static_cast<double>(fluid), r.most_nodes);
    }
  }

  [[nodiscard]] const lattice_box& box() const noexcept { return box_; }
  /// z of the plane of the centres.
  [[nodiscard]] double middle() const noexcept { return middle_; }

  template <lattice L>
  [[nodiscard]] site_map<L> sites() const {
    return site_map<L>(
        box_, [this](int x, int y, int z) { return at(x, y, z); },
        [this](int x, int y, int z) { return image<L>(x, y, z); });
  }

  /// The throat is solved by one half, cut along its own mirror.
  [[nodiscard]] bool halved() const noexcept { return half_; }
  /// The neck has as many nodes as it has volume: it was asked for, and no grain reaches through the side opposite to
  /// it, where a grain's share of the volume would be no sector.
  [[nodiscard]] bool fitted() const noexcept { return fitted_; }

  [[nodiscard]] site at(int x, int y, int z) const noexcept {
    const vec2<double> p{static_cast<double>(x), static_cast<double>(y)};
    const double room = to_grains(x, y, z);
    if (room < 0) {
      return {site_kind::solid, grain_wall};
    }
    for (std::size_t k = half_ ? 2 : 1; k < 3; ++k) {
      if (outside(p, k) > 0) {
        return sides_[k] == prism_side::mirror ? site{site_kind::image, 0} : site{site_kind::solid, liquid_wall};
      }
    }
    if ((z == 0 || z + 1 == box_.size[2]) && !(to_walls(x, y, z) < resolution_.plug)) {
      return {site_kind::reservoir, z == 0 ? reservoir_below : reservoir_above};
    }
    return {};
  }

  /// Some node belongs to the reservoir.
  [[nodiscard]] bool has_reservoir(bool above) const noexcept {
    const int z = above ? box_.size[2] - 1 : 0;
    for (int x = 0; x < box_.size[0]; ++x) {
      for (int y = 0; y < box_.size[1]; ++y) {
        if (at(x, y, z).kind == site_kind::reservoir) {
          return true;
        }
      }
    }
    return false;
  }

  /// A grain as it was given, on the lattice.
  struct placed_grain {
    vec2<double> centre;  ///< in the plane of the centres, `middle()` above the first nodes
    double radius;        ///< not retracted
  };
  /// The grain of side k of the opening. \par Units  nodes
  [[nodiscard]] placed_grain grain(std::size_t k) const noexcept {
    return {grains_[(k + 3 - first_side_) % 3].centre, given_[(k + 3 - first_side_) % 3]};
  }
  /// Side k of the opening is the one that lies on a face of the box.
  [[nodiscard]] bool on_face(std::size_t k) const noexcept { return k == first_side_; }
  /// A place is inside the prism, the half that is left out included.
  [[nodiscard]] bool in_prism(const vec2<double>& p) const noexcept {
    return p.y >= -0.5 && outside(p, 1) <= 0 && outside(p, 2) <= 0;
  }
  /// The fluid node or wall of the box that stands for a place beside or beyond its mirrors.
  [[nodiscard]] std::array<int, 3> standing_for(int x, int y, int z) const noexcept { return nearest(x, y, z); }

  /// How far a node lies from the nearest grain, negative inside one. \par Units  nodes
  [[nodiscard]] double to_grains(int x, int y, int z) const noexcept {
    double least = std::numeric_limits<double>::infinity();
    for (const grain_section& g : grains_) {
      const vec2<double> d = vec2<double>{static_cast<double>(x), static_cast<double>(y)} - g.centre;
      const double up = z - middle_;
      least = std::min(least, std::sqrt(dot(d, d) + up * up) - g.radius);
    }
    return least;
  }
  /// How far a node inside the prism lies from the nearest grain or wetting side, negative inside a grain. A side is a
  /// plane, wherever the mirrors beside it end it. \par Units  nodes
  [[nodiscard]] double to_walls(int x, int y, int z) const noexcept {
    double least = to_grains(x, y, z);
    for (std::size_t k = 0; k < 3; ++k) {
      if (sides_[k] == prism_side::wetting) {
        least = std::min(least, -outside({static_cast<double>(x), static_cast<double>(y)}, k));
      }
    }
    return least;
  }

 private:
  struct grain_section {
    vec2<double> centre;
    double radius;
  };

  /// How far a point lies beyond side k.
  [[nodiscard]] double outside(const vec2<double>& p, std::size_t k) const noexcept {
    const vec2<double>& a = grains_[k].centre;
    const vec2<double> side = grains_[(k + 1) % 3].centre - a;
    return -cross(side, p - a) / norm(side);
  }
  [[nodiscard]] vec2<double> folded(const vec2<double>& p, std::size_t k) const noexcept {
    const vec2<double> side = grains_[(k + 1) % 3].centre - grains_[k].centre;
    const double length = norm(side);
    return p + vec2<double>{-side.y, side.x} * (2 * outside(p, k) / length);
  }
  /// The point inside the prism of which a point outside is the image.
  [[nodiscard]] vec2<double> inside(vec2<double> p) const noexcept {
    for (int turn = 0; turn < 8; ++turn) {
      bool within = true;
      if (p.y < -0.5) {
        p.y = -1 - p.y;
        within = false;
      }
      if (half_ && p.x > box_.size[0] - 0.5) {
        p.x = 2 * box_.size[0] - 1 - p.x;
        within = false;
      }
      for (std::size_t k = half_ ? 2 : 1; k < 3; ++k) {
        if (outside(p, k) > 1e-12) {
          p = folded(p, k);
          within = false;
        }
      }
      if (within) {
        break;
      }
    }
    return p;
  }

  /// Bilinear in the plane, whose mirrors stand upright, of the corners that are not beyond a mirror themselves: what
  /// would stand for such a corner lies to one side along the mirror, and pushes what sits there to the other. Without
  /// any other corner the node next to the mirrored point.
  template <lattice L>
  [[nodiscard]] typename site_map<L>::image_point image(int x, int y, int z) const noexcept {
    typename site_map<L>::image_point of;
    const vec2<double> p = inside({static_cast<double>(x), static_cast<double>(y)});
    const int left = static_cast<int>(std::floor(p.x));
    const int front = static_cast<int>(std::floor(p.y));
    const double right_share = p.x - left;
    const double back_share = p.y - front;
    double whole = 0;
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        const double weight = (i == 1 ? right_share : 1 - right_share) * (j == 1 ? back_share : 1 - back_share);
        if (weight > 1e-9 && shows(left + i, front + j, z)) {
          of.shares[of.count++] = {{left + i, front + j, z}, weight};
          whole += weight;
        }
      }
    }
    if (of.count == 0) {
      of.shares[of.count++] = {nearest(x, y, z), 1};
      return of;
    }
    for (std::size_t k = 0; k < of.count; ++k) {
      of.shares[k].weight /= whole;
    }
    return of;
  }
  /// A place is in the box and not beyond a mirror.
  [[nodiscard]] bool shows(int x, int y, int z) const noexcept {
    return x >= 0 && x < box_.size[0] && y >= 0 && y < box_.size[1] && at(x, y, z).kind != site_kind::image;
  }
  [[nodiscard]] std::array<int, 3> nearest(int x, int y, int z) const noexcept {
    if (shows(x, y, z)) {
      return {x, y, z};
    }
    const vec2<double> p = inside({static_cast<double>(x), static_cast<double>(y)});
    std::array<int, 3> best{x, y, z};
    double least = -1;
    for (int a = static_cast<int>(std::floor(p.x)) - 1; a <= static_cast<int>(std::floor(p.x)) + 2; ++a) {
      for (int b = static_cast<int>(std::floor(p.y)) - 1; b <= static_cast<int>(std::floor(p.y)) + 2; ++b) {
        const vec2<double> d{a - p.x, b - p.y};
        if (shows(a, b, z) && (least < 0 || dot(d, d) < least)) {
          least = dot(d, d);
          best = {a, b, z};
        }
      }
    }
    return best;
  }

  /// All radii shift by the same fraction of a node, at most a half, until the layers next to the plane of the centres
  /// hold as many nodes as the throat has volume there. Without it p_c has steps of 2 % at r_in of 4 nodes. False, and
  /// nothing is done, where a grain reaches through the side opposite to it.
  [[nodiscard]] bool fit() noexcept {
    double smallest = grains_[0].radius;
    double area = 0;
    std::array<double, 3> angle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const vec2<double> a = grains_[(k + 1) % 3].centre - grains_[k].centre;
      const vec2<double> b = grains_[(k + 2) % 3].centre - grains_[k].centre;
      smallest = std::min(smallest, grains_[k].radius);
      area = cross(a, b) / 2;
      angle[k] = std::atan2(cross(a, b), dot(a, b));
      if (!(cross(a, b) > grains_[k].radius * norm(b - a))) {
        return false;  // its section is no sector
      }
    }
    const int layers = std::max(1, static_cast<int>(0.3 * smallest));
    double volume = 0;
    for (int z = -layers; z <= layers; ++z) {
      volume += area;
      for (std::size_t k = 0; k < 3; ++k) {
        volume -= angle[k] / 2 * (grains_[k].radius * grains_[k].radius - z * z);
      }
    }
    const auto nodes = [&](double shift) {
      double count = 0;
      for (int x = 0; x < box_.size[0]; ++x) {
        for (int y = 0; y < box_.size[1]; ++y) {
          const vec2<double> p{static_cast<double>(x), static_cast<double>(y)};
          bool inside = true;
          for (std::size_t k = half_ ? 2 : 1; k < 3; ++k) {
            inside = inside && !(outside(p, k) > 0);
          }
          for (int z = -layers; inside && z <= layers; ++z) {
            count += to_grains(x, y, static_cast<int>(middle_) + z) < shift ? 0 : 1;
          }
        }
      }
      return half_ ? 2 * count : count;
    };
    double low = -0.5;
    double high = 0.5;
    for (int turn = 0; turn < 24; ++turn) {
      const double shift = (low + high) / 2;
      (nodes(shift) > volume ? low : high) = shift;
    }
    for (grain_section& g : grains_) {
      g.radius += (low + high) / 2;
    }
    return true;
  }

  [[nodiscard]] std::size_t fluid_nodes() const noexcept {
    std::size_t count = 0;
    for (int x = 0; x < box_.size[0]; ++x) {
      for (int y = 0; y < box_.size[1]; ++y) {
        for (int z = 0; z < box_.size[2]; ++z) {
          const site_kind kind = at(x, y, z).kind;
          count += kind == site_kind::fluid || kind == site_kind::reservoir ? 1 : 0;
        }
      }
    }
    return count;
  }
  [[noreturn]] static void too_many(double nodes, std::size_t most) {
    throw parameter_error("throat", "a lattice of " + short_number(nodes) + " nodes",
                          "at most " + std::to_string(most) + " fluid nodes: a coarser resolution or a higher limit");
  }

  throat_resolution resolution_;
  lattice_box box_;
  double middle_ = 0;
  bool half_ = false;
  bool fitted_ = false;
  std::array<grain_section, 3> grains_;
  std::array<double, 3> given_{};  ///< radii before the retraction
  std::size_t first_side_ = 0;     ///< of the opening: that on the face y = 0
  std::array<prism_side, 3> sides_{};
};

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
