// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/png.hpp"
#include "support/pore_finder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

/// \file
/// A picture of a packing and its two phases: the box seen from above a vertical edge, a quarter of it cut away. Grains
/// are opaque and grey; the fluids between them are tinted glass, on the two cut planes nearly opaque.

namespace support {

using tetrapore::face;
using tetrapore::network;
using tetrapore::pore_id;
using tetrapore::sphere;
using tetrapore::throat_id;
using vec = tetrapore::vec3<double>;

/// A linear colour, 0 to 1.
using colour = vec;

struct palette {
  colour background{1.0, 1.0, 1.0};
  colour grain{0.88, 0.86, 0.83};
  std::vector<colour> fluids;  ///< by the number that the caller gives each pore
};

struct view {
  std::uint32_t width = 1200;  ///< [pixels]; the height follows
  face up = face::y_max;       ///< the face of the box that is at the top
  double cut = 0.5;            ///< the share of each horizontal side that is cut away
  double turn = 0.60;          ///< how far the eye is turned about the vertical [rad]
  double rise = 0.50;          ///< how far the eye stands above the horizontal [rad]
  double clarity = 0.9;        ///< path through a fluid after which 1/e of what lies behind is seen [mean grain radius]
  double cap_opacity = 0.92;   ///< opacity of a fluid on a cut plane
};

/// Finds the first grain along a ray: grains in a grid of cubes.
class grain_grid {
 public:
  grain_grid(const std::vector<sphere<double>>& grains, const vec& lo, const vec& hi)
      : grains_(grains), lo_(lo), hi_(hi) {
    double mean = 0;
    for (const auto& g : grains) {
      mean += g.radius / static_cast<double>(grains.size());
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const double length = hi[k] - lo[k];
      n_[k] = static_cast<int>(std::clamp(length / (1.7 * mean), 1.0, 400.0));
      size_[k] = length / n_[k];
    }
    begin_.assign(
        static_cast<std::size_t>(n_[0]) * static_cast<std::size_t>(n_[1]) * static_cast<std::size_t>(n_[2]) + 1, 0);
    each_cell([&](std::size_t c, std::uint32_t) { ++begin_[c + 1]; });
    for (std::size_t c = 1; c < begin_.size(); ++c) {
      begin_[c] += begin_[c - 1];
    }
    items_.resize(begin_.back());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    each_cell([&](std::size_t c, std::uint32_t g) { items_[next[c]++] = g; });
  }

  struct hit {
    double distance;
    std::uint32_t grain;
  };

  /// The first surface that the ray enters between two distances, seen from outside.
  [[nodiscard]] std::optional<hit> first(const vec& from, const vec& direction, double begin, double end) const {
    std::array<int, 3> cell{};
    std::array<int, 3> step{};
    vec next;
    vec delta;
    const vec start = from + direction * begin;
    for (std::size_t k = 0; k < 3; ++k) {
      cell[k] = std::clamp(static_cast<int>((start[k] - lo_[k]) / size_[k]), 0, n_[k] - 1);
      step[k] = direction[k] < 0 ? -1 : 1;
      const double edge = lo_[k] + size_[k] * (cell[k] + (step[k] > 0 ? 1 : 0));
      const bool along = std::abs(direction[k]) > 1e-300;
      next[k] = along ? (edge - from[k]) / direction[k] : std::numeric_limits<double>::infinity();
      delta[k] = along ? size_[k] / std::abs(direction[k]) : std::numeric_limits<double>::infinity();
    }
    for (double at = begin; at < end;) {
      const std::size_t k = next.x < next.y ? (next.x < next.z ? 0U : 2U) : (next.y < next.z ? 1U : 2U);
      const double leave = std::min(next[k], end);
      hit best{leave, 0};
      bool found = false;
      const std::size_t c = index(cell);
      for (std::uint32_t i = begin_[c]; i < begin_[c + 1]; ++i) {
        const auto& g = grains_[items_[i]];
        const vec to = g.centre - from;
        const double along = dot(to, direction);
        const double inside = g.radius * g.radius - (norm2(to) - along * along);
        if (inside > 0) {
          const double d = along - std::sqrt(inside);
          if (d >= begin && d <= best.distance) {
            best = {d, items_[i]};
            found = true;
          }
        }
      }
      if (found) {
        return best;
      }
      at = leave;
      cell[k] += step[k];
      if (cell[k] < 0 || cell[k] >= n_[k]) {
        break;
      }
      next[k] += delta[k];
    }
    return std::nullopt;
  }

  /// A grain that contains a point.
  [[nodiscard]] std::optional<std::uint32_t> at(const vec& p) const {
    std::array<int, 3> cell{};
    for (std::size_t k = 0; k < 3; ++k) {
      cell[k] = std::clamp(static_cast<int>((p[k] - lo_[k]) / size_[k]), 0, n_[k] - 1);
    }
    const std::size_t c = index(cell);
    for (std::uint32_t i = begin_[c]; i < begin_[c + 1]; ++i) {
      const auto& g = grains_[items_[i]];
      if (norm2(p - g.centre) < g.radius * g.radius) {
        return items_[i];
      }
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] std::size_t index(const std::array<int, 3>& c) const {
    return static_cast<std::size_t>((c[2] * n_[1] + c[1]) * n_[0] + c[0]);
  }
  template <class F>
  void each_cell(F&& f) const {
    for (std::uint32_t g = 0; g < grains_.size(); ++g) {
      std::array<int, 3> from{};
      std::array<int, 3> to{};
      for (std::size_t k = 0; k < 3; ++k) {
        const double r = grains_[g].radius;
        from[k] =
            std::clamp(static_cast<int>(std::floor((grains_[g].centre[k] - r - lo_[k]) / size_[k])), 0, n_[k] - 1);
        to[k] = std::clamp(static_cast<int>(std::floor((grains_[g].centre[k] + r - lo_[k]) / size_[k])), 0, n_[k] - 1);
      }
      for (int z = from[2]; z <= to[2]; ++z) {
        for (int y = from[1]; y <= to[1]; ++y) {
          for (int x = from[0]; x <= to[0]; ++x) {
            f(index({x, y, z}), g);
          }
        }
      }
    }
  }

  const std::vector<sphere<double>>& grains_;
  vec lo_;
  vec hi_;
  std::array<int, 3> n_{};
  vec size_;
  std::vector<std::uint32_t> begin_;
  std::vector<std::uint32_t> items_;
};

/// Draws a network. `fluid[p]` is the number of the fluid in pore p, an index of palette::fluids.
class renderer {
 public:
  renderer(const network& net, const std::vector<std::uint8_t>& fluid, palette colours, const view& how)
      : net_(net),
        fluid_(fluid),
        colours_(std::move(colours)),
        how_(how),
        box_(extent_of(net)),
        grains_(visible_grains(net, box_)),
        grid_(grains_, box_.lo, box_.hi),
        pores_(net) {
    for (const auto& g : grains_) {
      scale_ += g.radius / static_cast<double>(grains_.size());
    }
    place_camera();
  }

  [[nodiscard]] picture draw() {
    picture out(how_.width, height_);
    std::vector<sample> first(out.pixels.size());
    for (std::size_t y = 0; y < height_; ++y) {
      for (std::size_t x = 0; x < how_.width; ++x) {
        first[y * how_.width + x] = trace(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
      }
    }
    for (std::size_t y = 0; y < height_; ++y) {
      for (std::size_t x = 0; x < how_.width; ++x) {
        const sample& s = first[y * how_.width + x];
        colour c = s.light;
        if (on_an_edge(first, x, y)) {  // four more rays where neighbours see different things
          for (const auto& [dx, dy] : {std::pair{0.375, 0.125}, {0.875, 0.375}, {0.625, 0.875}, {0.125, 0.625}}) {
            c += trace(static_cast<double>(x) + dx, static_cast<double>(y) + dy).light;
          }
          c = c / 5.0;
        }
        out.at(x, y) = {byte(c.x), byte(c.y), byte(c.z)};
      }
    }
    return out;
  }

 private:
  struct sample {
    colour light;
    std::uint32_t seen = 0;  ///< what was hit: changes from pixel to pixel only across edges
  };

  static tetrapore::box extent_of(const network& net) {
    tetrapore::box b = net.region().bounds;
    for (const face f : tetrapore::all_faces) {
      if (net.region().at(f) == tetrapore::boundary::open) {  // to the outermost centre: the hull ends there
        const std::size_t k = axis_of(f);
        double& end = is_max(f) ? b.hi[k] : b.lo[k];
        end = net.grains()[0].centre[k];
        for (const auto& g : net.grains()) {
          end = is_max(f) ? std::max(end, g.centre[k]) : std::min(end, g.centre[k]);
        }
      }
    }
    return b;
  }

  /// The grains of the network, and their periodic images that reach into the box.
  static std::vector<sphere<double>> visible_grains(const network& net, const tetrapore::box& b) {
    std::vector<sphere<double>> out;
    const auto range = [&](std::size_t axis) { return net.region().is_periodic(axis) ? 1 : 0; };
    for (int x = -range(0); x <= range(0); ++x) {
      for (int y = -range(1); y <= range(1); ++y) {
        for (int z = -range(2); z <= range(2); ++z) {
          const vec shift = net.region().shift(
              {static_cast<std::int8_t>(x), static_cast<std::int8_t>(y), static_cast<std::int8_t>(z)});
          for (sphere<double> g : net.grains()) {
            g.centre += shift;
            bool inside = true;
            for (std::size_t k = 0; k < 3; ++k) {
              inside = inside && g.centre[k] + g.radius > b.lo[k] && g.centre[k] - g.radius < b.hi[k];
            }
            if (inside) {
              out.push_back(g);
            }
          }
        }
      }
    }
    return out;
  }

  void place_camera() {
    up_axis_ = axis_of(how_.up);
    a_ = (up_axis_ + 1) % 3;
    b_ = (up_axis_ + 2) % 3;
    const double s = is_max(how_.up) ? 1.0 : -1.0;
    vec eye;  // from the box to the eye; right-handed whichever axis is up
    eye[a_] = std::cos(how_.rise) * std::cos(how_.turn);
    eye[b_] = std::cos(how_.rise) * std::sin(how_.turn);
    eye[up_axis_] = s * std::sin(how_.rise);
    vec top;
    top[up_axis_] = s;
    direction_ = -eye;
    right_ = cross(top, eye);
    right_ = right_ / norm(right_);
    upward_ = cross(eye, right_);
    notch_ = box_;
    notch_.lo[a_] = box_.hi[a_] - how_.cut * (box_.hi[a_] - box_.lo[a_]);
    notch_.lo[b_] = box_.hi[b_] - how_.cut * (box_.hi[b_] - box_.lo[b_]);
    // The picture is as large as what is left of the box: the corners of the plan but the one that is cut away.
    constexpr double far = std::numeric_limits<double>::infinity();
    vec lo{far, far, far};
    vec hi{-far, -far, -far};
    for (const double u : {box_.lo[up_axis_], box_.hi[up_axis_]}) {
      for (const auto& [a, b] : {std::pair{box_.lo[a_], box_.lo[b_]},
                                 {box_.hi[a_], box_.lo[b_]},
                                 {box_.lo[a_], box_.hi[b_]},
                                 {box_.hi[a_], notch_.lo[b_]},
                                 {notch_.lo[a_], box_.hi[b_]}}) {
        vec c;
        c[a_] = a;
        c[b_] = b;
        c[up_axis_] = u;
        const vec seen{dot(c, right_), dot(c, upward_), dot(c, direction_)};
        for (std::size_t k = 0; k < 3; ++k) {
          lo[k] = std::min(lo[k], seen[k]);
          hi[k] = std::max(hi[k], seen[k]);
        }
      }
    }
    const double margin = 0.02 * (hi.x - lo.x);
    pixel_ = (hi.x - lo.x + 2 * margin) / how_.width;
    height_ = static_cast<std::uint32_t>((hi.y - lo.y + 2 * margin) / pixel_);
    depth_ = hi.z - lo.z;
    corner_ = right_ * (lo.x - margin) + upward_ * (hi.y + margin) + direction_ * (lo.z - depth_);
    light_ = 0.45 * eye + 0.75 * top + 0.55 * right_;
    light_ = light_ / norm(light_);
  }

  struct span {
    double begin;
    double end;
    std::size_t axis;  ///< of the face by which the ray enters
  };
  [[nodiscard]] std::optional<span> through(const tetrapore::box& b, const vec& from) const {
    span s{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), 0};
    for (std::size_t k = 0; k < 3; ++k) {
      const double one = (b.lo[k] - from[k]) / direction_[k];
      const double two = (b.hi[k] - from[k]) / direction_[k];
      if (std::min(one, two) > s.begin) {
        s.begin = std::min(one, two);
        s.axis = k;
      }
      s.end = std::min(s.end, std::max(one, two));
    }
    return s.begin < s.end ? std::optional(s) : std::nullopt;
  }

  [[nodiscard]] sample trace(double x, double y) {
    const vec from = corner_ + right_ * (x * pixel_) - upward_ * (y * pixel_);
    auto way = through(box_, from);
    if (!way) {
      return {colours_.background, 0};
    }
    bool cap = false;
    vec normal;
    normal[way->axis] = direction_[way->axis] < 0 ? 1 : -1;
    if (const auto hole = through(notch_, from)) {
      const double margin = 1e-9 * depth_;
      if (hole->begin <= way->begin + margin) {
        if (hole->end >= way->end - margin) {
          return {colours_.background, 0};  // down through the notch and out of the box
        }
        way->begin = hole->end;
        cap = true;
        const vec p = from + direction_ * way->begin;
        const std::size_t k = std::abs(p[a_] - notch_.lo[a_]) < std::abs(p[b_] - notch_.lo[b_]) ? a_ : b_;
        normal = {};
        normal[k] = 1;
      }
    }
    const vec start = from + direction_ * (way->begin + 1e-7 * scale_);
    if (const auto cut = grid_.at(start)) {  // the inside of a grain: flat, a little darker to its rim
      const auto& g = grains_[*cut];
      const double rim = norm(start - g.centre) / g.radius;
      const double flat = 0.78 + 0.26 * std::max(0.0, dot(normal, light_));
      return {colours_.grain * (flat * (cap ? 1.04 - 0.20 * std::pow(rim, 6) : 0.9)), 2 * *cut + 2};
    }
    const auto hit = grid_.first(from, direction_, way->begin, way->end);
    const double end = hit ? hit->distance : way->end;
    colour behind = colours_.background;
    sample out{{}, hit ? 2 * hit->grain + 3 : 1};
    if (hit) {
      const auto& g = grains_[hit->grain];
      const vec n = (from + direction_ * end - g.centre) / g.radius;
      const double diffuse = std::max(0.0, dot(n, light_));
      const double facing = std::max(0.0, -dot(n, direction_));
      const double shine = std::pow(std::max(0.0, dot(n, light_ - direction_) / norm(light_ - direction_)), 40);
      const double buried = std::exp(-(end - way->begin) / (5 * scale_));  // little light reaches the depth
      behind = colours_.grain * ((0.52 + 0.56 * diffuse) * (0.70 + 0.30 * facing) * (0.40 + 0.60 * buried)) +
               colour{1, 1, 1} * (0.10 * shine * buried);
    }
    // The fluids before it, sampled from the eye on.
    double clear = 1;
    const double length = end - way->begin;
    const auto steps = static_cast<std::size_t>(std::clamp(length / (0.35 * scale_), 1.0, 12.0)) + 1;
    for (std::size_t i = 0; i < steps && clear > 0.02; ++i) {
      const double t = (static_cast<double>(i) + 0.5) / static_cast<double>(steps);
      const auto pore = pores_.at(i == 0 && cap ? start : from + direction_ * (way->begin + t * length));
      if (!pore) {
        continue;
      }
      const std::uint8_t fluid = fluid_[pore->index()];
      double opacity = 1 - std::exp(-length / static_cast<double>(steps) / (how_.clarity * scale_));
      double shade = 0.92;
      if (i == 0) {
        out.seen = out.seen * 8U + fluid;
        if (cap) {
          opacity = how_.cap_opacity;
          shade = 0.82 + 0.26 * std::max(0.0, dot(normal, light_));
        }
      }
      out.light += colours_.fluids[fluid] * (clear * opacity * shade);
      clear *= 1 - opacity;
    }
    out.light += behind * clear;
    return out;
  }

  [[nodiscard]] bool on_an_edge(const std::vector<sample>& all, std::size_t x, std::size_t y) const {
    const auto seen = [&](std::size_t i, std::size_t j) { return all[j * how_.width + i].seen; };
    const std::uint32_t mine = seen(x, y);
    return (x > 0 && seen(x - 1, y) != mine) || (x + 1 < how_.width && seen(x + 1, y) != mine) ||
           (y > 0 && seen(x, y - 1) != mine) || (y + 1 < height_ && seen(x, y + 1) != mine);
  }

  static std::uint8_t byte(double x) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(x, 0.0, 1.0))); }

  const network& net_;
  const std::vector<std::uint8_t>& fluid_;
  palette colours_;
  view how_;
  tetrapore::box box_;
  std::vector<sphere<double>> grains_;
  grain_grid grid_;
  pore_finder pores_;
  double scale_ = 0;
  std::size_t up_axis_ = 1;
  std::size_t a_ = 2;
  std::size_t b_ = 0;
  vec direction_;
  vec right_;
  vec upward_;
  vec corner_;  ///< of the picture, top left, before the box
  std::uint32_t height_ = 0;
  vec light_;
  double depth_ = 0;
  double pixel_ = 0;
  tetrapore::box notch_{};
};

}  // namespace support
