// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/tessellation/tessellation.hpp"

#include <cstddef>
#include <span>

/// \file
/// cgal_triangulation compiled once, for tests of what comes after it: a translation unit is spared CGAL's headers, 20
/// s of the compiler. A program that includes this is linked to compiled_triangulation.cpp by itself.

/// cgal_triangulation with its option of the walls.
struct compiled_triangulation {
  double wall_device = 0x1p24;

  [[nodiscard]] tetrapore::tessellation operator()(std::span<const tetrapore::sphere<double>> grains,
                                                   const tetrapore::domain& region) const;
};
static_assert(tetrapore::tessellation_engine<compiled_triangulation>);

/// What the bare call of CGAL for a range of spheres yields and takes, without walls, pores or measures.
struct bare_triangulation {
  std::size_t cells = 0;  ///< finite ones
  double seconds = 0;     ///< of the insertion alone
};
[[nodiscard]] bare_triangulation triangulate_bare(std::span<const tetrapore::sphere<double>> grains);
