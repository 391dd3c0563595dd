// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/edges.hpp"
#include "tetrapore/network/gather.hpp"
#include "tetrapore/simplex/pore_volume.hpp"

#include <cmath>
#include <string>
#include <vector>

/// \file
/// Volume of the grains inside the region of a network, grain by grain: nothing is shared with the volumes of the
/// pores, so that the two can be held against the volume of the region.

namespace tetrapore::inline TETRAPORE_ABI {

namespace detail {

/// The hull facets of a network as planes, normal inward; coplanar ones once.
[[nodiscard]] inline std::vector<plane<double>> hull_planes(const network& net) {
  std::vector<plane<double>> planes;
  for (std::size_t i = 0; i < net.throat_count(); ++i) {
    const throat_id t(i);
    if (!net.is_boundary(t)) {
      continue;
    }
    const throat<double> f = facet_at(net, t);
    const double area = norm(f.area_vector);
    if (area > 0.0) {
      planes.push_back({f.grains[0].centre, -f.area_vector / area});
    }
  }
  return planes;
}

[[nodiscard]] inline bool same_plane(const plane<double>& a, const plane<double>& b, double length) noexcept {
  // Planes of the same face of a hull differ by the rounding of its corners. To take two of them for one misplaces at
  // most this share of the ball's radius over its section: well below the 1e-12 of the region that the sum is held to.
  constexpr double rounding = 1e-12;
  return norm2(a.normal - b.normal) < rounding * rounding && std::abs(b.distance(a.point)) < rounding * length;
}

}  // namespace detail

/// Volume of the union of the grains inside the region [m³]: inside the walls, on a periodic axis once, on an open side
/// up to the hull of the centres. Each grain counts inside its own power cell.
/// \par Accuracy  a few 1e-15 of the sum
/// \throw packing_error  naming the grain, where more planes cut it than the kernel holds
[[nodiscard]] inline double solid_volume(const network& net) {
  const std::vector<plane<double>> hull = detail::hull_planes(net);
  std::vector<std::vector<sphere<double>>> others(net.grain_count());
  for (const vertex_pair& e : edges_of(net)) {
    if (e.second.is_wall() || e.first.is_wall()) {
      continue;
    }
    const sphere<double>& a = net.grains()[e.first.grain().index()];
    const sphere<double>& b = net.grains()[e.second.grain().index()];
    const vec3<double> shift = net.region().shift(e.at);
    if (detail::overlaps(norm2(b.centre + shift - a.centre), a.radius, b.radius)) {
      others[e.first.grain().index()].push_back({b.centre + shift, b.radius});
      others[e.second.grain().index()].push_back({a.centre - shift, a.radius});
    }
  }
  std::vector<bool> used(net.grain_count(), false);
  for (std::size_t i = 0; i < net.pore_count(); ++i) {
    for (const vertex v : net.vertices(pore_id(i))) {
      if (!v.is_wall()) {
        used[v.grain().index()] = true;
      }
    }
  }
  double sum = 0.0;
  double lost = 0.0;  // compensation of the running sum
  std::vector<plane<double>> cuts;
  for (std::size_t g = 0; g < net.grain_count(); ++g) {
    if (!used[g]) {
      continue;  // hidden: inside the union of the others
    }
    const sphere<double>& ball = net.grains()[g];
    const double r = ball.radius;
    cuts.clear();
    const auto cut = [&](const plane<double>& w) {
      const plane<double> local{w.point - ball.centre, w.normal};
      if (local.distance({}) >= r) {
        return;
      }
      for (const auto& before : cuts) {
        if (detail::same_plane(before, local, r)) {
          return;
        }
      }
      cuts.push_back(local);
    };
    for (const face f : all_faces) {
      if (net.region().is_wall(f)) {
        cut(net.region().wall(f));
      }
    }
    for (const auto& w : hull) {
      cut(w);
    }
    for (const auto& other : others[g]) {
      cut(detail::radical_plane(ball, other));
    }
    double volume = ball_volume(r);
    if (!cuts.empty()) {
      polyhedron<double> part = box_polyhedron(vec3<double>{-2 * r, -2 * r, -2 * r}, vec3<double>{2 * r, 2 * r, 2 * r});
      for (const auto& w : cuts) {
        if (const geometry_status fit = part.clip(w); verdict_of(fit) != verdict::ok) {
          throw packing_error("grain " + std::to_string(g), describe(fit), "a grain that a few planes cut");
        }
      }
      volume = ball_volume(sphere<double>{{}, r}, part);
    }
    const double y = volume - lost;
    const double next = sum + y;
    lost = (next - sum) - y;
    sum = next;
  }
  return sum;
}

/// Sum with its rounding carried along (Neumaier).
[[nodiscard]] inline double compensated_sum(std::span<const double> values) noexcept {
  double sum = 0.0;
  double lost = 0.0;
  for (const double v : values) {
    const double next = sum + v;
    lost += std::abs(sum) >= std::abs(v) ? (sum - next) + v : (v - next) + sum;
    sum = next;
  }
  return sum + lost;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
