// SPDX-License-Identifier: BSD-3-Clause
#include "support/walled_cells.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace tetrapore;
using namespace tetrapore_test;

TEST_CASE("the power centre has equal power to all grains and lies on all walls") {
  random_engine random(4);
  for (std::size_t grains = 1; grains <= 4; ++grains) {
    for (int k = 0; k < 5000; ++k) {
      const auto b = random_cell(random, grains);
      // the error is the rounding of the conditions (1e-16) over the height of the flattest direction
      if (total_volume(b) < 1e-3) {
        continue;
      }
      const auto node = power_centre(b);
      REQUIRE(node.ok());
      for (std::size_t g = 1; g < grains; ++g) {
        CHECK(std::fabs(power(node.value, b.grains[g]) - power(node.value, b.grains[0])) <
              1e-12 * (1 + norm2(node.value)));
      }
      for (std::size_t w = 0; w < b.wall_count(); ++w) {
        CHECK(std::fabs(b.walls[w].distance(node.value)) < 1e-13 * (1 + norm(node.value)));
      }
    }
  }
}

TEST_CASE("four equal spheres at the corners of a cube have their power centre in its middle, exactly") {
  const auto at = [](double x, double y, double z) { return sphere<double>{{x, y, z}, 0.25}; };
  const auto node = power_centre(at(0, 0, 0), at(1, 1, 0), at(1, 0, 1), at(0, 1, 1));
  REQUIRE(node.ok());
  CHECK(node.value == vec3<double>{0.5, 0.5, 0.5});
}

TEST_CASE("a larger sphere pushes the power centre away by the difference of squared radii") {
  // spheres on the axes at distance 1: the centre x of each axis solves 2 x = 1 - (r² - r0²)
  const auto node = power_centre(sphere<double>{{0, 0, 0}, 0.5}, sphere<double>{{1, 0, 0}, 0.75},
                                 sphere<double>{{0, 1, 0}, 0.5}, sphere<double>{{0, 0, 1}, 0.25});
  REQUIRE(node.ok());
  CHECK(node.value == vec3<double>{(1 - 0.3125) / 2, 0.5, (1 + 0.1875) / 2});
}

TEST_CASE("an offset of a million boxes moves the power centre by the offset, to the rounding of the coordinates") {
  random_engine random(6);
  for (int k = 0; k < 2000; ++k) {
    auto b = random_tetrahedron(random);
    if (total_volume(b) < 1e-3) {
      continue;
    }
    // coordinates that the offset leaves exact
    for (auto& g : b.grains) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        g.centre[axis] = std::round(g.centre[axis] * 0x1p20) / 0x1p20;
      }
    }
    const auto here = power_centre(b);
    auto far = b;
    const vec3<double> offset{0x1p20, -0x1p20, 0x1p21};
    for (auto& g : far.grains) {
      g.centre += offset;
    }
    const auto there = power_centre(far);
    REQUIRE(here.ok());
    REQUIRE(there.ok());
    CHECK(norm(there.value - offset - here.value) < 1e-9 * (1 + norm(here.value)));
    CHECK(total_volume(far) == total_volume(b));
    CHECK(void_volume(far).value == void_volume(b).value);
  }
}

TEST_CASE("coplanar centres are flat, and coordinates that are not numbers are not finite") {
  const auto at = [](double x, double y, double z) { return sphere<double>{{x, y, z}, 0.5}; };
  const auto square = power_centre(at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0));
  CHECK(square.reason == geometry_status::flat);
  CHECK(square.kind() == verdict::refused);
  CHECK(std::isnan(square.value.x));
  const auto jittered = power_centre(at(0, 0, 0), at(1, 0, 1e-16), at(1, 1, -1e-16), at(0, 1, 0));
  CHECK(jittered.reason == geometry_status::flat);
  const plane<double> floor{{0, 0, 0}, {0, 0, 1}};
  CHECK(power_centre(at(0, 0, 1), at(1, 0, 1), at(2, 0, 1), floor).reason == geometry_status::flat);
  const double nan = std::nan("");
  CHECK(power_centre(at(0, 0, 0), at(1, nan, 0), at(0, 1, 0), at(0, 0, 1)).reason == geometry_status::not_finite);
  const double inf = infinity<double>;
  CHECK(power_centre(at(0, 0, 0), at(inf, 0, 0), at(0, 1, 0), at(0, 0, 1)).reason == geometry_status::not_finite);
}
