// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/simplex/pore_volume.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

// Cells for tests of the pore geometry: random ones, and all cells of a small walled packing, found by trying every set
// of four vertices: no triangulation code takes part.

namespace tetrapore_test {

using namespace tetrapore;

using random_engine = std::mt19937_64;

inline double uniform(random_engine& random, double lo = 0, double hi = 1) {
  return std::uniform_real_distribution<double>(lo, hi)(random);
}

inline vec3<double> uniform_point(random_engine& random, double lo = 0, double hi = 1) {
  const double x = uniform(random, lo, hi);
  const double y = uniform(random, lo, hi);
  return {x, y, uniform(random, lo, hi)};
}

struct rotation {
  vec3<double> u, v, w;
  [[nodiscard]] vec3<double> operator()(const vec3<double>& p) const { return u * p.x + v * p.y + w * p.z; }
};

inline rotation random_rotation(random_engine& random) {
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    const double x = normal(random);
    const double y = normal(random);
    return vec3<double>{x, y, normal(random)};
  };
  vec3<double> u = direction();
  u = u / norm(u);
  vec3<double> v = cross(u, direction());
  v = v / norm(v);
  return {u, v, cross(u, v)};
}

template <class To, class From>
sphere<To> convert(const sphere<From>& s) {
  return {{static_cast<To>(s.centre.x), static_cast<To>(s.centre.y), static_cast<To>(s.centre.z)},
          static_cast<To>(s.radius)};
}

template <class To, class From>
pore_body<To> convert(const pore_body<From>& b) {
  pore_body<To> c{};
  c.grain_count = b.grain_count;
  for (std::size_t k = 0; k < b.grain_count; ++k) {
    c.grains[k] = convert<To>(b.grains[k]);
  }
  for (std::size_t k = 0; k < b.wall_count(); ++k) {
    const auto& w = b.walls[k];
    c.walls[k] = {{static_cast<To>(w.point.x), static_cast<To>(w.point.y), static_cast<To>(w.point.z)},
                  {static_cast<To>(w.normal.x), static_cast<To>(w.normal.y), static_cast<To>(w.normal.z)}};
  }
  return c;
}

/// Orders the vertices so that the orientation is positive.
inline void orient(pore_body<double>& b) {
  const auto towards = [&](std::size_t k) {
    return k < b.grain_count ? b.grains[k].centre - b.grains[0].centre : -b.walls[k - b.grain_count].normal;
  };
  if (triple(towards(1), towards(2), towards(3)) < 0) {
    if (b.grain_count >= 3) {
      std::swap(b.grains[1], b.grains[2]);
    } else {
      std::swap(b.walls[0], b.walls[1]);
    }
  }
}

inline pore_body<double> random_tetrahedron(random_engine& random, double smallest = 0.05, double largest = 0.35) {
  pore_body<double> b{};
  b.grain_count = 4;
  for (auto& g : b.grains) {
    g = {uniform_point(random), uniform(random, smallest, largest)};
  }
  orient(b);
  return b;
}

/// A cell of the given number of grains in the corner x, y, z >= 0.
inline pore_body<double> random_cell(random_engine& random, std::size_t grains, double smallest = 0.05,
                                     double largest = 0.35) {
  pore_body<double> b{};
  b.grain_count = static_cast<std::uint8_t>(grains);
  for (std::size_t k = 0; k < grains; ++k) {
    b.grains[k] = {uniform_point(random), uniform(random, smallest, largest)};
  }
  for (std::size_t w = 0; w < b.wall_count(); ++w) {
    b.walls[w].normal[w] = 1;
  }
  orient(b);
  return b;
}

/// A uniform point of the cell; false when the draw fell outside it.
inline bool draw(random_engine& random, const pore_body<double>& b, vec3<double>& p) {
  const std::size_t n = b.grain_count;
  std::array<double, 4> weight{};
  double sum = 0;
  for (std::size_t k = 0; k < n; ++k) {
    weight[k] = -std::log(1 - uniform(random));
    sum += weight[k];
  }
  p = {};
  std::array<double, 3> depth{};  // mean distance from each wall
  std::array<double, 3> deepest{};
  for (std::size_t k = 0; k < n; ++k) {
    p += b.grains[k].centre * (weight[k] / sum);
    for (std::size_t w = 0; w < b.wall_count(); ++w) {
      const double d = b.walls[w].distance(b.grains[k].centre);
      depth[w] += d * weight[k] / sum;
      deepest[w] = std::max(deepest[w], d);
    }
  }
  bool inside = true;
  for (std::size_t w = 0; w < b.wall_count(); ++w) {
    const double down = uniform(random, 0, deepest[w]);
    inside = inside && down <= depth[w];
    p -= b.walls[w].normal * down;
  }
  return inside;
}

/// Which grains and walls make a cell.
struct named_cell {
  pore_body<double> body;
  std::vector<std::size_t> grains;
};

/// All cells of the regular triangulation of spheres in general position in the unit cube with walls.
inline std::vector<named_cell> cells_in_unit_cube(const std::vector<sphere<double>>& spheres) {
  const domain region = walled({{0, 0, 0}, {1, 1, 1}});
  const std::size_t n = spheres.size();
  std::vector<named_cell> cells;
  const auto consider = [&](const std::vector<std::size_t>& grains, const std::vector<face>& walls) {
    named_cell cell{};
    cell.grains = grains;
    cell.body.grain_count = static_cast<std::uint8_t>(grains.size());
    for (std::size_t k = 0; k < grains.size(); ++k) {
      cell.body.grains[k] = spheres[grains[k]];
    }
    for (std::size_t k = 0; k < walls.size(); ++k) {
      cell.body.walls[k] = region.wall(walls[k]);
    }
    const auto node = power_centre(cell.body);
    if (!node.ok()) {
      return;
    }
    const double own = power(node.value, spheres[grains[0]]);
    for (std::size_t g = 0; g < n; ++g) {
      if (std::find(grains.begin(), grains.end(), g) == grains.end() && power(node.value, spheres[g]) < own) {
        return;
      }
    }
    for (const face f : all_faces) {
      if (std::find(walls.begin(), walls.end(), f) == walls.end() && region.wall(f).distance(node.value) < 0) {
        return;
      }
    }
    orient(cell.body);
    cells.push_back(cell);
  };
  constexpr std::array<std::array<std::size_t, 2>, 3> axis_pairs{{{0, 1}, {0, 2}, {1, 2}}};
  const auto side = [](std::size_t axis, unsigned bit) { return static_cast<face>(2 * axis + bit); };
  for (std::size_t i = 0; i < n; ++i) {
    for (unsigned corner = 0; corner < 8; ++corner) {
      consider({i}, {side(0, corner & 1U), side(1, corner >> 1 & 1U), side(2, corner >> 2 & 1U)});
    }
    for (std::size_t j = i + 1; j < n; ++j) {
      for (const auto& [a, b] : axis_pairs) {
        for (unsigned corner = 0; corner < 4; ++corner) {
          consider({i, j}, {side(a, corner & 1U), side(b, corner >> 1 & 1U)});
        }
      }
      for (std::size_t k = j + 1; k < n; ++k) {
        for (const face f : all_faces) {
          consider({i, j, k}, {f});
        }
        for (std::size_t l = k + 1; l < n; ++l) {
          consider({i, j, k, l}, {});
        }
      }
    }
  }
  return cells;
}

inline std::vector<sphere<double>> random_spheres(random_engine& random, std::size_t n, double smallest,
                                                  double largest) {
  std::vector<sphere<double>> spheres(n);
  for (auto& s : spheres) {
    s = {uniform_point(random), uniform(random, smallest, largest)};
  }
  return spheres;
}

}  // namespace tetrapore_test
