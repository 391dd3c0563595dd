// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/geometry/domain.hpp"
#include "tetrapore/packing/neighbours.hpp"
#include "tetrapore/simplex/edge.hpp"
#include "tetrapore/simplex/pair_store.hpp"

#include <span>
#include <vector>

/// \file
/// Close pairs as a pair law sees them: of two grains, across periodic faces too, and of a grain and a wall.

namespace tetrapore::inline TETRAPORE_ABI {

/// A pair within reach, by name and shape.
struct close_edge {
  pair_key key;
  edge<double> shape;   ///< from grain a to b
  vec3<double> branch;  ///< from the centre of a to that of b, or to its foot on the wall [m]
};

/// Calls f(close_edge) once for every pair of surfaces less than `reach` apart, overlapping ones always: two grains, a
/// grain and an image along a periodic axis (its own included), a grain and a wall. In an order that depends on the
/// grains alone, walls last.
/// \par Units     [m]
/// \par Domain    two grains at one place have no normal: it is NaN (packing/check.hpp finds them)
/// \par Accuracy  a gap is a difference of coordinates: an epsilon of the coordinates, not of the gap
/// \throw packing_error  a grain or a reach many periods long, see size_class_grids
template <class F>
void for_each_close_edge(std::span<const sphere<double>> grains, const domain& region, double reach, F&& f) {
  if (grains.empty()) {
    return;
  }
  bool open = true;
  for (const face side : all_faces) {
    open = open && region.at(side) == boundary::open;
  }
  const size_class_grids search(grains, open ? bounding_box(grains) : region.bounds,
                                {region.is_periodic(0), region.is_periodic(1), region.is_periodic(2)}, reach);
  search.for_each_pair([&](const close_pair& pair, const vec3<double>& apart) {
    const pair_key key = pair_of(grain_id(pair.i), grain_id(pair.j), pair.shift);
    const vec3<double> branch = pair.j < pair.i ? -apart : apart;
    const double distance = norm(branch);
    const double r1 = grains[key.a.index()].radius;
    const double r2 = grains[key.b.grain().index()].radius;
    const double gap = distance - r1 - r2;
    if (gap < reach) {
      f(close_edge{key, {r1, r2, gap, branch / distance}, branch});
    }
  });
  for (const face side : all_faces) {
    if (!region.is_wall(side)) {
      continue;
    }
    const plane<double> wall = region.wall(side);
    for (std::size_t i = 0; i < grains.size(); ++i) {
      const double distance = wall.distance(grains[i].centre);
      const double gap = distance - grains[i].radius;
      if (gap < reach) {
        f(close_edge{pair_of(grain_id(i), side),
                     {grains[i].radius, infinity<double>, gap, -wall.normal},
                     -distance * wall.normal});
      }
    }
  }
}

/// The pairs of for_each_close_edge, in its order.
[[nodiscard]] inline std::vector<close_edge> close_edges(std::span<const sphere<double>> grains, const domain& region,
                                                         double reach) {
  std::vector<close_edge> found;
  for_each_close_edge(grains, region, reach, [&](const close_edge& e) { found.push_back(e); });
  return found;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
