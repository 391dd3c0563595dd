// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/tessellation/tessellation.hpp"

/// \file
/// cgal_triangulation compiled once, for tests of what comes after it: a translation unit is spared CGAL's headers, 20
/// s of the compiler. A program that includes this is linked to compiled_triangulation.cpp by itself.

struct compiled_triangulation {
  [[nodiscard]] tetrapore::tessellation operator()(std::span<const tetrapore::sphere<double>> grains,
                                                   const tetrapore::domain& region) const;
};
static_assert(tetrapore::tessellation_engine<compiled_triangulation>);
