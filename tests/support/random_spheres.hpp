// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/geometry/domain.hpp"

#include <random>
#include <vector>

/// \file
/// Loose random packings for tests that need no file.

/// n spheres in the unit box that do not overlap and do not cross its faces, radii within 2:1, by random sequential
/// addition; deterministic in the seed.
[[nodiscard]] inline std::vector<tetrapore::sphere<double>> loose_spheres(std::size_t n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::vector<tetrapore::sphere<double>> out;
  const double mean = 0.35 * std::cbrt(1.0 / static_cast<double>(n));
  const auto unit = [&random] { return static_cast<double>(random() >> 11U) * 0x1p-53; };
  while (out.size() < n) {
    const double r = mean * (2.0 / 3.0 + 2.0 / 3.0 * unit());
    const auto place = [&] { return r + (1 - 2 * r) * unit(); };
    const tetrapore::vec3<double> c{place(), place(), place()};
    bool free = true;
    for (const auto& s : out) {
      free = free && norm2(s.centre - c) >= (s.radius + r) * (s.radius + r);
    }
    if (free) {
      out.push_back({c, r});
    }
  }
  return out;
}

[[nodiscard]] inline tetrapore::domain unit_box(tetrapore::boundary x, tetrapore::boundary y, tetrapore::boundary z) {
  return {{{0, 0, 0}, {1, 1, 1}}, {x, x, y, y, z, z}};
}
