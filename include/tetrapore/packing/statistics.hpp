// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/packing/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

/// \file
/// Numbers that describe a packing.

namespace tetrapore::inline TETRAPORE_ABI {

/// Smallest, mean and largest radius. \par Units  [m]; NaN for no grains
struct radius_range {
  double smallest = std::numeric_limits<double>::quiet_NaN();
  double mean = std::numeric_limits<double>::quiet_NaN();
  double largest = std::numeric_limits<double>::quiet_NaN();
};

[[nodiscard]] inline radius_range radii_of(std::span<const sphere<double>> grains) noexcept {
  if (grains.empty()) {
    return {};
  }
  radius_range r{grains[0].radius, 0.0, grains[0].radius};
  for (const auto& g : grains) {
    r.smallest = std::min(r.smallest, g.radius);
    r.largest = std::max(r.largest, g.radius);
    r.mean += g.radius;
  }
  r.mean /= static_cast<double>(grains.size());
  return r;
}

/// Sum of the volumes of the spheres; overlaps count twice. \par Units  [m³]
[[nodiscard]] inline double sphere_volume(std::span<const sphere<double>> grains) noexcept {
  double cubes = 0;
  for (const auto& g : grains) {
    cubes += g.radius * g.radius * g.radius;
  }
  return 4.0 / 3.0 * pi<double> * cubes;
}

/// Sphere volume over box volume; exact where no grains overlap and none protrudes. NaN without a box.
[[nodiscard]] inline double solid_fraction(const packing& p) noexcept {
  return p.bounds ? sphere_volume(p.grains) / p.bounds->volume() : std::numeric_limits<double>::quiet_NaN();
}

/// Largest overlap of two grains, or of a grain and a wall, as a fraction of the smaller radius; negative when all are
/// apart by more than nothing, then minus the smallest gap found within `reach` radii.
struct overlap_report {
  double grains = -std::numeric_limits<double>::infinity();  ///< of two grains, over the smaller radius
  double walls = -std::numeric_limits<double>::infinity();   ///< of a grain and a wall, over its radius
};

/// \param reach  pairs with a gap up to this many mean radii are looked at
[[nodiscard]] inline overlap_report largest_overlap(const packing& p, double reach = 0.01) {
  overlap_report report;
  const double mean = radii_of(p.grains).mean;
  for_each_close_pair(p, p.grains.empty() ? 0.0 : reach * mean, [&](const close_pair& pair, const vec3<double>& apart) {
    const double a = p.grains[pair.i].radius;
    const double b = p.grains[pair.j].radius;
    report.grains = std::max(report.grains, (a + b - norm(apart)) / std::min(a, b));
  });
  for (std::size_t k = 0; p.bounds && k < 3; ++k) {
    if (!p.periodic[k]) {
      for (const auto& g : p.grains) {
        const double clear = std::min(g.centre[k] - p.bounds->lo[k], p.bounds->hi[k] - g.centre[k]);
        report.walls = std::max(report.walls, (g.radius - clear) / g.radius);
      }
    }
  }
  return report;
}

/// Mean number of contacts of a grain with others: gaps up to `tolerance` times the mean of the two radii count as
/// contacts. Walls are not counted.
[[nodiscard]] inline double coordination_number(const packing& p, double tolerance) {
  if (p.grains.empty()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  double contacts = 0;
  for_each_close_pair(p, tolerance * radii_of(p.grains).largest,
                      [&](const close_pair& pair, const vec3<double>& apart) {
                        const double sum = p.grains[pair.i].radius + p.grains[pair.j].radius;
                        contacts += norm(apart) - sum <= 0.5 * tolerance * sum ? 2.0 : 0.0;
                      });
  return contacts / static_cast<double>(p.grains.size());
}

}  // namespace tetrapore::inline TETRAPORE_ABI
