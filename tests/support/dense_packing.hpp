// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/packing/random_packing.hpp"
#include "tetrapore/packing/tile.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

/// \file
/// Dense packings of any size in no time, for benchmarks and campaigns.

/// n dense grains (a multiple of 1,000; radii ±30 %, solid fraction 0.6) in a box with walls: a periodic random packing
/// of 1,000, repeated, in random order. Grains at a wall are cut by it.
[[nodiscard]] inline tetrapore::packing dense_packing(std::size_t n) {
  std::vector<double> radii(1000);
  std::mt19937_64 random(3);
  for (double& r : radii) {
    r = 0.7 + 0.6 * static_cast<double>(random() >> 11U) * 0x1p-53;
  }
  const tetrapore::packing cell =
      tetrapore::random_packing(radii, {.solid_fraction = 0.6, .periodic = {true, true, true}, .seed = 5});
  std::array<std::size_t, 3> copies{1, 1, 1};
  for (std::size_t k = 0, left = n / 1000; left > 1; ++k) {
    const std::size_t factor = left % 2 == 0 ? 2 : (left % 5 == 0 ? 5 : left);
    copies[k % 3] *= factor;
    left /= factor;
  }
  tetrapore::packing p = tile(cell, copies);
  p.periodic = {};
  for (std::size_t i = p.grains.size(); i > 1; --i) {  // std::shuffle differs between standard libraries
    std::swap(p.grains[i - 1], p.grains[random() % i]);
  }
  return p;
}
