// SPDX-License-Identifier: BSD-3-Clause
#include "support/compiled_triangulation.hpp"

#include "tetrapore/tessellation/cgal.hpp"

tetrapore::tessellation compiled_triangulation::operator()(std::span<const tetrapore::sphere<double>> grains,
                                                           const tetrapore::domain& region) const {
  return tetrapore::cgal_triangulation{}(grains, region);
}
