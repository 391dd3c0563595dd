// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/packing/packing.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// \file
/// Brings the grains of a periodic packing into its box, and removes those that the source lists twice as images.

namespace tetrapore::inline TETRAPORE_ABI {

/// What wrap changed.
struct wrap_report {
  std::size_t wrapped = 0;              ///< grains moved by whole box lengths
  std::vector<std::size_t> duplicates;  ///< indices, before removal, of grains that were images of an earlier one
};

/// One coordinate, moved by whole periods into [lo, hi).
[[nodiscard]] inline double wrapped(double x, double lo, double hi) noexcept {
  if (x >= lo && x < hi) {
    return x;
  }
  const double period = hi - lo;
  const double inside = x - period * std::floor((x - lo) / period);
  return inside >= hi || inside < lo ? lo : inside;  // a hair below lo rounds up to hi, which is lo
}

namespace detail {

/// Finds grains whose centres are equal modulo the box to within a reach: cells a few reaches wide, kept as a sorted
/// list of (cell, grain), so that memory does not depend on how small the reach is.
class coincidence_search {
 public:
  coincidence_search(const std::vector<sphere<double>>& grains, const domain& d, double reach)
      : grains_(grains), domain_(d), reach_(reach), cell_(4.0 * reach) {
    cells_.reserve(grains.size());
    for (std::size_t i = 0; i < grains.size(); ++i) {
      cells_.push_back({key(grains[i].centre), i});
    }
    std::sort(cells_.begin(), cells_.end());
  }

  /// Calls f(j) for every other grain j within the reach of grain i along each axis.
  template <class F>
  void around(std::size_t i, F&& f) const {
    const auto& centre = grains_[i].centre;
    std::array<std::uint64_t, 8> seen{};
    std::size_t count = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
      auto c = centre;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        c[axis] += (corner >> axis & 1U) != 0 ? reach_ : -reach_;
        if (domain_.is_periodic(axis)) {
          c[axis] = wrapped(c[axis], domain_.bounds.lo[axis], domain_.bounds.hi[axis]);
        }
      }
      const auto k = key(c);
      if (std::find(seen.begin(), seen.begin() + count, k) != seen.begin() + count) {
        continue;
      }
      seen[count++] = k;
      for (auto at = std::lower_bound(cells_.begin(), cells_.end(), entry{k, 0}); at != cells_.end() && at->cell == k;
           ++at) {
        if (at->grain != i && close(i, at->grain)) {
          f(at->grain);
        }
      }
    }
  }

 private:
  struct entry {
    std::uint64_t cell;
    std::size_t grain;
    friend constexpr auto operator<=>(const entry&, const entry&) noexcept = default;
  };

  [[nodiscard]] std::uint64_t key(const vec3<double>& c) const noexcept {
    std::uint64_t k = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double n = std::floor((c[axis] - domain_.bounds.lo[axis]) / cell_);
      k = (k ^ std::bit_cast<std::uint64_t>(n + 0.0)) * 0x9e3779b97f4a7c15ULL;
      k ^= k >> 29;
    }
    return k;
  }
  [[nodiscard]] bool close(std::size_t i, std::size_t j) const noexcept {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double gap = std::abs(grains_[i].centre[axis] - grains_[j].centre[axis]);
      if (domain_.is_periodic(axis)) {
        gap = std::min(gap, std::abs(domain_.bounds.size()[axis] - gap));
      }
      if (!(gap <= reach_)) {
        return false;
      }
    }
    return true;
  }

  const std::vector<sphere<double>>& grains_;
  const domain& domain_;
  double reach_;
  double cell_;
  std::vector<entry> cells_;
};

}  // namespace detail

/// Wraps the grains along the periodic axes and removes images of a grain that is listed already: same radius, and
/// centres equal modulo the box to within `tolerance` times the smallest radius. Two grains given at one place, with no
/// period between them, stay: that is a mistake of the input, which check() reports. The order of the grains is kept.
/// \par Units  [m]
/// \par Accuracy  a grain n box lengths away loses the digits of n
/// 	hrow packing_error  a periodic axis without a box; a grain more than a million box lengths away, whose place is
///                       no longer known
inline wrap_report wrap(packing& p, double tolerance = 1e-9) {
  wrap_report report;
  const auto d = domain_of(p);
  if (!d.any_periodic() || p.grains.empty()) {
    return report;
  }
  double smallest = p.grains.front().radius;
  for (std::size_t i = 0; i < p.grains.size(); ++i) {
    smallest = std::min(smallest, p.grains[i].radius);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double x = p.grains[i].centre[axis];
      if (d.is_periodic(axis) && !(std::abs(x - d.bounds.lo[axis]) <= 1e6 * d.bounds.size()[axis])) {
        throw packing_error("grain " + std::to_string(i),
                            std::string("centre ") + "xyz"[axis] + " = " + short_number(x),
                            "a place within a million box lengths of the box");
      }
    }
  }
  const double reach = tolerance * smallest;
  const auto given = p.grains;
  const auto given_apart = [&](std::size_t i, std::size_t j) {
    const auto gap = given[i].centre - given[j].centre;
    return std::abs(gap.x) > reach || std::abs(gap.y) > reach || std::abs(gap.z) > reach;
  };

  // An image of a grain inside the box lies outside it, or within the reach of its faces.
  std::vector<std::uint8_t> may_repeat(p.grains.size(), 0);
  bool any = false;
  for (std::size_t i = 0; i < p.grains.size(); ++i) {
    bool moved = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (d.is_periodic(axis)) {
        const double lo = d.bounds.lo[axis];
        const double hi = d.bounds.hi[axis];
        double& x = p.grains[i].centre[axis];
        const double inside = wrapped(x, lo, hi);
        const bool moves = inside != x;
        moved = moved || moves;
        x = inside;
        may_repeat[i] |= static_cast<std::uint8_t>(moves || x - lo <= reach || hi - x <= reach);
      }
    }
    report.wrapped += moved ? 1 : 0;
    any = any || may_repeat[i] != 0;
  }
  if (!any || !(reach > 0)) {
    return report;
  }

  const detail::coincidence_search search(p.grains, d, reach);
  std::vector<std::array<std::size_t, 2>> repeats;  // later grain, earlier grain
  for (std::size_t i = 0; i < p.grains.size(); ++i) {
    if (may_repeat[i] == 0) {
      continue;
    }
    search.around(i, [&](std::size_t j) {
      if (p.grains[i].radius == p.grains[j].radius && given_apart(i, j)) {
        repeats.push_back({std::max(i, j), std::min(i, j)});
      }
    });
  }
  std::sort(repeats.begin(), repeats.end());
  std::vector<std::uint8_t> removed(p.grains.size(), 0);
  for (const auto& [later, earlier] : repeats) {  // only a grain that stays makes another one its image
    removed[later] |= static_cast<std::uint8_t>(removed[earlier] == 0);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < p.grains.size(); ++i) {
    if (removed[i] != 0) {
      report.duplicates.push_back(i);
    } else {
      p.grains[kept++] = p.grains[i];
    }
  }
  p.grains.resize(kept);
  return report;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
