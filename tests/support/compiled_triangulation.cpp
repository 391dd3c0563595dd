// SPDX-License-Identifier: BSD-3-Clause
#include "support/compiled_triangulation.hpp"

#include "tetrapore/tessellation/cgal.hpp"

#include <chrono>
#include <utility>
#include <vector>

tetrapore::tessellation compiled_triangulation::operator()(std::span<const tetrapore::sphere<double>> grains,
                                                           const tetrapore::domain& region) const {
  return tetrapore::cgal_triangulation({.wall_device = wall_device})(grains, region);
}

bare_triangulation triangulate_bare(std::span<const tetrapore::sphere<double>> grains) {
  using tetrapore::detail::cgal_vertex;
  using regular = tetrapore::detail::cgal_regular;
  std::vector<std::pair<regular::Weighted_point, cgal_vertex>> sites;
  sites.reserve(grains.size());
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const auto& g = grains[i];
    sites.emplace_back(regular::Weighted_point({g.centre.x, g.centre.y, g.centre.z}, g.radius * g.radius),
                       cgal_vertex{tetrapore::vertex(tetrapore::grain_id(i)), {}});
  }
  regular t;
  const auto start = std::chrono::steady_clock::now();
  t.insert(sites.begin(), sites.end());
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  return {t.number_of_finite_cells(), spent.count()};
}
