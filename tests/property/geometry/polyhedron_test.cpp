// SPDX-License-Identifier: BSD-3-Clause
#include "support/walled_cells.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace tetrapore;
using namespace tetrapore_test;

namespace {

plane<double> random_plane(random_engine& random) { return {uniform_point(random), random_rotation(random).u}; }

}  // namespace

TEST_CASE("both sides of a cut have together the volume of the whole, and so do the parts of a ball in them") {
  random_engine random(12);
  for (int k = 0; k < 3000; ++k) {
    auto whole = box_polyhedron<double>({0, 0, 0}, {1, 1, 1});
    for (int cut = 0; cut < 5; ++cut) {
      auto w = random_plane(random);
      if (w.distance({0.5, 0.5, 0.5}) < 0) {
        w.normal = -w.normal;
      }
      REQUIRE(whole.clip(w) == geometry_status::ok);
    }
    const sphere<double> ball{uniform_point(random, -0.5, 1.5), uniform(random, 0.05, 1.0)};
    // pieces of two, four, eight and sixteen
    std::vector<polyhedron<double>> pieces{whole};
    for (int cut = 0; cut < 4; ++cut) {
      const auto w = random_plane(random);
      std::vector<polyhedron<double>> next;
      for (const auto& piece : pieces) {
        next.push_back(piece);
        REQUIRE(next.back().clip(w) == geometry_status::ok);
        next.push_back(piece);
        REQUIRE(next.back().clip({w.point, -w.normal}) == geometry_status::ok);
      }
      pieces = next;
    }
    double volume = 0;
    double in_ball = 0;
    for (const auto& piece : pieces) {
      volume += piece.empty() ? 0.0 : piece.volume();
      const double part = ball_volume(ball, piece);
      CHECK(part > -1e-15);
      in_ball += part;
    }
    CHECK(std::fabs(volume - whole.volume()) < 2e-15);
    CHECK(std::fabs(in_ball - ball_volume(ball, whole)) < 5e-15);
  }
}

TEST_CASE("a polyhedron cut to nothing is empty, and one that is not cut keeps its vertices") {
  auto box = box_polyhedron<double>({0, 0, 0}, {1, 1, 1});
  CHECK(box.volume() == 1);
  REQUIRE(box.clip({{0, 0, 0}, {0, 0, 1}}) == geometry_status::ok);  // coincides with a face
  CHECK(box.vertices().size() == 8);
  CHECK(box.volume() == 1);
  auto below = box;
  REQUIRE(below.clip({{0, 0, 0}, {0, 0, -1}}) == geometry_status::ok);  // keeps that face alone
  CHECK(below.volume() == 0);
  auto none = box;
  REQUIRE(none.clip({{0, 0, 2}, {0, 0, 1}}) == geometry_status::ok);
  CHECK(none.empty());
  CHECK(ball_volume(sphere<double>{{0, 0, 0}, 1}, none) == 0);
}

TEST_CASE("a cut through vertices, edges and a flat body keeps volume and closure") {
  auto half = box_polyhedron<double>({0, 0, 0}, {1, 1, 1});
  REQUIRE(half.clip({{0, 0, 0}, {std::sqrt(0.5), -std::sqrt(0.5), 0}}) == geometry_status::ok);  // through two edges
  CHECK(std::fabs(half.volume() - 0.5) < 1e-15);
  auto flat = box_polyhedron<double>({0, 0, 0}, {1, 1, 0});
  REQUIRE(flat.clip({{0.3, 0, 0}, {1, 0, 0}}) == geometry_status::ok);
  CHECK(flat.volume() == 0);
  CHECK(std::fabs(ball_volume(sphere<double>{{0.5, 0.5, 0}, 0.4}, flat)) < 1e-16);
  CHECK(std::fabs(ball_volume(sphere<double>{{0.5, 0.5, 0.1}, 0.4}, flat)) < 1e-16);
}

TEST_CASE("more cuts than fit are refused by name, and NaN is") {
  auto round = box_polyhedron<double>({-1, -1, -1}, {1, 1, 1});
  random_engine random(14);
  geometry_status last = geometry_status::ok;
  int cuts = 0;
  for (; cuts < 200 && last == geometry_status::ok; ++cuts) {
    const auto n = random_rotation(random).u;
    last = round.clip({n * 0.8, -n});
  }
  CHECK(last == geometry_status::too_complex);
  CHECK(cuts > 20);
  CHECK(round.empty());
  auto box = box_polyhedron<double>({0, 0, 0}, {1, 1, 1});
  CHECK(box.clip({{std::nan(""), 0, 0}, {1, 0, 0}}) == geometry_status::not_finite);
}
