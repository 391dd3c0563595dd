// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/packing/packing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// \file
/// Close pairs of grains of any mix of sizes, images along periodic axes included.

namespace tetrapore::inline TETRAPORE_ABI {

/// Two grains, the second moved by whole box lengths.
struct close_pair {
  std::size_t i;
  std::size_t j;
  image shift;  ///< of grain j
};

/// Grains sorted into cells, one grid for each class of sizes (radii within a factor 2), so that a few large grains do
/// not make the cells of all others large. A grain looks into the grids of its own class and of the larger ones.
class size_class_grids {
 public:
  /// \param region    box of the packing; grains may lie outside
  /// \param periodic  axes along which it repeats
  /// \param reach     [m] pairs whose surfaces are closer than this are found
  /// \throw packing_error  along a periodic axis: a grain more than 50 box lengths away, or grains and reach of more
  ///                       than 20
  size_class_grids(std::span<const sphere<double>> grains, const box& region, const std::array<bool, 3>& periodic,
                   double reach)
      : grains_(grains), region_(region), periodic_(periodic), reach_(reach) {
    double largest = 0;
    for (const auto& g : grains) {
      largest = std::max(largest, g.radius);
    }
    class_of_.resize(grains.size());
    for (std::size_t i = 0; i < grains.size(); ++i) {
      std::size_t c = 0;
      for (double r = 2.0 * grains[i].radius; r <= largest && c + 1 < most_classes; r *= 2.0) {
        ++c;
      }
      class_of_[i] = static_cast<std::uint8_t>(c);
      if (grids_.size() <= c) {
        grids_.resize(c + 1);
      }
      check_place(i, largest);
      grids_[c].largest = std::max(grids_[c].largest, grains[i].radius);
      ++grids_[c].count;
    }
    for (std::size_t c = 0; c < grids_.size(); ++c) {
      fill(c);
    }
  }

  /// Calls f(pair, centre_j - centre_i) once for every close pair, in an order that depends on the grains alone.
  template <class F>
  void for_each_pair(F&& f) const {
    for (std::size_t i = 0; i < grains_.size(); ++i) {
      for (std::size_t c = 0; c <= class_of_[i]; ++c) {
        if (grids_[c].count > 0) {
          search(i, grids_[c], c == class_of_[i], f);
        }
      }
    }
  }

 private:
  static constexpr std::size_t most_classes = 24;

  struct cell_index {
    std::size_t cell;
    std::array<int, 3> lap;  ///< how many periods the place lies away from the region
  };
  struct grid {
    double largest = 0;
    std::size_t count = 0;
    std::array<std::int64_t, 3> n{1, 1, 1};
    vec3<double> width{};
    std::vector<std::uint32_t> start;
    std::vector<std::uint32_t> member;
    std::vector<std::array<std::int16_t, 3>> lap;
  };

  /// Images are counted in int8: places must be near enough for that.
  void check_place(std::size_t i, double largest) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const double length = region_.size()[k];
      const double away = std::abs(grains_[i].centre[k] - region_.lo[k]);
      if (periodic_[k] && !(away <= 50.0 * length && 2.0 * largest + reach_ <= 20.0 * length)) {
        throw packing_error("grain " + std::to_string(i),
                            "a place or a reach of " + short_number(away / length) + " and " +
                                short_number((2.0 * largest + reach_) / length) + " box lengths along " + "xyz"[k],
                            "at most 50 and 20; wrap the packing first");
      }
    }
  }

  void fill(std::size_t c) {
    auto& g = grids_[c];
    if (g.count == 0) {
      return;
    }
    const auto size = region_.size();
    double width = 2.0 * g.largest + reach_;
    const auto most = static_cast<double>(4 * g.count + 64);
    for (;;) {
      double total = 1;
      for (std::size_t k = 0; k < 3; ++k) {
        const double n = std::max(1.0, std::floor(size[k] / width));
        total *= n;
        g.n[k] = static_cast<std::int64_t>(std::min(n, most));
      }
      if (total <= most) {
        break;
      }
      width *= 1.25;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      g.width[k] = size[k] > 0 ? size[k] / static_cast<double>(g.n[k]) : width;
    }
    const auto cells = static_cast<std::size_t>(g.n[0] * g.n[1] * g.n[2]);
    g.start.assign(cells + 1, 0);
    g.member.resize(g.count);
    g.lap.resize(g.count);
    for (std::size_t i = 0; i < grains_.size(); ++i) {
      if (class_of_[i] == c) {
        ++g.start[locate(g, cells_at(g, grains_[i].centre)).cell + 1];
      }
    }
    for (std::size_t k = 0; k < cells; ++k) {
      g.start[k + 1] += g.start[k];
    }
    auto next = g.start;
    for (std::size_t i = 0; i < grains_.size(); ++i) {
      if (class_of_[i] == c) {
        const auto at = locate(g, cells_at(g, grains_[i].centre));
        const auto slot = next[at.cell]++;
        g.member[slot] = static_cast<std::uint32_t>(i);
        for (std::size_t k = 0; k < 3; ++k) {
          g.lap[slot][k] = static_cast<std::int16_t>(at.lap[k]);
        }
      }
    }
  }

  [[nodiscard]] std::array<std::int64_t, 3> cells_at(const grid& g, const vec3<double>& p) const noexcept {
    std::array<std::int64_t, 3> at{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double c = std::floor((p[k] - region_.lo[k]) / g.width[k]);
      at[k] = periodic_[k] ? static_cast<std::int64_t>(c)
                           : static_cast<std::int64_t>(std::clamp(c, 0.0, static_cast<double>(g.n[k] - 1)));
    }
    return at;
  }
  [[nodiscard]] cell_index locate(const grid& g, std::array<std::int64_t, 3> at) const noexcept {
    cell_index found{0, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      std::int64_t lap = at[k] / g.n[k];
      lap -= at[k] < lap * g.n[k] ? 1 : 0;
      found.lap[k] = static_cast<int>(lap);
      at[k] -= lap * g.n[k];
    }
    found.cell = static_cast<std::size_t>((at[0] * g.n[1] + at[1]) * g.n[2] + at[2]);
    return found;
  }

  template <class F>
  void search(std::size_t i, const grid& g, bool same_class, F& f) const {
    const auto& a = grains_[i];
    const auto home = cells_at(g, a.centre);
    const double range = a.radius + g.largest + reach_;
    std::array<std::int64_t, 3> from{};
    std::array<std::int64_t, 3> to{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto cells = static_cast<std::int64_t>(std::ceil(range / g.width[k]));
      from[k] = home[k] - cells;
      to[k] = home[k] + cells;
      if (!periodic_[k]) {
        from[k] = std::max<std::int64_t>(from[k], 0);
        to[k] = std::min(to[k], g.n[k] - 1);
      }
    }
    const auto size = region_.size();
    for (auto x = from[0]; x <= to[0]; ++x) {
      for (auto y = from[1]; y <= to[1]; ++y) {
        for (auto z = from[2]; z <= to[2]; ++z) {
          const auto at = locate(g, {x, y, z});
          for (auto s = g.start[at.cell]; s < g.start[at.cell + 1]; ++s) {
            const std::size_t j = g.member[s];
            if (same_class && j < i) {
              continue;
            }
            const std::array<int, 3> lap{at.lap[0] - g.lap[s][0], at.lap[1] - g.lap[s][1], at.lap[2] - g.lap[s][2]};
            if (j == i && lap <= std::array<int, 3>{}) {
              continue;  // a grain and its own image: once, not twice
            }
            const auto& b = grains_[j];
            const vec3<double> apart{b.centre.x - a.centre.x + lap[0] * size.x,
                                     b.centre.y - a.centre.y + lap[1] * size.y,
                                     b.centre.z - a.centre.z + lap[2] * size.z};
            const double near = a.radius + b.radius + reach_;
            if (norm2(apart) < near * near) {
              f(close_pair{i,
                           j,
                           {static_cast<std::int8_t>(lap[0]), static_cast<std::int8_t>(lap[1]),
                            static_cast<std::int8_t>(lap[2])}},
                apart);
            }
          }
        }
      }
    }
  }

  std::span<const sphere<double>> grains_;
  box region_;
  std::array<bool, 3> periodic_;
  double reach_;
  std::vector<std::uint8_t> class_of_;
  std::vector<grid> grids_;
};

/// Smallest box around the spheres. \par Units  [m]
[[nodiscard]] inline box bounding_box(std::span<const sphere<double>> grains) noexcept {
  box b{};
  bool first = true;
  for (const auto& g : grains) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double lo = g.centre[k] - g.radius;
      const double hi = g.centre[k] + g.radius;
      b.lo[k] = first ? lo : std::min(b.lo[k], lo);
      b.hi[k] = first ? hi : std::max(b.hi[k], hi);
    }
    first = false;
  }
  return b;
}

/// Calls f(close_pair, centre_j - centre_i) once for every pair of a packing whose surfaces are closer than `reach` [m]
/// (overlapping ones always). Grain j may be an image; images of grain i itself are pairs too.
template <class F>
void for_each_close_pair(const packing& p, double reach, F&& f) {
  if (!p.grains.empty()) {
    size_class_grids(p.grains, p.bounds ? *p.bounds : bounding_box(p.grains), p.periodic, reach).for_each_pair(f);
  }
}

}  // namespace tetrapore::inline TETRAPORE_ABI
