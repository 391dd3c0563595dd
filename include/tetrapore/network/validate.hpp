// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/connect.hpp"

#include <cmath>
#include <string>

/// \file
/// Checks of a network that came from elsewhere.

namespace tetrapore::inline TETRAPORE_ABI {

/// How strict `validate` is about cells turned inside out.
struct validation {
  /// Least signed volume of a cell, in units of the cube of its longest edge; below it a cell counts as inverted. Flat
  /// cells of exact lattices have the rounding of their coordinates here, ε |x| / edge: the default lets them pass up
  /// to 5,000 edges from the origin. Farther away a caller who expects flat cells lowers it.
  double least_shape = -1e-12;
};

namespace detail {

template <class T>
void expect_size(const std::vector<T>& column, const char* name, std::size_t n, const char* per) {
  if (column.size() != n) {
    throw network_error(std::string("column ") + name, std::to_string(column.size()) + " entries",
                        std::to_string(n) + ", one per " + per);
  }
}

inline void expect_finite(double x, const std::string& where, const char* what) {
  if (!std::isfinite(x)) {
    throw network_error(where, std::string(what) + " = " + short_number(x), "a finite number");
  }
}

/// Signed volume of a cell over the cube of its longest edge, of four grains; walls have no shape to fear.
[[nodiscard]] inline double shape_of(const network& net, pore_id p) noexcept {
  if (net.touches_wall(p)) {
    return 0.0;
  }
  const vec3<double> o = net.grain_sphere(p, 0).centre;
  const vec3<double> a = net.grain_sphere(p, 1).centre - o;
  const vec3<double> b = net.grain_sphere(p, 2).centre - o;
  const vec3<double> c = net.grain_sphere(p, 3).centre - o;
  const double longest = std::sqrt(std::max({norm2(a), norm2(b), norm2(c), norm2(a - b), norm2(b - c), norm2(c - a)}));
  return longest > 0.0 ? triple(a, b, c) / (6.0 * longest * longest * longest) : 0.0;
}

}  // namespace detail

/// Checks that arrays form a network: sizes, indices in range, grains first, throats and pores that know each other and
/// share three vertices, finite numbers, positive radii, cells in positive order.
/// \throw network_error  names the first column, grain, pore or throat at fault, its value, and what was expected
inline void validate(const network& net, const validation& how = {}) {
  const network_arrays& a = net.arrays();
  const std::size_t pores = a.pore_vertices.size();
  const std::size_t throats = a.throat_pores.size();
  const bool periodic = a.region.any_periodic();
  detail::expect_size(a.pore_throats, "pore_throats", pores, "pore");
  detail::expect_size(a.pore_images, "pore_images", periodic ? pores : 0, "pore of a periodic network");
  detail::expect_size(a.power_centres, "power_centres", pores, "pore");
  detail::expect_size(a.volumes, "volumes", pores, "pore");
  detail::expect_size(a.void_volumes, "void_volumes", pores, "pore");
  detail::expect_size(a.throat_slots, "throat_slots", throats, "throat");
  detail::expect_size(a.throat_shifts, "throat_shifts", periodic ? throats : 0, "throat of a periodic network");
  for (std::size_t g = 0; g < a.grains.size(); ++g) {
    const std::string where = "grain " + std::to_string(g);
    for (std::size_t k = 0; k < 3; ++k) {
      detail::expect_finite(a.grains[g].centre[k], where, "coordinate");
    }
    if (!(a.grains[g].radius > 0.0) || !std::isfinite(a.grains[g].radius)) {
      throw network_error(where, "radius " + short_number(a.grains[g].radius), "a finite radius above 0");
    }
  }
  for (std::size_t i = 0; i < pores; ++i) {
    const std::string where = "pore " + std::to_string(i);
    const pore_id p(i);
    bool wall_before = false;
    for (const vertex v : net.vertices(p)) {
      if (!v.is_wall() && v.grain().index() >= a.grains.size()) {
        throw network_error(where, "grain " + std::to_string(v.grain().index()),
                            "a grain below " + std::to_string(a.grains.size()));
      }
      if (v.is_wall() && (v.code() < -6 || !a.region.is_wall(v.wall()))) {
        throw network_error(where, "wall code " + std::to_string(v.code()), "a face that is a wall of the domain");
      }
      if (wall_before && !v.is_wall()) {
        throw network_error(where, "a grain after a wall", "grains first, then walls");
      }
      wall_before = v.is_wall();
    }
    if (net.vertices(p)[0].is_wall()) {
      throw network_error(where, "four walls", "at least one grain");
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const throat_id t = net.throats(p)[k];
      const bool corner = k == 0 && net.vertices(p)[1].is_wall();
      if (!t.valid() && !corner) {
        throw network_error(detail::name_of_facet(i, k), "no throat", "a throat on every facet that has a grain");
      }
      if (t.valid() && t.index() >= throats) {
        throw network_error(detail::name_of_facet(i, k), "throat " + std::to_string(t.index()),
                            "a throat below " + std::to_string(throats));
      }
      if (t.valid()) {
        const bool first = net.pores(t)[0] == p && net.slot(t, 0) == k;
        const bool second = net.pores(t)[1] == p && net.slot(t, 1) == k;
        if (!first && !second) {
          throw network_error(detail::name_of_facet(i, k),
                              "throat " + std::to_string(t.index()) + ", which does not lead back",
                              "a throat that names this pore and this facet");
        }
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      detail::expect_finite(a.power_centres[i][k], where, "power centre");
    }
    detail::expect_finite(a.volumes[i], where, "volume");
    detail::expect_finite(a.void_volumes[i], where, "void volume");
    if (const double shape = detail::shape_of(net, p); !(shape >= how.least_shape)) {
      throw network_error(where, "signed volume / longest edge³ = " + short_number(shape),
                          "vertices in positive order: swap two of them");
    }
  }
  for (std::size_t i = 0; i < throats; ++i) {
    const throat_id t(i);
    const std::string where = "throat " + std::to_string(i);
    for (std::size_t side = 0; side < 2; ++side) {
      const pore_id p = net.pores(t)[side];
      if ((side == 0 || p.valid()) && p.index() >= pores) {
        throw network_error(where, "pore " + std::to_string(p.index()), "a pore below " + std::to_string(pores));
      }
    }
    if (net.is_boundary(t)) {
      if ((a.throat_slots[i] >> 4U) > 5U) {
        throw network_error(where, "boundary face " + std::to_string(a.throat_slots[i] >> 4U), "one of the six faces");
      }
      continue;
    }
    const auto as_cell = [&](pore_id p) {
      cell c;
      c.vertices = net.vertices(p);
      for (std::size_t k = 0; k < 4; ++k) {
        c.images[k] = net.image_of(p, k);
      }
      return c;
    };
    if (!detail::same_facet(as_cell(net.pores(t)[0]), net.slot(t, 0), as_cell(net.pores(t)[1]), net.slot(t, 1),
                            net.shift(t))) {
      throw network_error(where, "two pores whose facets differ", "two pores that share its three vertices");
    }
  }
}

}  // namespace tetrapore::inline TETRAPORE_ABI
