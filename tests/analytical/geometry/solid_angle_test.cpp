// SPDX-License-Identifier: BSD-3-Clause
#include "support/walled_cells.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace tetrapore;
using namespace tetrapore_test;

TEST_CASE("an octant spans pi/2, a corner of the regular tetrahedron acos(23/27), and the sign is the orientation") {
  const vec3<double> x{3, 0, 0}, y{0, 0.1, 0}, z{0, 0, 7};
  CHECK(std::fabs(solid_angle(x, y, z) - pi<double> / 2) < 1e-15);
  CHECK(std::fabs(solid_angle(y, x, z) + pi<double> / 2) < 1e-15);
  const vec3<double> a{1, 1, 0}, b{0, 1, 1}, c{1, 0, 1};
  CHECK(std::fabs(std::fabs(solid_angle(a, b, c)) - std::acos(23.0 / 27.0)) < 1e-15);
}

TEST_CASE("the solid angles of a tetrahedron at an inner point sum to 4 pi, at an outer point to 0") {
  random_engine random(1);
  for (int k = 0; k < 10000; ++k) {
    auto b = random_tetrahedron(random);
    const auto at = [&](const vec3<double>& p) {
      const auto& g = b.grains;
      const auto a0 = g[0].centre - p, a1 = g[1].centre - p, a2 = g[2].centre - p, a3 = g[3].centre - p;
      return solid_angle(a1, a2, a3) + solid_angle(a0, a3, a2) + solid_angle(a0, a1, a3) + solid_angle(a0, a2, a1);
    };
    // a point near a side sees two corners nearly opposite, and the angle between keeps few digits
    const auto& g = b.grains;
    const vec3<double> p = (g[0].centre + g[1].centre + g[2].centre * 1.5 + g[3].centre * 2.0) / 5.5;
    if (total_volume(b) < 0.01) {
      continue;
    }
    // heights above 0.02 lose two digits of the four angles
    CHECK(std::fabs(at(p) - 4 * pi<double>) < 4e-14);
    CHECK(std::fabs(at(p + vec3<double>{2, 0, 0})) < 1e-14);
  }
}

TEST_CASE("a flat pyramid of height 1e-10 spans 2 pi less 6 sqrt(3) times the height") {
  // The three sides are arcs of elevation atan(tan h cos phi / cos 60°), so each takes 2 h tan 60° from the half
  // sphere.
  for (const double h : {1e-6, 1e-8, 1e-10, 1e-12}) {
    const double s = std::sqrt(0.75);
    const double omega = solid_angle(vec3<double>{1, 0, h}, vec3<double>{-0.5, s, h}, vec3<double>{-0.5, -s, h});
    CHECK(std::fabs(omega - (2 * pi<double> - 6 * std::sqrt(3.0) * h)) < 2e-15 + 20 * h * h * h);
  }
}

TEST_CASE("slivers of height 1e-10 have solid angles good to 1e-15, at any offset that the coordinates can hold") {
  random_engine random(2);
  double worst = 0;
  for (int k = 0; k < 20000; ++k) {
    // corners on the unit circle, apart by at least 0.3 rad, apex at the centre, lifted by the height
    const double first = uniform(random, 0.3, 1.9);
    const double second = first + uniform(random, 0.3, 1.9);
    const double h = std::pow(10.0, uniform(random, -10, -1));
    const auto corner = [&](double angle) { return vec3<double>{std::cos(angle), std::sin(angle), h}; };
    const auto a = corner(0), b = corner(first), c = corner(second);
    const auto wide = [](const vec3<double>& p) { return vec3<long double>{p.x, p.y, p.z}; };
    const auto exact = solid_angle(wide(a), wide(b), wide(c));
    // two corners nearly opposite leave the side between them, and so the angle, undetermined
    if (second < 2.8 || second > 3.5) {
      worst = std::max(worst, static_cast<double>(std::fabs(static_cast<long double>(solid_angle(a, b, c)) - exact)));
    }
  }
  MESSAGE("worst error " << worst);
  CHECK(worst < 4e-15);
}
