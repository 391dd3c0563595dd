// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/measure.hpp"

#include <concepts>
#include <span>
#include <vector>

/// \file
/// From spheres to a network: what any engine of triangulation takes and gives.

namespace tetrapore::inline TETRAPORE_ABI {

/// A grain that is no vertex of the network: its power cell is empty, so its ball lies inside the union of the others.
struct hidden_grain {
  grain_id grain;
  grain_id twin;  ///< the grain with the same centre that stands for it; invalid when it is engulfed by others
};

/// What a triangulation has to say beside its network.
struct tessellation_report {
  std::vector<hidden_grain> hidden;  ///< ascending in grain
  std::size_t ghosts = 0;            ///< periodic copies that were inserted beside the grains
  measure_report measured;
};

/// A network with the report of its making.
struct tessellation {
  network net;
  tessellation_report report;
};

/// Makes networks.
/// Syntax: `engine(spheres, region)` with the grains in the caller's order.
/// Semantics: the network is the regular (power) triangulation of the grains, with the walls of the region as vertices
/// at infinity: the dual of the power diagram restricted to the box. Every grain is a vertex or is reported hidden.
/// Throws packing_error before anything is made when a sphere or the region is not acceptable.
/// Models: cgal_triangulation.
template <class E>
concept tessellation_engine = requires(E engine, std::span<const sphere<double>> grains, const domain& region) {
  { engine(grains, region) } -> std::same_as<tessellation>;
};

/// Triangulates any range of grains (see grain_like) in a region.
template <class Grains, tessellation_engine Engine>
[[nodiscard]] tessellation tessellate(const Grains& grains, const domain& region, const Engine& engine) {
  std::vector<sphere<double>> spheres;
  for (const auto& g : grains) {
    spheres.push_back(as_sphere(g));
  }
  return engine(std::span<const sphere<double>>(spheres), region);
}

}  // namespace tetrapore::inline TETRAPORE_ABI
