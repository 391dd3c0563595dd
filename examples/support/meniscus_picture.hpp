// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/png.hpp"
#include "tetrapore/lbm/ring_experiment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

/// \file
/// A picture of the gas on its way through a throat: the prism cut open along its axis and seen from above; grains
/// grey, liquid blue, gas left out. One panel for each moment, side by side.

namespace support {

class meniscus_picture {
 public:
  using vec = tetrapore::vec3<double>;

  /// Remembers the fluids of an experiment as they are now.
  template <class Experiment>
  void add(const Experiment& e) {
    panel p;
    const auto& t = e.throat();
    double x = 0;
    double y = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto g = t.grain(k);
      x = std::max(x, g.centre.x);
      y = std::max(y, g.centre.y);
      low_x_ = k == 0 ? g.centre.x : std::min(low_x_, g.centre.x);
      grains_[k] = {vec{g.centre.x, g.centre.y, t.middle()}, g.radius};
    }
    low_x_ = std::floor(low_x_);
    double most = -1;  // the axis is where most room is between the grains
    for (double i = low_x_; i < x; i += 0.5) {
      for (double j = 0; j < y; j += 0.5) {
        double room = t.in_prism({i, j}) ? x : -1;
        for (const ball& g : grains_) {
          room = std::min(room, std::hypot(i - g.centre.x, j - g.centre.y) - g.radius);
        }
        if (room > most) {
          most = room;
          axis_ = i;
        }
      }
    }
    p.size = {static_cast<int>(x - low_x_) + 2, static_cast<int>(y) + 2, t.box().size[2]};
    for (int i = 0; i < p.size[0]; ++i) {
      for (int j = 0; j < p.size[1]; ++j) {
        const tetrapore::vec2<double> at{i + low_x_, static_cast<double>(j)};
        for (int k = 0; k < p.size[2]; ++k) {
          const double d = t.in_prism(at) ? e.difference_at({at.x, at.y, static_cast<double>(k)}) : outside;
          p.values.push_back(static_cast<float>(std::isfinite(d) ? d : -1));
        }
      }
    }
    panels_.push_back(std::move(p));
  }
  [[nodiscard]] std::size_t panels() const noexcept { return panels_.size(); }

  [[nodiscard]] picture draw() const {
    const panel& first = panels_.front();
    const vec right{std::cos(turn), std::sin(turn), 0};
    const vec into{-std::sin(turn) * std::cos(rise), std::cos(turn) * std::cos(rise), -std::sin(rise)};
    const vec up{-std::sin(turn) * std::sin(rise), std::cos(turn) * std::sin(rise), std::cos(rise)};
    const vec middle{low_x_ + first.size[0] / 2.0, first.size[1] / 2.0, first.size[2] / 2.0};
    const double reach = norm(vec{first.size[0] / 2.0, first.size[1] / 2.0, first.size[2] / 2.0}) + 1;
    const double pixel = 2 * reach / width;
    picture out(static_cast<std::uint32_t>(width * panels_.size()), width);
    for (std::size_t k = 0; k < panels_.size(); ++k) {
      for (std::size_t v = 0; v < width; ++v) {
        for (std::size_t u = 0; u < width; ++u) {
          const double across = (static_cast<double>(u) + 0.5 - width / 2.0) * pixel;
          const double high = (width / 2.0 - static_cast<double>(v) - 0.5) * pixel;
          out.at(k * width + u, v) =
              trace(panels_[k], middle + right * across + up * high - into * reach, into, 2 * reach);
        }
      }
    }
    return out;
  }

 private:
  static constexpr std::size_t width = 360;  ///< of a panel [pixels]
  static constexpr double turn = 1.95;       ///< of the eye about the vertical [rad]
  static constexpr double rise = 0.40;       ///< of the eye above the horizontal [rad]
  static constexpr double outside = 9;       ///< in place of a difference of densities

  struct panel {
    std::array<int, 3> size;
    std::vector<float> values;
  };
  struct ball {
    vec centre;
    double radius;
  };

  /// The difference of densities between the nodes; `outside` beyond the prism.
  [[nodiscard]] double value(const panel& p, const vec& at) const noexcept {
    if (at.x > axis_) {  // cut away
      return outside;
    }
    const double q[3] = {at.x - low_x_, at.y, at.z};
    int low[3];
    double share[3];
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = static_cast<int>(std::floor(q[a]));
      share[a] = q[a] - low[a];
      if (low[a] < 0 || low[a] + 1 >= p.size[a]) {
        return outside;
      }
    }
    double sum = 0;
    for (int c = 0; c < 8; ++c) {
      double w = 1;
      std::size_t index = 0;
      for (std::size_t a = 0; a < 3; ++a) {
        const bool high = (c >> a & 1) != 0;
        w *= high ? share[a] : 1 - share[a];
        index = index * static_cast<std::size_t>(p.size[a]) + static_cast<std::size_t>(low[a] + (high ? 1 : 0));
      }
      const double v = static_cast<double>(p.values[index]);
      if (v == outside) {
        return outside;
      }
      sum += w * v;
    }
    return sum;
  }

  [[nodiscard]] rgb trace(const panel& p, vec at, const vec& into, double length) const {
    constexpr double step = 0.3;
    const vec light = vec{0.7, -0.3, 0.8} / norm(vec{0.7, -0.3, 0.8});
    bool before = false;  // the last place was in the prism
    for (double way = 0; way < length; way += step, at = at + into * step) {
      const double here = value(p, at);
      if (here == outside) {
        before = false;
        continue;
      }
      for (const ball& g : grains_) {
        const vec out = at - g.centre;
        if (norm(out) < g.radius) {
          const double shade = before ? 0.55 + 0.45 * std::max(0.0, dot(out, light) / norm(out)) : 0.72;
          return tint({0.90, 0.87, 0.82}, shade);
        }
      }
      if (here < 0) {
        const vec slope{value(p, at + vec{1, 0, 0}) - value(p, at - vec{1, 0, 0}),
                        value(p, at + vec{0, 1, 0}) - value(p, at - vec{0, 1, 0}),
                        value(p, at + vec{0, 0, 1}) - value(p, at - vec{0, 0, 1})};
        const double steep = norm(slope);
        const double shade =
            before && steep > 0 && steep < 4 ? 0.5 + 0.5 * std::max(0.0, dot(slope, light) / steep) : 0.62;
        return tint({0.30, 0.58, 0.92}, shade);
      }
      before = true;
    }
    return {};
  }
  [[nodiscard]] static rgb tint(const vec& colour, double shade) {
    const auto byte = [&](double x) {
      return static_cast<std::uint8_t>(std::lround(255 * std::clamp(x * shade, 0.0, 1.0)));
    };
    return {byte(colour.x), byte(colour.y), byte(colour.z)};
  }

  std::vector<panel> panels_;
  std::array<ball, 3> grains_{};
  double low_x_ = 0;
  double axis_ = 0;
};

}  // namespace support
