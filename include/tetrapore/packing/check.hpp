// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/packing/packing.hpp"
#include "tetrapore/packing/wrap.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <span>
#include <string>
#include <vector>

/// \file
/// What a packing must satisfy before anything is built on it.

namespace tetrapore::inline TETRAPORE_ABI {
namespace detail {

/// A number as it can be typed back: 17 digits.
[[nodiscard]] inline std::string digits(double value) {
  std::array<char, 32> text{};
  const int n = std::snprintf(text.data(), text.size(), "%.17g", value);
  return {text.data(), static_cast<std::size_t>(n)};
}

[[nodiscard]] inline std::string grain_name(std::size_t i) { return "grain " + std::to_string(i); }

[[nodiscard]] inline std::string written(const vec3<double>& p) {
  return "(" + digits(p.x) + ", " + digits(p.y) + ", " + digits(p.z) + ")";
}

inline void check_box(const box& b, bool bounded) {
  constexpr std::array<const char*, 3> axis_name{"x", "y", "z"};
  for (std::size_t k = 0; bounded && k < 3; ++k) {
    if (!(b.lo[k] < b.hi[k]) || !std::isfinite(b.hi[k] - b.lo[k])) {
      throw packing_error(std::string("box along ") + axis_name[k], digits(b.lo[k]) + " to " + digits(b.hi[k]),
                          "finite bounds, the lower one first");
    }
  }
}

/// Largest height of the centres above the plane of three that span widely, against the rounding of the coordinates.
inline void check_not_flat(std::span<const sphere<double>> grains) {
  const auto origin = grains[0].centre;
  double magnitude = 0;
  const auto farthest = [&](auto&& measure) {
    std::size_t best = 0;
    double most = -1;
    for (std::size_t i = 0; i < grains.size(); ++i) {
      const double m = measure(grains[i].centre - origin);
      if (m > most) {
        most = m;
        best = i;
      }
    }
    return best;
  };
  for (const auto& g : grains) {
    magnitude = std::max({magnitude, std::abs(g.centre.x), std::abs(g.centre.y), std::abs(g.centre.z)});
  }
  // Unit vectors first: nothing then over- or underflows, whatever the unit of length.
  const auto largest = [](const vec3<double>& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
  const auto a = grains[farthest(largest)].centre - origin;
  const double span = largest(a);
  const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * (magnitude + span);
  if (!(span > rounding)) {
    throw packing_error("grains", "all centres at one point", "centres that span a volume");
  }
  const auto u = a / span / norm(a / span);
  const auto off_line = [&](const vec3<double>& v) {
    const auto w = v / span;
    return largest(w - u * dot(w, u));
  };
  const auto b = grains[farthest(off_line)].centre - origin;
  if (!(off_line(b) * span > rounding)) {
    throw packing_error("grains", "all centres on one line", "centres that span a volume");
  }
  const auto flat = b / span - u * dot(b / span, u);
  const auto normal = cross(u, flat / norm(flat));
  const auto off_plane = [&](const vec3<double>& v) { return std::abs(dot(v / span, normal)); };
  const double height = off_plane(grains[farthest(off_plane)].centre - origin) * span;
  // A plane through points `norm(flat)` apart, each rounded, is off by the rounding over that distance, at the far end.
  if (!(height > rounding / norm(flat))) {
    throw packing_error("grains", "all centres in one plane (to " + digits(height) + " m)",
                        "centres that span a volume");
  }
}

/// Exact equality of centres, after wrapping along periodic axes: an open hash table of grain indices.
inline void check_distinct(std::span<const sphere<double>> grains, const domain& d) {
  const auto place = [&](std::size_t i) {
    auto c = grains[i].centre;
    for (std::size_t k = 0; k < 3; ++k) {
      c[k] = (d.is_periodic(k) ? wrapped(c[k], d.bounds.lo[k], d.bounds.hi[k]) : c[k]) + 0.0;  // −0 is 0
    }
    return c;
  };
  const std::size_t slots = std::bit_ceil(2 * grains.size());
  std::vector<std::uint32_t> table(slots, 0);  // index + 1; 0 is free
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const auto c = place(i);
    std::uint64_t h = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      h = (h ^ std::bit_cast<std::uint64_t>(c[k])) * 0x9e3779b97f4a7c15ULL;
      h ^= h >> 32;
    }
    auto slot = static_cast<std::size_t>(h) & (slots - 1);
    for (; table[slot] != 0; slot = (slot + 1) & (slots - 1)) {
      const std::size_t other = table[slot] - 1;
      if (place(other) == c) {
        throw packing_error(grain_name(i),
                            "centre " + written(grains[i].centre) + ", that of grain " + std::to_string(other) +
                                (d.any_periodic() ? " modulo the box" : ""),
                            "grains at different places");
      }
    }
    table[slot] = static_cast<std::uint32_t>(i + 1);
  }
}

}  // namespace detail

/// Refuses a set of grains that cannot be triangulated, or that its box contradicts. Checks, in this order: the box; at
/// least 4 grains; finite centres, finite radii above 0, centres on the inner side of every wall (a grain may
/// protrude); centres that span a volume. Grains at one place pass: a triangulation names them as hidden.
/// An unbounded domain has no box to be outside of. Indices count from 0.
/// \par Units  [m]
/// \par Accuracy  equality of places is exact; "one plane" means to the rounding of the coordinates, so that a packing
/// far from the origin is judged by the digits it still has
/// \throw packing_error  names the grain (or the box), the value and what was expected
inline void check_triangulable(std::span<const sphere<double>> grains, const domain& d) {
  constexpr std::array<const char*, 3> axis_name{"x", "y", "z"};
  bool bounded = false;
  for (const auto kind : d.faces) {
    bounded = bounded || kind != boundary::open;
  }
  detail::check_box(d.bounds, bounded);
  for (std::size_t k = 0; k < 3; ++k) {
    if ((d.faces[2 * k] == boundary::periodic) != (d.faces[2 * k + 1] == boundary::periodic)) {
      throw packing_error(std::string("box along ") + axis_name[k], "one periodic face",
                          "both faces periodic, or none");
    }
  }
  if (grains.size() < 4) {
    throw packing_error("grains", std::to_string(grains.size()), "at least 4");
  }
  if (grains.size() > std::size_t{0x7fffffff}) {
    throw packing_error("grains", std::to_string(grains.size()), "at most 2147483647");
  }
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const auto& g = grains[i];
    if (!finite(g.centre)) {
      throw packing_error(detail::grain_name(i), "centre " + detail::written(g.centre), "finite coordinates");
    }
    if (!(g.radius > 0) || !std::isfinite(g.radius)) {
      throw packing_error(detail::grain_name(i), "radius " + detail::digits(g.radius), "a finite radius above 0");
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = g.centre[k];
      const bool below = d.faces[2 * k] == boundary::wall && x < d.bounds.lo[k];
      const bool above = d.faces[2 * k + 1] == boundary::wall && x > d.bounds.hi[k];
      if (below || above) {
        throw packing_error(detail::grain_name(i), std::string("centre ") + axis_name[k] + " = " + detail::digits(x),
                            "a centre inside the box, from " + detail::digits(d.bounds.lo[k]) + " to " +
                                detail::digits(d.bounds.hi[k]));
      }
    }
  }
  detail::check_not_flat(grains);
}

/// The same, and no two grains at one place, modulo the box along periodic axes.
/// \throw packing_error  names the grain (or the box), the value and what was expected
inline void check(std::span<const sphere<double>> grains, const domain& d) {
  check_triangulable(grains, d);
  detail::check_distinct(grains, d);
}

/// The same for a packing and its box, with walls on the axes that are not periodic unless `walls` is false.
inline void check(const packing& p, bool walls = true) {
  if (p.bounds) {
    detail::check_box(*p.bounds, true);
  }
  check(p.grains, domain_of(p, walls));
}

}  // namespace tetrapore::inline TETRAPORE_ABI
