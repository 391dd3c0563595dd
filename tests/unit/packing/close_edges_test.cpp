// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/packing/close_edges.hpp"

#include "support/random_spheres.hpp"

#include <doctest/doctest.h>

#include <map>

using namespace tetrapore;

namespace {

/// Every pair by brute force: all images within two periods.
std::map<pair_key, close_edge> all_pairs(const std::vector<sphere<double>>& grains, const domain& region,
                                         double reach) {
  std::map<pair_key, close_edge> found;
  for (std::size_t i = 0; i < grains.size(); ++i) {
    for (std::size_t j = i; j < grains.size(); ++j) {
      for (int x = -2; x <= 2; ++x) {
        for (int y = -2; y <= 2; ++y) {
          for (int z = -2; z <= 2; ++z) {
            const image shift{static_cast<std::int8_t>(x), static_cast<std::int8_t>(y), static_cast<std::int8_t>(z)};
            const bool possible = (x == 0 || region.is_periodic(0)) && (y == 0 || region.is_periodic(1)) &&
                                  (z == 0 || region.is_periodic(2)) && (i != j || image{} < shift);
            const auto branch = grains[j].centre + region.shift(shift) - grains[i].centre;
            const double gap = norm(branch) - grains[i].radius - grains[j].radius;
            if (possible && gap < reach) {
              const pair_key key{grain_id(i), vertex(grain_id(j)), shift};
              found[key] = {key, {grains[i].radius, grains[j].radius, gap, branch / norm(branch)}, branch};
            }
          }
        }
      }
    }
    for (const face side : all_faces) {
      const double distance = is_max(side) ? region.bounds.hi[axis_of(side)] - grains[i].centre[axis_of(side)]
                                           : grains[i].centre[axis_of(side)] - region.bounds.lo[axis_of(side)];
      if (region.is_wall(side) && distance - grains[i].radius < reach) {
        vec3<double> out{};
        out[axis_of(side)] = is_max(side) ? 1 : -1;
        const pair_key key{grain_id(i), vertex(side), {}};
        found[key] = {key, {grains[i].radius, infinity<double>, distance - grains[i].radius, out}, distance * out};
      }
    }
  }
  return found;
}

}  // namespace

TEST_CASE("close edges are those that brute force finds, each once, with walls and images in any mix") {
  using enum boundary;
  for (const domain& region :
       {unit_box(wall, wall, wall), unit_box(periodic, wall, periodic), unit_box(periodic, periodic, periodic)}) {
    for (const std::size_t n : {std::size_t{3}, std::size_t{60}}) {
      const auto grains = loose_spheres(n, 5);
      const double reach = 2 * grains[0].radius;
      auto truth = all_pairs(grains, region, reach);
      const auto found = close_edges(grains, region, reach);
      CHECK(found.size() == truth.size());
      bool right = true;
      double worst = 0;
      for (const close_edge& e : found) {
        const auto at = truth.find(e.key);
        right = right && at != truth.end();
        if (at != truth.end()) {
          worst = std::max({worst, std::abs(e.shape.gap - at->second.shape.gap), norm(e.branch - at->second.branch),
                            norm(e.shape.normal - at->second.shape.normal)});
          right = right && e.shape.radius1 == at->second.shape.radius1 && e.shape.radius2 == at->second.shape.radius2;
          truth.erase(at);
        }
      }
      CHECK(right);
      CHECK(worst < 1e-14);
    }
  }
}

TEST_CASE("a pair of a large and a small grain is named from the smaller id, whichever of the two is found first") {
  for (const bool large_first : {true, false}) {
    const sphere<double> large{{0.5, 0.5, 0.5}, 0.3};
    const sphere<double> small{{0.5, 0.5, 0.85}, 0.04};
    const std::vector<sphere<double>> grains = large_first ? std::vector{large, small} : std::vector{small, large};
    const auto found = close_edges(grains, unit_box(boundary::open, boundary::open, boundary::open), 0.02);
    REQUIRE(found.size() == 1);
    CHECK(found[0].key == pair_of(grain_id(0), grain_id(1)));
    CHECK(found[0].shape.radius1 == grains[0].radius);
    CHECK(found[0].shape.normal.z == (large_first ? 1 : -1));
    CHECK(found[0].shape.gap == doctest::Approx(0.01).epsilon(1e-12));
  }
}

TEST_CASE("a grain that fills a period touches its own image, once") {
  const std::vector<sphere<double>> grains{{{0.2, 0.5, 0.5}, 0.5}};
  const auto found = close_edges(grains, unit_box(boundary::periodic, boundary::wall, boundary::open), 1e-3);
  REQUIRE(found.size() == 3);
  CHECK(found[0].key == pair_of(grain_id(0), grain_id(0), {1, 0, 0}));
  CHECK(found[0].shape.gap == 0);
  CHECK(found[0].shape.normal == vec3<double>{1, 0, 0});
  CHECK(found[1].key == pair_of(grain_id(0), face::y_min));
  CHECK(found[1].shape.with_plane());
  CHECK(found[1].branch == vec3<double>{0, -0.5, 0});
}

TEST_CASE("overlaps are found, and no grains have no pairs") {
  const domain region = unit_box(boundary::wall, boundary::wall, boundary::wall);
  const std::vector<sphere<double>> grains{{{0.3, 0.5, 0.5}, 0.2}, {{0.5, 0.5, 0.5}, 0.2}};
  const auto found = close_edges(grains, region, 0);
  REQUIRE(found.size() == 1);
  CHECK(found[0].shape.gap == doctest::Approx(-0.2).epsilon(1e-14));
  CHECK(close_edges({}, region, 1).empty());
}
