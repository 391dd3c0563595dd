// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/required.hpp"
#include "tetrapore/packing/random.hpp"
#include "tetrapore/packing/statistics.hpp"
#include "tetrapore/packing/wrap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <vector>

/// \file
/// Dense random packings without overlaps.

namespace tetrapore::inline TETRAPORE_ABI {

/// What random_packing is asked for.
struct random_packing_options {
  required<double> solid_fraction;     ///< sphere volume over box volume
  std::array<bool, 3> periodic{};      ///< the other axes have walls
  vec3<double> aspect{1.0, 1.0, 1.0};  ///< proportions of the box
  std::uint64_t seed = 1;
  double gap = 1e-6;  ///< near-contacts are apart by ½ to 1 times this, over the sum of radii
  std::size_t most_iterations = 200000;
};

/// The work that random_packing took.
struct random_packing_report {
  std::size_t iterations = 0;
  std::size_t list_rebuilds = 0;
};

namespace detail {

/// Soft spheres that push each other and the walls until none overlap: F = overlap, equal masses, the FIRE minimiser.
/// Below jamming the energy falls to zero, and the spheres come to rest at near-contacts.
class overlap_relaxation {
 public:
  overlap_relaxation(packing& p, double inflation) : p_(p), inflation_(inflation) {
    const std::size_t n = p.grains.size();
    for (auto& g : p_.grains) {
      g.radius *= 1.0 + inflation_;
    }
    velocity_.resize(n);
    force_.resize(n);
    const double mean = radii_of(p.grains).mean;
    skin_ = 0.3 * mean;
    farthest_ = 0.1 * mean;
  }

  /// True when no two spheres overlap by more than half of their inflation; false when they jam, or time is up.
  bool relax(std::size_t most_iterations, random_packing_report& report) {
    // FIRE, with time in units of sqrt(mass / stiffness): the stiffest contact network has a period near 2.
    constexpr double largest_step = 0.45;
    constexpr double first_mixing = 0.1;
    double step = 0.1;
    double mixing = first_mixing;
    std::size_t downhill = 0;
    double worst_before = std::numeric_limits<double>::infinity();
    rebuild(report);
    for (; report.iterations < most_iterations; ++report.iterations) {
      const double worst = push();
      if (worst <= 0.0) {
        return true;
      }
      if (report.iterations % patience == 0) {
        if (worst > 0.9 * worst_before) {
          return false;  // jammed: the overlaps have come to stay
        }
        worst_before = worst;
      }
      double power = 0;
      double vv = 0;
      double ff = 0;
      for (std::size_t i = 0; i < force_.size(); ++i) {
        power += dot(force_[i], velocity_[i]);
        vv += norm2(velocity_[i]);
        ff += norm2(force_[i]);
      }
      double keep = 0;
      double turn = 0;
      if (power > 0) {
        keep = 1.0 - mixing;
        turn = mixing * std::sqrt(vv / ff);
        if (++downhill > 5) {
          step = std::min(1.1 * step, largest_step);
          mixing *= 0.99;
        }
      } else {
        downhill = 0;
        step = std::max(0.5 * step, 1e-3);
        mixing = first_mixing;
      }
      // At the start spheres lie in each other, and the forces are wild: nothing moves far in one step.
      const double fastest = farthest_ / step;
      double travel = 0;
      for (std::size_t i = 0; i < force_.size(); ++i) {
        velocity_[i] = velocity_[i] * keep + force_[i] * (turn + step);
        const double v = norm2(velocity_[i]);
        if (v > fastest * fastest) {
          velocity_[i] *= fastest / std::sqrt(v);
        }
        travel = std::max(travel, std::min(v, fastest * fastest));
      }
      travel = step * std::sqrt(travel);
      if (moved_ + travel > 0.5 * skin_) {
        rebuild(report);
      }
      moved_ += travel;
      for (std::size_t i = 0; i < force_.size(); ++i) {
        p_.grains[i].centre += velocity_[i] * step;
      }
    }
    return push() <= 0.0;
  }

  /// Takes the inflation back.
  void deflate(std::span<const double> radii) {
    for (std::size_t i = 0; i < radii.size(); ++i) {
      p_.grains[i].radius = radii[i];
    }
  }

 private:
  struct neighbour {
    std::uint32_t j;
    std::uint32_t shift;
  };

  static constexpr std::size_t patience = 5000;

  static constexpr std::uint32_t code(image s) noexcept {
    return static_cast<std::uint32_t>(((s.x + 2) * 5 + s.y + 2) * 5 + s.z + 2);
  }

  /// Lists the pairs that may touch before some sphere has moved by half the skin.
  void rebuild(random_packing_report& report) {
    ++report.list_rebuilds;
    const auto& b = *p_.bounds;
    const auto size = b.size();
    for (auto& g : p_.grains) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (p_.periodic[k]) {
          g.centre[k] = g.centre[k] - size[k] * std::floor((g.centre[k] - b.lo[k]) / size[k]);
        }
      }
    }
    start_.assign(p_.grains.size() + 1, 0);
    list_.clear();
    std::size_t last = 0;
    for_each_close_pair(p_, skin_, [&](const close_pair& pair, const vec3<double>&) {
      for (; last < pair.i; ++last) {
        start_[last + 1] = static_cast<std::uint32_t>(list_.size());
      }
      list_.push_back({static_cast<std::uint32_t>(pair.j), code(pair.shift)});
    });
    for (; last < p_.grains.size(); ++last) {
      start_[last + 1] = static_cast<std::uint32_t>(list_.size());
    }
    for (int x = -2; x <= 2; ++x) {
      for (int y = -2; y <= 2; ++y) {
        for (int z = -2; z <= 2; ++z) {
          const image s{static_cast<std::int8_t>(x), static_cast<std::int8_t>(y), static_cast<std::int8_t>(z)};
          shift_[code(s)] = {x * size.x, y * size.y, z * size.z};
        }
      }
    }
    moved_ = 0;
  }

  /// Forces, and the largest overlap beyond half of the inflation.
  double push() {
    std::fill(force_.begin(), force_.end(), vec3<double>{});
    const double allowed = 0.5 * inflation_ / (1.0 + inflation_);
    double worst = 0;
    const auto* grains = p_.grains.data();
    for (std::size_t i = 0; i < p_.grains.size(); ++i) {
      const auto a = grains[i];
      vec3<double> sum{};
      for (auto s = start_[i]; s < start_[i + 1]; ++s) {
        const auto& b = grains[list_[s].j];
        const auto apart = b.centre + shift_[list_[s].shift] - a.centre;
        const double reach = a.radius + b.radius;
        const double d2 = norm2(apart);
        if (d2 < reach * reach) {
          const double d = std::sqrt(d2);
          const double overlap = reach - d;
          worst = std::max(worst, overlap - allowed * reach);
          const auto f = d > 0 ? apart * (overlap / d) : vec3<double>{overlap, 0.0, 0.0};
          sum -= f;
          force_[list_[s].j] += f;
        }
      }
      force_[i] += sum;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (!p_.periodic[k]) {
        const double lo = p_.bounds->lo[k];
        const double hi = p_.bounds->hi[k];
        for (std::size_t i = 0; i < p_.grains.size(); ++i) {
          const auto& g = grains[i];
          const double low = g.radius - (g.centre[k] - lo);
          const double high = g.radius - (hi - g.centre[k]);
          worst = std::max({worst, low - allowed * g.radius, high - allowed * g.radius});
          force_[i][k] += std::max(low, 0.0) - std::max(high, 0.0);
        }
      }
    }
    return worst;
  }

  packing& p_;
  double inflation_;
  double skin_ = 0;
  double farthest_ = 0;
  double moved_ = 0;
  std::vector<vec3<double>> velocity_;
  std::vector<vec3<double>> force_;
  std::vector<std::uint32_t> start_;
  std::vector<neighbour> list_;
  std::array<vec3<double>, 125> shift_{};
};

/// Uniform random points, ordered along z-layers of columns so that neighbours lie close in memory.
inline std::vector<vec3<double>> random_points(std::size_t n, const box& b, random_sequence& random) {
  const double cells = std::max(1.0, std::cbrt(static_cast<double>(n) / 8.0));
  struct keyed {
    std::array<int, 3> cell;
    vec3<double> point;
  };
  std::vector<keyed> points(n);
  for (auto& p : points) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double u = random.uniform();
      p.cell[k] = static_cast<int>(u * cells);
      p.point[k] = b.lo[k] + u * (b.hi[k] - b.lo[k]);
    }
  }
  std::stable_sort(points.begin(), points.end(), [](const keyed& p, const keyed& q) { return p.cell < q.cell; });
  std::vector<vec3<double>> ordered;
  ordered.reserve(n);
  for (const auto& p : points) {
    ordered.push_back(p.point);
  }
  return ordered;
}

}  // namespace detail

/// A dense random packing of grains with the given radii, in a box whose volume follows from the solid fraction; its
/// lower corner is the origin. Random points become soft spheres of the final size, slightly inflated, which relax
/// until no two overlap by more than half of the inflation. The radii are placed at random, and keep their values.
/// \par Units  [m]
/// \par Domain  solid fractions below jamming: for radii within ±30 %, 0.57 for 1,000 grains between six walls, 0.61
/// for 10,000, 0.62 for 40,000 or in a periodic box; more for wide distributions
/// \par Accuracy  no overlap; the smallest gap is half of options.gap. The same radii and options give the same
/// bits, with a compiler that does not fuse multiply and add
/// \par Source  minimiser: Bitzek, Koskinen, Gähler, Moseler & Gumbsch, Structural relaxation made simple, PRL 97, 2006
/// \throw parameter_error  an option outside its domain
/// \throw packing_error    the grains jam, or overlaps remain after most_iterations; with the largest of them
inline packing random_packing(std::span<const double> radii, const random_packing_options& options,
                              random_packing_report* report = nullptr) {
  const double phi = options.solid_fraction;
  if (!(phi > 0 && phi < 0.9)) {
    throw parameter_error("solid_fraction", short_number(phi), "a number above 0 and below 0.9");
  }
  if (!(options.gap >= 1e-12 && options.gap <= 0.1)) {
    throw parameter_error("gap", short_number(options.gap), "a number from 1e-12 to 0.1");
  }
  if (radii.empty()) {
    throw parameter_error("radii", "none", "at least one");
  }
  double cubes = 0;
  double largest = 0;
  for (const double r : radii) {
    if (!(r > 0) || !std::isfinite(r)) {
      throw parameter_error("radii", short_number(r), "finite numbers above 0");
    }
    cubes += r * r * r;
    largest = std::max(largest, r);
  }
  const auto& a = options.aspect;
  if (!(a.x > 0 && a.y > 0 && a.z > 0) || !finite(a)) {
    throw parameter_error("aspect", "a proportion that is not above 0", "three finite numbers above 0");
  }
  const double edge = std::cbrt(4.0 / 3.0 * pi<double> * cubes / phi / (a.x * a.y * a.z));
  packing p;
  p.bounds = box{{0.0, 0.0, 0.0}, a * edge};
  p.periodic = options.periodic;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(p.bounds->hi[k] > 2.0 * largest * (1.0 + options.gap))) {
      throw parameter_error("aspect", "a box of " + short_number(p.bounds->hi[k] / largest) + " largest radii",
                            "one that holds the largest grain");
    }
  }

  random_sequence random(options.seed);
  std::vector<double> placed(radii.begin(), radii.end());
  random.shuffle(placed);
  const auto points = detail::random_points(radii.size(), *p.bounds, random);
  p.grains.reserve(radii.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    p.grains.push_back({points[i], placed[i]});
  }
  random_packing_report counted;
  detail::overlap_relaxation relaxation(p, options.gap);
  const bool apart = relaxation.relax(options.most_iterations, counted);
  relaxation.deflate(placed);
  for (auto& g : p.grains) {
    for (std::size_t k = 0; k < 3; ++k) {
      g.centre[k] = p.periodic[k] ? wrapped(g.centre[k], p.bounds->lo[k], p.bounds->hi[k]) : g.centre[k];
    }
  }
  const auto overlap = largest_overlap(p);
  if (!apart || overlap.grains > 0 || overlap.walls > 0) {
    throw packing_error("random packing of solid fraction " + short_number(phi),
                        "an overlap of " + short_number(std::max(overlap.grains, overlap.walls)) + " radii after " +
                            std::to_string(counted.iterations) + " iterations",
                        "none; a lower solid fraction relaxes");
  }
  if (report != nullptr) {
    *report = counted;
  }
  return p;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
