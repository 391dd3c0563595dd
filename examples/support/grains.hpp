// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/io/read_packing.hpp"
#include "tetrapore/packing/check.hpp"
#include "tetrapore/tessellation/tessellation.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>

/// \file
/// The grains of an example: from a file, with their box, and what the user should know about them.

namespace support {

namespace tp = tetrapore;

/// Where grains come from, and how they are to be read.
struct grain_source {
  std::filesystem::path path;
  double scale = 1;                             ///< metres per unit of the file
  std::optional<std::array<bool, 3>> periodic;  ///< axes; none: as the file says
  bool walls = true;                            ///< of the box; without: the hull of the centres
};

/// The smallest box that holds the grains whole.
[[nodiscard]] inline tp::box tight_box(std::span<const tp::sphere<double>> grains) {
  constexpr double far = std::numeric_limits<double>::infinity();
  tp::box b{{far, far, far}, {-far, -far, -far}};
  for (const auto& g : grains) {
    for (std::size_t k = 0; k < 3; ++k) {
      b.lo[k] = std::min(b.lo[k], g.centre[k] - g.radius);
      b.hi[k] = std::max(b.hi[k], g.centre[k] + g.radius);
    }
  }
  return b;
}

/// Says how many grains reach through a wall: the part outside is cut off, exactly.
inline void report_protruding(const tp::packing& packing, bool walls) {
  std::size_t count = 0;
  double most = 0;
  for (const auto& g : packing.grains) {
    double deepest = 0;
    for (std::size_t k = 0; k < 3 && packing.bounds && walls; ++k) {
      if (!packing.periodic[k]) {
        deepest = std::max({deepest, g.radius - (g.centre[k] - packing.bounds->lo[k]),
                            g.radius - (packing.bounds->hi[k] - g.centre[k])});
      }
    }
    // A box and a radius that were rounded to nine digits meet to nine digits: that is touching, not reaching through.
    count += deepest > 1e-8 * g.radius ? 1 : 0;
    most = std::max(most, deepest / g.radius);
  }
  if (count > 0) {
    std::fprintf(stderr, "%zu grains reach through a wall, by up to %.3g of their radius: what is outside is clipped\n",
                 count, most);
  }
}

/// The grains of a file. Where it names no box, walls touch the outermost grains. What is worth knowing goes to stderr.
/// \throw tetrapore::setup_error  what is wrong in the file
[[nodiscard]] inline tp::packing read_grains(const grain_source& from) {
  auto [packing, report] = tp::io::read_packing(from.path, {.scale = from.scale, .periodic = from.periodic});
  std::fprintf(stderr, "read %zu grains from %s (%s)\n", packing.grains.size(), report.source.c_str(),
               describe(report.format));
  for (const std::string& warning : report.warnings) {
    std::fprintf(stderr, "warning: %s\n", warning.c_str());
  }
  if (!packing.bounds && from.walls && !packing.grains.empty()) {
    packing.bounds = tight_box(packing.grains);
    std::fprintf(stderr,
                 "the file names no box: walls touch the outermost grains (--no-walls for the hull of the centres)\n");
  }
  tp::check(packing, from.walls);
  report_protruding(packing, from.walls);
  return packing;
}

/// Says how large a network is, and which grains are no vertices of it.
inline void report_mesh(const tp::tessellation& mesh) {
  std::fprintf(stderr, "%zu pores, %zu throats\n", mesh.net.pore_count(), mesh.net.throat_count());
  for (const tp::hidden_grain& h : mesh.report.hidden) {
    std::fprintf(stderr, "warning: grain %zu is no vertex of the network: it lies inside %s\n", h.grain.index(),
                 h.twin.valid() ? ("its twin, grain " + std::to_string(h.twin.index())).c_str() : "others");
  }
}

}  // namespace support
