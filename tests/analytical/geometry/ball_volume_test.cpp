// SPDX-License-Identifier: BSD-3-Clause
#include "support/walled_cells.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

using namespace tetrapore;
using namespace tetrapore_test;

namespace {

const double ball_of_one = 4 * pi<double> / 3;

polyhedron<double> cube(double lo, double hi) { return box_polyhedron<double>({lo, lo, lo}, {hi, hi, hi}); }

// Volume of the ball of radius 1 about the origin in x > a, y > b, a and b > 0, by slices: Gauss-Legendre over x of the
// circular segment y > b.
long double ball_beyond_edge(long double a, long double b) {
  if (a * a + b * b >= 1) {
    return 0;
  }
  const long double x1 = std::sqrt(1 - b * b);
  // x = x1 - (x1 - a) u², which takes away the root at x1
  constexpr int n = 2000;
  constexpr std::array<long double, 3> node{-0.774596669241483377035853079956L, 0, 0.774596669241483377035853079956L};
  constexpr std::array<long double, 3> weight{5.0L / 18, 8.0L / 18, 5.0L / 18};
  long double sum = 0;
  for (int k = 0; k < n; ++k) {
    for (std::size_t g = 0; g < 3; ++g) {
      const long double u = (k + (1 + node[g]) / 2) / n;
      const long double x = x1 - (x1 - a) * u * u;
      const long double r2 = 1 - x * x;
      const long double c = std::sqrt(std::max(0.0L, r2 - b * b));
      sum += weight[g] / n * (r2 * std::atan2(c, b) - b * c) * 2 * (x1 - a) * u;
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("a ball centred inside, on a face, an edge and a corner of a cube fills 1, 1/2, 1/4 and 1/8 of itself") {
  const auto box = cube(-2, 2);
  CHECK(std::fabs(ball_volume(sphere<double>{{0, 0, 0}, 1}, box) - ball_of_one) < 1e-15);
  CHECK(std::fabs(ball_volume(sphere<double>{{2, 0, 0}, 1}, box) - ball_of_one / 2) < 1e-15);
  CHECK(std::fabs(ball_volume(sphere<double>{{2, -2, 0}, 1}, box) - ball_of_one / 4) < 1e-15);
  CHECK(std::fabs(ball_volume(sphere<double>{{2, -2, 2}, 1}, box) - ball_of_one / 8) < 1e-15);
  CHECK(std::fabs(ball_volume(sphere<double>{{3, 0, 0}, 1}, box)) < 1e-15);                // tangent from outside
  CHECK(std::fabs(ball_volume(sphere<double>{{1, 0, 0}, 1}, box) - ball_of_one) < 1e-15);  // tangent from inside
  CHECK(std::fabs(ball_volume(sphere<double>{{9, 1, 0}, 1}, box)) < 1e-15);
  CHECK(std::fabs(ball_volume(sphere<double>{{0.1, 0.2, -0.3}, 5}, box) - 64) < 64e-15);  // the cube inside the ball
}

TEST_CASE("a ball moved through a face, an edge or a corner loses volume continuously") {
  const auto box = cube(-2, 2);
  for (const double step : {1e-6, 1e-9, 1e-12, 1e-15, 1e-18, -1e-18, -1e-15, -1e-12, -1e-9, -1e-6}) {
    const double slope = pi<double>;  // the area of the section
    const auto at = [&](double y, double z) { return ball_volume(sphere<double>{{2 + step, y, z}, 1}, box); };
    CHECK(std::fabs(at(0, 0) - ball_of_one / 2 + slope * step) < 1e-15);
    CHECK(std::fabs(at(2, 0) - ball_of_one / 4 + slope / 2 * step) < 1e-15);
    CHECK(std::fabs(at(2, 2) - ball_of_one / 8 + slope / 4 * step) < 1e-15);
  }
}

TEST_CASE("a plane cuts a cap off a ball") {
  const auto box = cube(-4, 0);
  for (const double h : {-0.999999, -0.6, -0.5, -0.3, -1e-8, 0.0, 1e-8, 0.3, 0.5, 0.6, 0.999999}) {
    const double cap = pi<double> / 3 * (1 - h) * (1 - h) * (2 + h);
    CHECK(std::fabs(ball_volume(sphere<double>{{h, -2, -2}, 1}, box) - cap) < 1e-15);
    CHECK(std::fabs(cap_volume(1.0, h) - cap) < 1e-15);
  }
  CHECK(cap_volume(1.0, 1.0) == 0);
  CHECK(cap_volume(1.0, -3.0) == ball_volume(1.0));
}

TEST_CASE("six faces of a cube cut six caps while its edges stay outside the ball") {
  for (const double r : {0.51, 0.6, 0.7, 0.7071}) {
    const double caps = 6 * pi<double> / 3 * (r - 0.5) * (r - 0.5) * (2 * r + 0.5);
    CHECK(std::fabs(ball_volume(sphere<double>{{0, 0, 0}, r}, cube(-0.5, 0.5)) - (ball_volume(r) - caps)) < 1e-15);
  }
}

TEST_CASE("the part of a ball beyond an edge agrees with a quadrature by slices") {
  for (const double a : {1e-3, 0.1, 0.45, 0.55, 0.69, 0.7}) {
    for (const double b : {1e-3, 0.2, 0.5, 0.7, 0.9, 0.95}) {
      const auto quarter = box_polyhedron<double>({a, b, -3}, {4, 5, 3});
      const double v = ball_volume(sphere<double>{{0, 0, 0}, 1}, quarter);
      CHECK(std::fabs(v - static_cast<double>(ball_beyond_edge(a, b))) < 2e-15);
    }
  }
}

TEST_CASE("the lens of two balls is that of both caps, one ball when it is inside, nothing when they touch") {
  for (const double d : {0.6, 1.0, 1.3, 1.49}) {
    const double r1 = 1, r2 = 0.5;
    const double t = (d * d + r1 * r1 - r2 * r2) / (2 * d);
    CHECK(std::fabs(lens_volume(r1, r2, d) - (cap_volume(r1, t) + cap_volume(r2, d - t))) < 1e-15);
  }
  CHECK(lens_volume(1.0, 0.5, 1.5) == 0);
  CHECK(lens_volume(1.0, 0.5, 0.5) == ball_volume(0.5));
  CHECK(lens_volume(1.0, 0.5, 0.0) == ball_volume(0.5));
}

TEST_CASE("the union of two balls is their sum less the lens; of three the same when they meet in pairs only") {
  const auto box = cube(-9, 9);
  std::vector<sphere<double>> balls{{{0, 0, 0}, 1}, {{1.2, 0.3, 0.1}, 0.7}};
  const double d = norm(balls[1].centre);
  const double two = ball_volume(1.0) + ball_volume(0.7) - lens_volume(1.0, 0.7, d);
  CHECK(std::fabs(union_volume<double>(box, balls).value - two) < 4e-15);
  balls.push_back({{-1.1, -0.2, 0.5}, 0.4});
  const double three = two + ball_volume(0.4) - lens_volume(1.0, 0.4, norm(balls[2].centre));
  CHECK(std::fabs(union_volume<double>(box, balls).value - three) < 4e-15);
}

TEST_CASE("equal, concentric and engulfed balls count once") {
  const auto box = cube(-9, 9);
  const std::vector<sphere<double>> balls{
      {{0, 0, 0}, 1}, {{0, 0, 0}, 1}, {{0, 0, 0}, 0.5}, {{0.2, 0, 0}, 0.3}, {{0.5, 0, 0}, 0.5}};
  CHECK(std::fabs(union_volume<double>(box, balls).value - ball_of_one) < 4e-15);
}

TEST_CASE("what protrudes beyond the walls: a cap, and at a corner all but the part inside") {
  const domain region = walled({{0, 0, 0}, {10, 10, 10}});
  CHECK(protruding_volume(sphere<double>{{5, 5, 5}, 1}, region) == 0);
  CHECK(protruding_volume(sphere<double>{{1, 5, 5}, 1}, region) == 0);
  CHECK(std::fabs(protruding_volume(sphere<double>{{0.9, 5, 5}, 1}, region) - pi<double> / 3 * 0.01 * 2.9) < 1e-16);
  CHECK(std::fabs(protruding_volume(sphere<double>{{0, 10, 5}, 1}, region) - ball_of_one * 3 / 4) < 2e-15);
  CHECK(std::fabs(protruding_volume(sphere<double>{{0, 10, 0}, 1}, region) - ball_of_one * 7 / 8) < 2e-15);
  domain open_floor = region;
  open_floor.faces[static_cast<std::size_t>(face::z_min)] = boundary::open;
  CHECK(std::fabs(protruding_volume(sphere<double>{{0, 10, 0}, 1}, open_floor) - ball_of_one * 3 / 4) < 2e-15);
  // two caps apart, at opposite walls
  const domain slot = walled({{0, 0, 0}, {1, 10, 10}});
  CHECK(std::fabs(protruding_volume(sphere<double>{{0.5, 5, 5}, 0.6}, slot) - 2 * cap_volume(0.6, 0.5)) < 1e-15);
  random_engine random(8);
  for (int k = 0; k < 500; ++k) {
    const sphere<double> s{uniform_point(random), uniform(random, 0.05, 0.9)};
    const domain unit = walled({{0, 0, 0}, {1, 1, 1}});
    const double inside = ball_volume(s, cube(0, 1));
    CHECK(std::fabs(inside + protruding_volume(s, unit) - ball_volume(s.radius)) < 5e-15);
  }
}
