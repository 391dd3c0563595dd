// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/executor.hpp"
#include "tetrapore/network/gather.hpp"
#include "tetrapore/one_phase/cell_size.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// \file
/// How fast the cells of a network change their volume while the grains move.

namespace tetrapore::inline TETRAPORE_ABI {

/// A cell with the velocities of its grains and walls. A wall keeps its direction. \par Units  [m], [m/s]
template <real T>
struct moving_body {
  pore_body<T> body;
  std::array<vec3<T>, 4> velocities;  ///< of the grains
  std::array<T, 3> wall_speeds;       ///< of the walls, along their normals into the box
};

/// Rate of change of the signed volume of a cell: the exact derivative, for all four shapes.
/// \par Units  [m³/s]
/// \par Domain  any cell, also flat or turned inside out
/// \par Accuracy  a few epsilon of the sum of the magnitudes of its terms; 0 to the last bit when all velocities are
///                the same
/// \par Source  Chareyre et al. 2017, §2.2, Eq. (1); the derivative of total_volume, checked against dual numbers
template <real T>
[[nodiscard]] T volume_rate(const moving_body<T>& m) noexcept {
  const auto& g = m.body.grains;
  const auto& w = m.body.walls;
  const vec3<T>& c = g[0].centre;
  const auto edge = [&](std::size_t k) { return g[k].centre - c; };
  const auto slide = [&](std::size_t k) { return m.velocities[k] - m.velocities[0]; };
  const auto height = [&](std::size_t k, std::size_t wall) { return w[wall].distance(g[k].centre); };
  const auto rise = [&](std::size_t k, std::size_t wall) {
    return dot(m.velocities[k], w[wall].normal) - m.wall_speeds[wall];
  };
  if (m.body.grain_count == 4) {
    const vec3<T> a = edge(1);
    const vec3<T> b = edge(2);
    const vec3<T> d = edge(3);
    return (triple(slide(1), b, d) + triple(slide(2), d, a) + triple(slide(3), a, b)) / T(6);
  }
  if (m.body.grain_count == 3) {  // base times mean height
    const vec3<T> a = edge(1);
    const vec3<T> b = edge(2);
    const T base = -triple(w[0].normal, a, b);
    const T base_rate = -(triple(w[0].normal, slide(1), b) + triple(w[0].normal, a, slide(2)));
    return (base_rate * (height(0, 0) + height(1, 0) + height(2, 0)) + base * (rise(0, 0) + rise(1, 0) + rise(2, 0))) /
           T(6);
  }
  if (m.body.grain_count == 2) {  // length times the mean of the product of the two heights
    const vec3<T> axis = cross(w[0].normal, w[1].normal);
    const T p0 = height(0, 0);
    const T p1 = height(1, 0);
    const T q0 = height(0, 1);
    const T q1 = height(1, 1);
    const T section = T(2) * (p0 * q0 + p1 * q1) + p0 * q1 + p1 * q0;
    const T section_rate = rise(0, 0) * (T(2) * q0 + q1) + rise(1, 0) * (T(2) * q1 + q0) +
                           rise(0, 1) * (T(2) * p0 + p1) + rise(1, 1) * (T(2) * p1 + p0);
    return (dot(slide(1), axis) * section + dot(edge(1), axis) * section_rate) / T(6);
  }
  const T a = height(0, 0);
  const T b = height(0, 1);
  const T d = height(0, 2);
  return (rise(0, 0) * b * d + a * rise(0, 1) * d + a * b * rise(0, 2)) *
         -triple(w[0].normal, w[1].normal, w[2].normal);
}

/// How grains, walls and the periodic box move.
struct motion {
  std::span<const vec3<double>> velocities;    ///< of the grains [m/s]
  std::array<vec3<double>, 6> walls{};         ///< velocity of each wall; only its normal part counts [m/s]
  std::array<vec3<double>, 3> period_rates{};  ///< rate of change of each periodic vector of the box [m/s]

  /// Velocity of the image of a grain.
  [[nodiscard]] vec3<double> of(grain_id g, image at) const noexcept {
    return velocities[g.index()] + period_rates[0] * at.x + period_rates[1] * at.y + period_rates[2] * at.z;
  }
};

/// Rates of change of the volumes of all cells.
struct volume_rates {
  std::vector<double> values;  ///< per pore [m³/s]
  /// Bound on the rounding of the sum over any set of pores [m³/s]: what is left where a sum is zero in exact numbers.
  double rounding = 0;
};

namespace detail {

[[nodiscard]] inline moving_body<double> moving_body_at(const network& net, pore_id p, const motion& m) noexcept {
  moving_body<double> out{pore_body_at(net, p), {}, {}};
  std::size_t grains = 0;
  std::size_t walls = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const vertex v = net.vertices(p)[k];
    if (v.is_wall()) {
      out.wall_speeds[walls] = dot(m.walls[static_cast<std::size_t>(v.wall())], out.body.walls[walls].normal);
      ++walls;
    } else {
      out.velocities[grains++] = m.of(v.grain(), net.image_of(p, k));
    }
  }
  return out;
}

/// Largest magnitude that a term of the volume rate can have, times the rounding unit.
[[nodiscard]] inline double rounding_of(const moving_body<double>& m) noexcept {
  double speed2 = 0;
  const auto& b = m.body;
  for (std::size_t k = 0; k < b.grain_count; ++k) {
    speed2 = std::max(speed2, norm2(m.velocities[k]));
    for (std::size_t w = 0; w < b.wall_count(); ++w) {
      speed2 = std::max(speed2, m.wall_speeds[w] * m.wall_speeds[w]);
    }
  }
  return 8 * epsilon<double> * longest_edge2(b) * std::sqrt(speed2);
}

}  // namespace detail

/// The volume rate of every cell, from velocities of grains, walls and periodic box. Their sum is the rate of the
/// volume of the region; where every velocity is A x, each is tr(A) times the volume of the cell.
/// \throw parameter_error  a velocity for each grain is wanted
template <executor E = serial>
[[nodiscard]] volume_rates rates_of_volume(const network& net, const motion& m, const E& cores = {}) {
  if (m.velocities.size() != net.grain_count()) {
    throw parameter_error("velocities", std::to_string(m.velocities.size()), std::to_string(net.grain_count()));
  }
  volume_rates out;
  out.values.resize(net.pore_count());
  std::mutex merge;
  cores.blocks(net.pore_count(), [&](std::size_t begin, std::size_t end) {
    double rounding = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const moving_body<double> body = detail::moving_body_at(net, pore_id(i), m);
      out.values[i] = volume_rate(body);
      rounding += detail::rounding_of(body);
    }
    const std::lock_guard lock(merge);
    out.rounding += rounding;
  });
  return out;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
