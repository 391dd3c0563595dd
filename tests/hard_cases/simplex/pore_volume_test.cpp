// SPDX-License-Identifier: BSD-3-Clause
#include "support/walled_cells.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

using namespace tetrapore;
using namespace tetrapore_test;

namespace {

sphere<double> at(double x, double y, double z, double r) { return {{x, y, z}, r}; }

pore_body<double> tetrahedron(const std::array<sphere<double>, 4>& grains) {
  pore_body<double> b{};
  b.grain_count = 4;
  b.grains = grains;
  return b;
}

double relative_gap_to_long_double(const pore_body<double>& b, double scale) {
  const auto v = void_volume(b);
  const auto w = void_volume(convert<long double>(b));
  REQUIRE(v.ok());
  REQUIRE(w.ok());
  return std::fabs(v.value - static_cast<double>(w.value)) / scale;
}

}  // namespace

TEST_CASE("a sliver of height 1e-10 has the void of its flat polygon times its height") {
  // a square of side 1 with its diagonals apart by h; the discs of radius 0.3 cover quarter discs of it
  for (const double h : {1e-4, 1e-7, 1e-10}) {
    const auto b = tetrahedron({at(0, 0, 0, 0.3), at(1, 1, 0, 0.3), at(0, 1, h, 0.3), at(1, 0, h, 0.3)});
    const auto v = void_volume(b);
    REQUIRE(v.ok());
    CHECK(std::fabs(total_volume(b) - h / 3) < 1e-16);
    // the column over (x, y) is h times twice the smallest of x, y, 1-x, 1-y high; by symmetry four quarter discs of
    // content integral of 2 min(x, y) = 4 r³ (1 - cos 45°) / 3
    const double covered = 4 * (4.0 / 3) * 0.027 * (1 - std::sqrt(0.5)) * h;
    CHECK(std::fabs(v.value - (h / 3 - covered)) < 1e-16 + 20 * h * h);
  }
}

TEST_CASE("a cell without volume has no void, whichever side rounding puts it on") {
  random_engine random(15);
  for (int k = 0; k < 3000; ++k) {
    // four coplanar centres, some inside the triangle of the others, in a tilted plane
    const auto turn = random_rotation(random);
    auto b = random_tetrahedron(random, 0.05, 0.5);
    for (auto& g : b.grains) {
      g.centre = turn({g.centre.x, g.centre.y, 0});
    }
    const auto intruders = random_spheres(random, 2, 0.1, 0.5);
    const auto v = void_volume<double>(b, intruders);
    REQUIRE(v.ok());
    CHECK(std::fabs(v.value) < 1e-15);
    // ... and collinear, and coincident
    for (auto& g : b.grains) {
      g.centre = turn({g.centre.x, 0, 0});
    }
    CHECK(std::fabs(void_volume(b).value) < 1e-15);
    for (auto& g : b.grains) {
      g.centre = b.grains[0].centre;
    }
    CHECK(std::fabs(void_volume(b).value) < 1e-15);
  }
}

TEST_CASE("walled cells without depth or width have no void") {
  random_engine random(16);
  for (std::size_t grains = 1; grains <= 3; ++grains) {
    for (int k = 0; k < 500; ++k) {
      auto b = random_cell(random, grains);
      for (std::size_t g = 0; g < grains; ++g) {
        b.grains[g].centre[0] = 0;  // on the first wall
      }
      CHECK(std::fabs(void_volume(b).value) < 1e-15);
    }
  }
  pore_body<double> needle = random_cell(random, 3);
  needle.grains[1].centre = needle.grains[0].centre + vec3<double>{0.2, 0, 0};  // one above the other
  CHECK(std::fabs(void_volume(needle).value) < 1e-15);
}

TEST_CASE("a prism with two centres on its wall keeps its void") {
  pore_body<double> b{};
  b.grain_count = 3;
  b.grains = {at(0, 0, 0, 0.2), at(1, 0, 0, 0.2), at(0, 1, 1, 0.2), {}};
  b.walls[0] = {{0, 0, 0}, {0, 0, 1}};
  orient(b);
  const auto v = void_volume(b);
  REQUIRE(v.ok());
  CHECK(std::fabs(total_volume(b) - 1.0 / 6) < 1e-16);
  random_engine random(17);
  int hits = 0;
  constexpr int draws = 400000;
  for (int k = 0; k < draws; ++k) {
    const auto p = uniform_point(random);
    const bool inside = p.x + p.y < 1 && p.z < p.y;
    const bool covered = power(p, b.grains[0]) < 0 || power(p, b.grains[1]) < 0 || power(p, b.grains[2]) < 0;
    hits += inside && !covered ? 1 : 0;
  }
  const double f = hits / static_cast<double>(draws);
  CHECK(std::fabs(f - v.value) < 5 * std::sqrt(f / draws));
}

TEST_CASE("radii of ratio 1 to 1000 keep the digits that the large volumes allow") {
  random_engine random(18);
  double worst = 0;
  for (int k = 0; k < 3000; ++k) {
    // a large grain with three small ones on its surface, and a small grain between three large ones
    const double big = 1000;
    const auto turn = random_rotation(random);
    const auto on_surface = [&](double r) {
      const double x = uniform(random, -2, 2);
      const double y = uniform(random, -2, 2);
      return sphere<double>{turn({x, y, std::sqrt((big + r) * (big + r) - x * x - y * y)}), r};
    };
    auto b = tetrahedron({at(0, 0, 0, big), on_surface(uniform(random, 0.5, 1)), on_surface(uniform(random, 0.5, 1)),
                          on_surface(uniform(random, 0.5, 1))});
    orient(b);
    // the void is a difference of volumes of the order of the large radius times the area of the small triangle
    const double area = norm(triangle_area(b.grains[1].centre, b.grains[2].centre, b.grains[3].centre));
    worst = std::max(worst, relative_gap_to_long_double(b, big * (area + 1)));
    auto c = tetrahedron({at(0, 0, 0, 1), at(big, 0, 0, big), at(0, big, 0, big), at(0, 0, big, big)});
    for (auto& g : c.grains) {
      g.centre = turn(g.centre);
    }
    worst = std::max(worst, relative_gap_to_long_double(c, big * big * big));
  }
  MESSAGE("worst error " << worst << " of the volumes involved");
  CHECK(worst < 1e-15);
}

TEST_CASE("an intruder up to a thousand times larger than the cell cuts it as a plane does") {
  random_engine random(23);
  double worst = 0;
  for (const double r : {1.0, 10.0, 100.0, 1000.0}) {
    for (int k = 0; k < 300; ++k) {
      const auto b = random_tetrahedron(random, 0.01, 0.02);
      vec3<double> p;
      draw(random, b, p);
      const vec3<double> n = random_rotation(random).u;
      const std::vector<sphere<double>> huge{{p - n * r, r}};
      const std::vector<sphere<long double>> wide{convert<long double>(huge[0])};
      const auto v = void_volume<double>(b, huge);
      const auto w = void_volume<long double>(convert<long double>(b), wide);
      REQUIRE(v.ok());
      // the foot of the centre on a face may lie a radius away: terms of r² times the edge
      worst = std::max(worst, std::fabs(v.value - static_cast<double>(w.value)) / (r * r));
      // against the plane through the same point: the surfaces are apart by less than the square of the size over 2 r
      polyhedron<double> above;
      for (const auto& g : b.grains) {
        above.add_vertex(g.centre);
      }
      using corners = std::array<std::uint8_t, 3>;
      for (const auto& f : {corners{1, 2, 3}, corners{0, 3, 2}, corners{0, 1, 3}, corners{0, 2, 1}}) {
        above.add_face({1, 0, 0}, f);
      }
      REQUIRE(above.clip({p, n}) == geometry_status::ok);
      const double kept = above.empty() ? 0.0 : above.volume();
      const double grains = 4 * ball_volume(0.02);
      CHECK(v.value > kept - grains - 1e-12);
      CHECK(v.value < kept + 3.0 * 3.0 / r);
    }
  }
  MESSAGE("worst error " << worst << " of r² times the size");
  CHECK(worst < 2e-14);
}

TEST_CASE("three and four grains that overlap in one region are counted once") {
  random_engine random(19);
  for (int k = 0; k < 20; ++k) {
    auto b = random_tetrahedron(random, 0.5, 0.7);
    const double total = total_volume(b);
    const auto v = void_volume(b);
    REQUIRE(v.ok());
    int hits = 0;
    constexpr int draws = 50000;
    for (int d = 0; d < draws; ++d) {
      vec3<double> p;
      draw(random, b, p);
      bool covered = false;
      for (const auto& g : b.grains) {
        covered = covered || power(p, g) < 0;
      }
      hits += covered ? 0 : 1;
    }
    const double f = v.value / total;
    CHECK(std::fabs(hits / static_cast<double>(draws) - f) < 5 * std::sqrt((f * (1 - f) + 1.0 / draws) / draws));
    CHECK(v.value > -1e-15);
  }
}

TEST_CASE("touching grains take the sectors, and a hair of overlap or distance changes nothing") {
  const double edge = 2;
  const double s = edge / std::sqrt(2.0);
  for (const double dr : {-1e-9, -1e-12, -1e-15, 0.0, 1e-15, 1e-12, 1e-9, 1e-7}) {
    const double r = 1 + dr;
    const auto b = tetrahedron({at(0, 0, 0, r), at(s, s, 0, r), at(0, s, s, r), at(s, 0, s, r)});
    auto o = b;
    orient(o);
    const double omega = std::acos(23.0 / 27.0);
    // six lenses, each seen under the dihedral angle acos(1/3)
    const double lenses = 6 * lens_volume(r, r, edge) * std::acos(1.0 / 3.0) / (2 * pi<double>);
    const double expected = edge * edge * edge / (6 * std::sqrt(2.0)) - 4 * r * r * r * omega / 3 + lenses;
    const auto v = void_volume(o);
    REQUIRE(v.ok());
    CHECK(std::fabs(v.value - expected) < 2e-15);
  }
}

TEST_CASE("a repeated intruder, an own grain as intruder and a ball far away change nothing") {
  random_engine random(22);
  for (int k = 0; k < 500; ++k) {
    const auto b = random_tetrahedron(random, 0.1, 0.5);
    const auto one = random_spheres(random, 1, 0.1, 0.4);
    const double v = void_volume<double>(b, one).value;
    const std::vector<sphere<double>> more{one[0], b.grains[2], one[0], at(9, 9, 9, 1), b.grains[0], b.grains[1]};
    CHECK(std::fabs(void_volume<double>(b, more).value - v) < 2e-15);
  }
}

TEST_CASE("input that is not a number is refused, not answered") {
  auto b = tetrahedron({at(0, 0, 0, 0.4), at(1, 0, 0, 0.4), at(0, 1, 0, 0.4), at(0, 0, 1, 0.4)});
  b.grains[2].centre.y = std::nan("");
  CHECK(void_volume(b).reason == geometry_status::not_finite);
  b.grains[2].centre.y = 1;
  b.grains[3].radius = std::nan("");
  CHECK(void_volume(b).reason == geometry_status::not_finite);
  b.grains[3].radius = 0.4;
  const std::vector<sphere<double>> broken{at(0.2, std::nan(""), 0.2, 0.3)};
  CHECK(void_volume<double>(b, broken).reason == geometry_status::not_finite);
  const std::vector<sphere<double>> endless{at(0.2, 0.1, 0.2, infinity<double>)};
  CHECK(void_volume<double>(b, endless).reason == geometry_status::not_finite);
}
