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
#include <vector>

/// \file
/// The nodes of a straight tube whose section is a convex polygon, closed by a mirror at either end.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// Tag of a tube's walls.
inline constexpr std::uint8_t tube_wall = 1;

/// How a tube is laid on a lattice. \par Units  nodes but where said
struct tube_resolution {
  double nodes_per_length = 1;       ///< nodes per unit of length of the polygon
  double retraction = 0;             ///< by how much its walls are moved out: room for the film on them
  double length = 0;                 ///< of the tube
  std::size_t most_nodes = 1000000;  ///< fluid nodes that are allowed
};

/// The polygon whose sides are moved out by a length. \par Domain  lines alone
[[nodiscard]] inline opening<double> moved_out(opening<double> o, double by) noexcept {
  for (std::size_t k = 0; k < o.count; ++k) {
    auto& side = o.sides[k];
    side.point = side.point - side.normal * (by / norm(side.normal));
  }
  return o;
}

/// A tube along z between mirrors. A polygon that is its own mirror image in a line along x or y is cut there, a mirror
/// in its place.
/// Nodes are taken from the middle outward until a section has as many as the retracted polygon has area.
/// \par Domain  openings of three or more lines, counter-clockwise, around a bounded convex polygon
class tube_on_lattice {
 public:
  /// Throws parameter_error for an opening with discs, one that is not bounded, or a lattice that leaves no room.
  tube_on_lattice(const opening<double>& o, const tube_resolution& r) : resolution_(r), count_(o.count) {
    if (o.count < 3 || o.count > opening<double>::max_sides) {
      throw parameter_error("tube", std::to_string(o.count) + " sides", "3 to 8 lines");
    }
    if (!(r.nodes_per_length > 0) || !(r.retraction >= 0) || !(r.length >= 4)) {
      throw parameter_error("tube", "a resolution of " + short_number(r.nodes_per_length) + " nodes",
                            "nodes above 0, a length of 4 or more, a retraction of 0 or more");
    }
    for (std::size_t k = 0; k < count_; ++k) {
      const auto& side = o.sides[k];
      const double length = norm(side.normal);
      if (side.kind != side_kind::line || !(length > 0)) {
        throw parameter_error("tube", "a grain as side " + std::to_string(k), "lines alone");
      }
      inward_[k] = side.normal * (1 / length);
      offset_[k] = -dot(inward_[k], side.point) * r.nodes_per_length;
    }
    find_corners();
    lay();
  }

  [[nodiscard]] const lattice_box& box() const noexcept { return box_; }

  template <lattice L>
  [[nodiscard]] site_map<L> sites() const {
    return site_map<L>(box_, [this](int x, int y, int) { return at(x, y); });
  }

  /// What stands at a node, at all heights the same.
  [[nodiscard]] site at(int x, int y) const noexcept {
    return to_walls(x, y) + resolution_.retraction < least_room_ ? site{site_kind::solid, tube_wall} : site{};
  }

  /// By how much the walls are moved out in truth: the polygon has then the area of the nodes. \par Units  nodes
  [[nodiscard]] double retraction() const noexcept { return retraction_; }

  /// How far a node lies from the nearest wall of the polygon as it was given, negative outside. \par Units  nodes
  [[nodiscard]] double to_walls(int x, int y) const noexcept {
    const vec2<double> p = place(x, y);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < count_; ++k) {
      least = std::min(least, dot(inward_[k], p) + offset_[k]);
    }
    return least;
  }

  /// How far a node lies from the polygon whose walls are moved in by `by`, 0 inside. \par Units  nodes
  [[nodiscard]] double to_core(int x, int y, double by) const noexcept {
    const vec2<double> p = place(x, y);
    if (to_walls(x, y) >= by) {
      return 0;
    }
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < count_; ++k) {
      const vec2<double> a = meet((k + count_ - 1) % count_, k, -by);
      const vec2<double> b = meet(k, (k + 1) % count_, -by);
      const vec2<double> along = b - a;
      const double share = std::clamp(dot(p - a, along) / std::max(dot(along, along), 1e-300), 0.0, 1.0);
      least = std::min(least, norm(p - a - along * share));
    }
    return least;
  }

 private:
  [[nodiscard]] vec2<double> place(int x, int y) const noexcept { return {x + first_.x, y + first_.y}; }

  /// Where two sides meet that are moved out by `by`.
  [[nodiscard]] vec2<double> meet(std::size_t j, std::size_t k, double by) const noexcept {
    const double turn = cross(inward_[j], inward_[k]);
    const double a = -(offset_[j] + by);
    const double b = -(offset_[k] + by);
    return {(a * inward_[k].y - b * inward_[j].y) / turn, (b * inward_[j].x - a * inward_[k].x) / turn};
  }

  void find_corners() {
    double turned = 0;
    for (std::size_t k = 0; k < count_; ++k) {
      const std::size_t next = (k + 1) % count_;
      const double turn = cross(inward_[k], inward_[next]);
      if (!(turn > 1e-6)) {
        throw parameter_error("tube", "sides " + std::to_string(k) + " and " + std::to_string(next),
                              "sides of a convex polygon, counter-clockwise");
      }
      turned += std::atan2(turn, dot(inward_[k], inward_[next]));
      corner_[k] = meet(k, next, 0);
    }
    bool bounded = std::abs(turned - 2 * pi<double>) < 1e-6;
    for (std::size_t k = 0; k < count_; ++k) {  // each side has a length
      const vec2<double> along = corner_[k] - corner_[(k + count_ - 1) % count_];
      bounded = bounded && dot(along, {inward_[k].y, -inward_[k].x}) > 0;
    }
    if (!bounded) {
      throw parameter_error("tube", "sides that bound no polygon", "a convex polygon, counter-clockwise");
    }
  }

  /// The polygon is its own image in the line through the middle of its extent, along y (axis 0) or x (axis 1).
  [[nodiscard]] bool mirrored(std::size_t axis, double middle, double extent) const noexcept {
    for (std::size_t k = 0; k < count_; ++k) {
      vec2<double> image = corner_[k];
      (axis == 0 ? image.x : image.y) = 2 * middle - (axis == 0 ? image.x : image.y);
      bool found = false;
      for (std::size_t j = 0; j < count_; ++j) {
        found = found || norm(corner_[j] - image) < 1e-9 * extent;
      }
      if (!found) {
        return false;
      }
    }
    return true;
  }

  void lay() {
    std::array<double, 2> nodes{};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      double low = std::numeric_limits<double>::infinity();
      double high = -low;
      double widest = 0;  // corners move out further than sides
      for (std::size_t k = 0; k < count_; ++k) {
        const vec2<double> out = meet(k, (k + 1) % count_, resolution_.retraction);
        low = std::min(low, axis == 0 ? corner_[k].x : corner_[k].y);
        high = std::max(high, axis == 0 ? corner_[k].x : corner_[k].y);
        widest = std::max(widest, norm(out - corner_[k]));
      }
      const double middle = (low + high) / 2;
      const bool half = mirrored(axis, middle, high - low);
      // a mirror lies half a node before the first nodes
      (axis == 0 ? first_.x : first_.y) = half ? middle + 0.5 : low - resolution_.retraction - 0.5 - std::ceil(widest);
      nodes[axis] = std::ceil(high + widest - (axis == 0 ? first_.x : first_.y)) + 2;
      box_.low[axis] = half ? face_kind::mirror : face_kind::wall;
      box_.high[axis] = face_kind::wall;
    }
    box_.low[2] = box_.high[2] = face_kind::mirror;
    const double depth = std::ceil(resolution_.length) + 1;
    if (const double volume = nodes[0] * nodes[1] * depth;
        !(volume < 4 * static_cast<double>(resolution_.most_nodes))) {
      throw parameter_error(
          "tube", "a lattice of " + short_number(volume) + " nodes",
          "at most " + std::to_string(4 * resolution_.most_nodes) + ": a coarser resolution or a higher limit");
    }
    box_.size = {static_cast<int>(nodes[0]), static_cast<int>(nodes[1]), static_cast<int>(depth)};
    fit_area();
  }

  /// Area of the polygon whose sides are moved out. \par Units  nodes
  [[nodiscard]] double area(double out) const noexcept {
    double twice = 0;
    for (std::size_t k = 0; k < count_; ++k) {
      twice += cross(meet((k + count_ - 1) % count_, k, out), meet(k, (k + 1) % count_, out));
    }
    return twice / 2;
  }

  /// Rows of nodes come and go as a whole along a wall that lies along an axis; elsewhere the steps even out.
  void fit_area() {
    std::vector<double> rooms;
    for (int x = 0; x < box_.size[0]; ++x) {
      for (int y = 0; y < box_.size[1]; ++y) {
        rooms.push_back(to_walls(x, y) + resolution_.retraction);
      }
    }
    std::sort(rooms.begin(), rooms.end(), [](double a, double b) { return a > b; });
    const double copies =
        (box_.low[0] == face_kind::mirror ? 2.0 : 1.0) * (box_.low[1] == face_kind::mirror ? 2.0 : 1.0);
    const double asked = area(resolution_.retraction) / copies;
    double nodes = 0;
    double off = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < rooms.size() && rooms[k] > -1; ++k) {
      const auto inside = static_cast<double>(k);
      if (rooms[k - 1] - rooms[k] > 1e-9 && std::abs(inside - asked) < off) {  // equal rooms stay together
        off = std::abs(inside - asked);
        nodes = inside;
        least_room_ = (rooms[k - 1] + rooms[k]) / 2;
      }
    }
    double low = resolution_.retraction - 2;
    double high = resolution_.retraction + 2;
    for (int turn = 0; turn < 60; ++turn) {
      (area((low + high) / 2) < nodes * copies ? low : high) = (low + high) / 2;
    }
    retraction_ = (low + high) / 2;
  }

  tube_resolution resolution_;
  std::size_t count_;
  std::array<vec2<double>, opening<double>::max_sides> inward_{};
  std::array<double, opening<double>::max_sides> offset_{};  ///< of a place: dot(inward, place) + offset from the side
  std::array<vec2<double>, opening<double>::max_sides> corner_{};
  vec2<double> first_{};  ///< the place of the node 0 0
  lattice_box box_;
  double least_room_ = 0;  ///< of a fluid node: its distance from the retracted walls
  double retraction_ = 0;
};

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
