// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/simplex/throat_geometry.hpp"

#include "support/walled_cells.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace tetrapore;
using namespace tetrapore_test;

namespace {

throat<double> random_throat(random_engine& random, std::size_t grains, double smallest, double largest) {
  throat<double> t{};
  t.grain_count = static_cast<std::uint8_t>(grains);
  for (std::size_t k = 0; k < grains; ++k) {
    t.grains[k] = {uniform_point(random), uniform(random, smallest, largest)};
  }
  for (std::size_t w = 0; w < t.wall_count(); ++w) {
    t.walls[w].normal[w] = 1;
  }
  const auto& c = t.grains;
  t.area_vector = grains == 3   ? triangle_area(c[0].centre, c[1].centre, c[2].centre)
                  : grains == 2 ? trapezoid_area(c[0].centre, c[1].centre, t.walls[0])
                                : rectangle_area(c[0].centre, t.walls[0], t.walls[1]);
  return t;
}

// A uniform point of the facet, or of the rectangle around a trapezoid; false outside.
bool draw(random_engine& random, const throat<double>& t, vec3<double>& p) {
  const auto& c = t.grains;
  double u = uniform(random);
  double v = uniform(random);
  if (t.grain_count == 3) {
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    p = c[0].centre + (c[1].centre - c[0].centre) * u + (c[2].centre - c[0].centre) * v;
    return true;
  }
  if (t.grain_count == 2) {
    const auto top = c[0].centre + (c[1].centre - c[0].centre) * u;
    const double deepest = std::max(c[0].centre.x, c[1].centre.x);
    p = {v * deepest, top.y, top.z};
    return p.x <= top.x;
  }
  p = {u * c[0].centre.x, v * c[0].centre.y, c[0].centre.z};
  return true;
}

}  // namespace

TEST_CASE("the fluid area of random throats of every shape agrees with drawn points") {
  random_engine random(41);
  for (std::size_t grains = 1; grains <= 3; ++grains) {
    for (int k = 0; k < 100; ++k) {
      const auto t = random_throat(random, grains, 0.02, 0.6);
      const auto fluid = fluid_area(t);
      REQUIRE(fluid.ok());
      CHECK(fluid.value > -1e-15);
      CHECK(fluid.value <= facet_area(t) + 1e-15);
      const double deepest = std::max(t.grains[0].centre.x, t.grains[1].centre.x);
      const auto across = t.grains[1].centre - t.grains[0].centre;
      const double envelope = grains == 2 ? deepest * std::hypot(across.y, across.z) : facet_area(t);
      constexpr int draws = 20000;
      int hits = 0;
      for (int d = 0; d < draws; ++d) {
        vec3<double> p;
        bool open = draw(random, t, p);
        for (std::size_t g = 0; g < grains; ++g) {
          open = open && power(p, t.grains[g]) >= 0;
        }
        hits += open ? 1 : 0;
      }
      const double f = std::min(1.0, std::max(0.0, fluid.value / envelope));
      const double spread = std::sqrt((f * (1 - f) + 1.0 / draws) / draws);
      CHECK(std::fabs(hits / static_cast<double>(draws) - f) < 5 * spread);
    }
  }
}

TEST_CASE("three touching discs leave the triangle less half a disc, unequal ones less their sectors") {
  const double s = std::sqrt(3.0);
  throat<double> t{};
  t.grain_count = 3;
  t.grains = {sphere<double>{{0, 0, 5}, 1}, sphere<double>{{2, 0, 5}, 1}, sphere<double>{{1, s, 5}, 1}};
  CHECK(std::fabs(fluid_area(t).value - (s - pi<double> / 2)) < 1e-15);
  // right triangle 3, 4, 5 between radii 1, 2, 3
  t.grains = {sphere<double>{{0, 0, 0}, 1}, sphere<double>{{3, 0, 0}, 2}, sphere<double>{{0, 4, 0}, 3}};
  const double sectors = (1 * pi<double> / 2 + 4 * std::atan2(4.0, 3.0) + 9 * std::atan2(3.0, 4.0)) / 2;
  CHECK(std::fabs(fluid_area(t).value - (6 - sectors)) < 4e-15);
}

TEST_CASE("a disc that sticks out of the opposite edge, a wall or a neighbour gives the rest back") {
  throat<double> t{};
  t.grain_count = 3;
  // the top disc, at height 0.5, reaches 0.1 below the base: a segment is given back
  t.grains = {sphere<double>{{-2, 0, 0}, 0.1}, sphere<double>{{2, 0, 0}, 0.1}, sphere<double>{{0, 0.5, 0}, 0.6}};
  const double segment = 0.36 * std::acos(0.5 / 0.6) - 0.5 * std::sqrt(0.36 - 0.25);
  const double top = 2 * std::atan2(2.0, 0.5);
  const double base = std::atan2(0.5, 2.0);
  CHECK(std::fabs(fluid_area(t).value - (1 - (0.36 * top + 2 * 0.01 * base) / 2 + segment)) < 1e-15);
  // one grain in an edge of the box, reaching beyond both walls: a square of side 0.5 minus what it covers is empty
  t.grain_count = 1;
  t.grains[0] = {{0.5, 0.5, 0}, 0.8};
  t.walls = {plane<double>{{0, 0, 0}, {1, 0, 0}}, plane<double>{{0, 0, 0}, {0, 1, 0}}};
  CHECK(std::fabs(fluid_area(t).value) < 1e-15);
  t.grains[0].radius = 0.5;
  CHECK(std::fabs(fluid_area(t).value - 0.25 * (1 - pi<double> / 4)) < 1e-16);
  // equal discs over each other, half of each below the wall line
  t.grain_count = 2;
  t.grains = {sphere<double>{{0, 0, 0}, 1}, sphere<double>{{0, 0, 1}, 1}, {}};
  CHECK(fluid_area(t).value == 0);  // on the wall: no facet
  t.grains = {sphere<double>{{3, 0, 0}, 1}, sphere<double>{{3, 0, 1}, 1}, {}};
  const double lens = 2 * std::acos(0.5) - 0.5 * std::sqrt(3.0);
  const double quarters = pi<double> / 2 - lens / 2;
  // beyond each end line the disc of the other grain only touches, so both quarter discs lie inside
  CHECK(std::fabs(fluid_area(t).value - (3 - quarters)) < 2e-15);
}

TEST_CASE("a throat whose coordinates are not numbers is refused") {
  throat<double> t{};
  t.grain_count = 3;
  t.grains = {sphere<double>{{0, 0, 0}, 1}, sphere<double>{{3, std::nan(""), 0}, 1}, sphere<double>{{0, 4, 0}, 1}};
  CHECK(fluid_area(t).reason == geometry_status::not_finite);
}
