// SPDX-License-Identifier: BSD-3-Clause
#include "support/walled_cells.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace tetrapore;
using namespace tetrapore_test;

namespace {

// Fraction of the cell outside all balls, by drawing points; `z` is its distance from the expected in standard errors.
struct sample {
  double total_z;
  double void_z;
};

sample draw_volumes(random_engine& random, const pore_body<double>& b, const std::vector<sphere<double>>& balls,
                    double envelope, double expected_total, double expected_void, int draws) {
  int in_cell = 0;
  int in_void = 0;
  for (int k = 0; k < draws; ++k) {
    vec3<double> p;
    if (!draw(random, b, p)) {
      continue;
    }
    ++in_cell;
    const bool covered =
        std::any_of(balls.begin(), balls.end(), [&](const sphere<double>& s) { return power(p, s) < 0; });
    in_void += covered ? 0 : 1;
  }
  // the error of the expected fraction itself, so that a fraction of 0 or 1 has no zero spread
  const auto z = [&](int hits, double expected) {
    const double f = std::clamp(expected / envelope, 0.0, 1.0);
    const double spread = std::sqrt((f * (1 - f) + 1.0 / draws) / draws);
    return (hits / static_cast<double>(draws) - f) / spread;
  };
  return {z(in_cell, expected_total), z(in_void, expected_void)};
}

// Volume from which `draw` draws: the cell, if every corner were as deep as the deepest.
double envelope_of(const pore_body<double>& b) {
  pore_body<double> e = b;
  for (std::size_t w = 0; w < b.wall_count(); ++w) {
    double deepest = 0;
    for (std::size_t k = 0; k < b.grain_count; ++k) {
      deepest = std::max(deepest, b.walls[w].distance(b.grains[k].centre));
    }
    for (std::size_t k = 0; k < b.grain_count; ++k) {
      e.grains[k].centre += b.walls[w].normal * (deepest - b.walls[w].distance(b.grains[k].centre));
    }
  }
  if (b.grain_count == 4) {
    return total_volume(b);
  }
  // area of the projected simplex times the depths
  double depth = 1;
  for (std::size_t w = 0; w < b.wall_count(); ++w) {
    depth *= e.walls[w].distance(e.grains[0].centre);
  }
  if (b.grain_count == 3) {
    return std::fabs(triple(e.grains[1].centre - e.grains[0].centre, e.grains[2].centre - e.grains[0].centre,
                            b.walls[0].normal)) /
           2 * depth;
  }
  if (b.grain_count == 2) {
    return std::fabs(triple(e.grains[1].centre - e.grains[0].centre, b.walls[0].normal, b.walls[1].normal)) * depth;
  }
  return depth;
}

}  // namespace

TEST_CASE("total and void volumes of random pores of every shape agree with drawn points") {
  random_engine random(20240501);
  for (std::size_t grains = 1; grains <= 4; ++grains) {
    double sum2 = 0;
    const int pores = grains == 4 ? 100 : 40;
    for (int k = 0; k < pores; ++k) {
      const auto b = random_cell(random, grains);
      std::vector<sphere<double>> balls(b.grains.begin(), b.grains.begin() + b.grain_count);
      const auto v = void_volume(b);
      REQUIRE(v.ok());
      const auto s = draw_volumes(random, b, balls, envelope_of(b), total_volume(b), v.value, 100000);
      CAPTURE(grains);
      CAPTURE(k);
      CHECK(std::fabs(s.total_z) < 5);  // 220 pores: beyond 5 once in 8,000 runs
      CHECK(std::fabs(s.void_z) < 5);
      sum2 += s.void_z * s.void_z;
    }
    CHECK(sum2 / pores < 2.0);  // mean square of a standard normal, 40 draws: 1 +- 0.22
  }
}

TEST_CASE("intruders that overlap the grains and each other agree with drawn points") {
  random_engine random(77);
  for (std::size_t grains = 1; grains <= 4; ++grains) {
    for (int k = 0; k < 25; ++k) {
      const auto b = random_cell(random, grains);
      const auto intruders = random_spheres(random, 1 + static_cast<std::size_t>(k) % 4, 0.05, 0.4);
      std::vector<sphere<double>> balls(b.grains.begin(), b.grains.begin() + b.grain_count);
      balls.insert(balls.end(), intruders.begin(), intruders.end());
      const auto v = void_volume<double>(b, intruders);
      REQUIRE(v.ok());
      const auto s = draw_volumes(random, b, balls, envelope_of(b), total_volume(b), v.value, 40000);
      CHECK(std::fabs(s.void_z) < 5);
    }
  }
}

TEST_CASE("the cells of a walled cube fill it, and void plus union of the grains is the cube") {
  random_engine random(5);
  for (int packing = 0; packing < 12; ++packing) {
    // from apart to heavily overlapping, with protruding and hidden grains
    const double scale = 0.02 + 0.03 * packing;
    const auto spheres = random_spheres(random, 3 + static_cast<std::size_t>(packing) % 5, scale / 3, scale);
    const auto cells = cells_in_unit_cube(spheres);
    double total = 0;
    double pores = 0;
    double sectors = 0;
    for (const auto& cell : cells) {
      CHECK(total_volume(cell.body) > 0);
      total += total_volume(cell.body);
      sectors += sector_volume(cell.body);
      const auto v = void_volume<double>(cell.body, spheres);  // every ball is offered: those outside change nothing
      REQUIRE(v.ok());
      pores += v.value;
    }
    CHECK(std::fabs(total - 1) < 1e-14);
    const auto solid = union_volume<double>(box_polyhedron<double>({0, 0, 0}, {1, 1, 1}), spheres);
    REQUIRE(solid.ok());
    CHECK(std::fabs(pores + solid.value - 1) < 1e-14);
    // each grain fills all directions, unless its power cell is empty
    double balls = 0;
    for (std::size_t g = 0; g < spheres.size(); ++g) {
      const bool used = std::any_of(cells.begin(), cells.end(), [&](const named_cell& c) {
        return std::find(c.grains.begin(), c.grains.end(), g) != c.grains.end();
      });
      balls += used ? ball_volume(spheres[g].radius) : 0.0;
    }
    CHECK(std::fabs(sectors - balls) < 1e-14);
  }
}

TEST_CASE("volumes shared with the cells of another triangulation add up to the cell's own") {
  random_engine random(11);
  const auto solid = random_spheres(random, 5, 0.1, 0.3);
  auto moved = solid;
  for (auto& s : moved) {
    s.centre += uniform_point(random, -0.05, 0.05);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      s.centre[axis] = std::clamp(s.centre[axis], 0.0, 1.0);
    }
  }
  const auto before = cells_in_unit_cube(solid);
  const auto after = cells_in_unit_cube(moved);
  double sum = 0;
  for (const auto& a : after) {
    double shared = 0;
    for (const auto& b : before) {
      const auto v = void_overlap<double>(a.body, b.body, moved);
      REQUIRE(v.ok());
      CHECK(v.value > -1e-15);
      const auto reversed = void_overlap<double>(b.body, a.body, moved);
      CHECK(std::fabs(v.value - reversed.value) < 1e-15);
      shared += v.value;
    }
    const auto whole = void_volume<double>(a.body, moved);
    REQUIRE(whole.ok());
    CHECK(std::fabs(shared - whole.value) < 1e-14);
    sum += shared;
  }
  const auto grains = union_volume<double>(box_polyhedron<double>({0, 0, 0}, {1, 1, 1}), moved);
  CHECK(std::fabs(sum + grains.value - 1) < 1e-14);
}

TEST_CASE("volumes do not depend on position, orientation, order or unit") {
  random_engine random(3);
  for (int k = 0; k < 2000; ++k) {
    auto b = random_tetrahedron(random, 0.05, 0.45);
    const auto intruder = random_spheres(random, 1, 0.05, 0.4);
    const double v = void_volume<double>(b, intruder).value;
    const auto turn = random_rotation(random);
    const vec3<double> shift = uniform_point(random, -1, 1);
    const auto move = [&](sphere<double> s) {
      s.centre = turn(s.centre) + shift;
      return s;
    };
    auto moved = b;
    for (auto& g : moved.grains) {
      g = move(g);
    }
    const std::vector<sphere<double>> moved_intruder{move(intruder[0])};
    // the move rounds each coordinate by 1e-16; areas and lengths of the cell are below 5
    CHECK(std::fabs(void_volume<double>(moved, moved_intruder).value - v) < 1e-14);

    auto turned = b;  // an even permutation
    std::swap(turned.grains[0], turned.grains[3]);
    std::swap(turned.grains[1], turned.grains[2]);
    CHECK(std::fabs(void_volume<double>(turned, intruder).value - v) < 2e-15);

    auto large = b;  // a power of two scales without rounding
    for (auto& g : large.grains) {
      g = {g.centre * 1024.0, g.radius * 1024.0};
    }
    const std::vector<sphere<double>> large_intruder{{intruder[0].centre * 1024.0, intruder[0].radius * 1024.0}};
    CHECK(void_volume<double>(large, large_intruder).value == v * 0x1p30);
  }
}

TEST_CASE("double and long double agree to rounding") {
  random_engine random(9);
  double worst = 0;
  for (std::size_t grains = 1; grains <= 4; ++grains) {
    for (int k = 0; k < 3000; ++k) {
      const auto b = random_cell(random, grains, 0.02, 0.6);
      const auto intruders = random_spheres(random, static_cast<std::size_t>(k) % 4, 0.05, 0.5);
      std::vector<sphere<long double>> wide;
      for (const auto& s : intruders) {
        wide.push_back(convert<long double>(s));
      }
      const auto v = void_volume<double>(b, intruders);
      const auto w = void_volume<long double>(convert<long double>(b), wide);
      REQUIRE(v.ok());
      REQUIRE(w.ok());
      worst = std::max(worst, std::fabs(v.value - static_cast<double>(w.value)));
    }
  }
  MESSAGE("worst difference " << worst << " in cells of size 1");
  CHECK(worst < 2e-15);
}

TEST_CASE("a grain pokes exactly when a point of its ball lies on the opposite facet") {
  random_engine random(21);
  int poking = 0;
  for (std::size_t grains = 1; grains <= 4; ++grains) {
    for (int k = 0; k < 300; ++k) {
      const auto b = random_cell(random, grains, 0.1, 0.9);
      for (std::size_t g = 0; g < b.grain_count; ++g) {
        const auto polygon = facet(b, g);
        if (polygon.count == 0) {
          CHECK_FALSE(pokes(b, g));
          continue;
        }
        // nearest of many points of the facet, from above
        double nearest = 1e9;
        const auto& c = polygon.corners;
        constexpr int steps = 60;
        for (int i = 0; i <= steps; ++i) {
          for (int j = 0; j <= steps; ++j) {
            const double s = i / static_cast<double>(steps);
            const double t = j / static_cast<double>(steps);
            const auto p = polygon.count == 4 ? (c[0] * (1 - s) + c[1] * s) * (1 - t) + (c[3] * (1 - s) + c[2] * s) * t
                                              : c[0] * (1 - s) + (c[1] * (1 - t) + c[2] * t) * s;
            nearest = std::min(nearest, norm(p - b.grains[g].centre));
          }
        }
        auto grown = b;
        grown.grains[g].radius = nearest * (1 + 1e-12);
        CHECK(pokes(grown, g));
        // every point of the facet has one of these within 0.05
        grown.grains[g].radius = nearest - 0.05;
        if (grown.grains[g].radius > 0) {
          CHECK_FALSE(pokes(grown, g));
        }
        CHECK(pokes(b, g) == reaches(b.grains[g], b, g));
        poking += pokes(b, g) ? 1 : 0;
      }
    }
  }
  CHECK(poking > 200);
}

TEST_CASE("facets of a cell bound it: their area vectors cancel with those of its walls") {
  random_engine random(31);
  for (std::size_t grains = 2; grains <= 4; ++grains) {
    for (int k = 0; k < 200; ++k) {
      const auto b = random_cell(random, grains);
      vec3<double> sum;
      for (std::size_t f = 0; f < 4; ++f) {
        sum += facet(b, f).area();
      }
      for (std::size_t w = 0; w < b.wall_count(); ++w) {
        const auto& n = b.walls[w].normal;
        CHECK(dot(sum, n) > 0);  // the walls themselves face the other way
        sum -= n * dot(sum, n);
      }
      CHECK(norm(sum) < 1e-15);
    }
  }
}
