// SPDX-License-Identifier: BSD-3-Clause
#include "support/openings.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <random>

using namespace openings;

namespace {

double distance(const opening<double>& o, std::size_t i, std::size_t j) {
  return norm(o.sides[i].point - o.sides[j].point);
}

}  // namespace

TEST_CASE("an opening from distances has them, counter-clockwise, with the smallest disc at the origin") {
  random_throats random(1);
  for (int i = 0; i < 2000; ++i) {
    const std::array<double, 3> r{random.radius(), random.radius(), random.radius()};
    const double d01 = r[0] + r[1] + random.uniform(0, 0.3);
    const double d02 = r[0] + r[2] + random.uniform(0, 0.3);
    const double d12 = r[1] + r[2] + random.uniform(0, 0.3);
    const auto made = opening_from_distances(r[0], r[1], r[2], d01, d02, d12);
    if (!made.ok()) {
      CHECK((d01 > d02 + d12 || d02 > d01 + d12 || d12 > d01 + d02));
      continue;
    }
    const auto& o = made.value;
    CHECK(norm(o.sides[0].point) == 0);
    CHECK(o.sides[0].radius == std::min({r[0], r[1], r[2]}));
    CHECK(cross(o.sides[1].point, o.sides[2].point) >= 0);
    for (std::size_t k = 0; k < 3; ++k) {  // the disc of radius r[k] is found again, and the distances with it
      std::size_t at = 0;
      while (o.sides[at].radius != r[k]) {
        ++at;
      }
      const double next = k == 0 ? d01 : (k == 1 ? d12 : d02);
      CHECK(distance(o, at, o.next(at)) == doctest::Approx(next).epsilon(1e-14));
    }
  }
}

TEST_CASE("distances that are no triangle, or no numbers, are refused without sides") {
  CHECK(opening_from_distances(1.0, 1.0, 1.0, 5.0, 2.0, 2.0).reason == opening_status::not_a_triangle);
  CHECK(opening_from_distances(1.0, 1.0, 1.0, 4.0, 2.0, 2.0).ok());
  CHECK(opening_from_distances(1.0, -1.0, 1.0, 4.0, 2.0, 2.0).reason == opening_status::invalid_input);
  CHECK(opening_from_distances(1.0, 1.0, 1.0, 4.0, quiet_nan<double>, 2.0).reason == opening_status::invalid_input);
  CHECK(opening_from_distances(1.0, 1.0, 1.0, 5.0, 2.0, 2.0).value.count == 0);
  CHECK(ring_of_discs(9, 1.0, 0.0).reason == opening_status::too_many_sides);
  CHECK(ring_of_discs(2, 1.0, 0.0).reason == opening_status::invalid_input);
  CHECK(ring_of_discs(4, 1.0, -2.0).reason == opening_status::invalid_input);
  CHECK(regular_polygon(3, 0.0).reason == opening_status::invalid_input);
}

TEST_CASE("a throat a million boxes away gives the same opening to what its coordinates still hold") {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> u(0, 1);
  for (int i = 0; i < 1000; ++i) {
    const auto grid = [&] { return std::round(u(engine) * 1024) / 1024; };  // survives the shift without rounding
    throat<double> t{};
    t.grain_count = 3;
    for (auto& g : t.grains) {
      g = {{grid(), grid(), grid()}, 0.1 + 0.2 * u(engine)};
    }
    throat<double> far = t;
    for (auto& g : far.grains) {
      g.centre += vec3<double>{1e6, -1e6, 1e6};
    }
    const auto a = opening_of(t);
    const auto b = opening_of(far);
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(a.sides[k].point.x == b.sides[k].point.x);
      CHECK(a.sides[k].point.y == b.sides[k].point.y);
    }
  }
}

TEST_CASE("wall facets are counter-clockwise rings with their walls below and beside") {
  throat<double> t{};
  t.grain_count = 2;
  t.grains[0] = {{5, 5, 1.1}, 1};
  t.grains[1] = {{7, 5, 0.9}, 0.8};
  t.walls[0] = {{0, 0, 0}, {0, 0, 1}};
  const auto o = opening_of(t);
  REQUIRE(o.count == 3);
  CHECK(o.sides[0].radius == 0.8);
  CHECK(distance(o, 0, 1) == doctest::Approx(std::hypot(2, 0.2)));
  CHECK(o.sides[2].kind == side_kind::line);
  CHECK(dot(o.sides[2].normal, o.sides[0].point - o.sides[2].point) == doctest::Approx(0.9));
  CHECK(dot(o.sides[2].normal, o.sides[1].point - o.sides[2].point) == doctest::Approx(1.1));
  t.grain_count = 1;
  t.walls[1] = {{0, 3, 0}, {0, 1, 0}};
  const auto corner = opening_of(t);
  REQUIRE(corner.count == 3);
  CHECK(cross(corner.sides[1].normal, corner.sides[2].normal) > 0);
  CHECK(dot(corner.sides[1].normal, corner.sides[0].point - corner.sides[1].point) == doctest::Approx(1.1));
  CHECK(dot(corner.sides[2].normal, corner.sides[0].point - corner.sides[2].point) == doctest::Approx(2));
}

TEST_CASE("merging takes the shared gap away, keeps the states of the others, and refuses what is not shared") {
  auto a = ring_of_discs(3, 1.0, 0.6).value;
  auto b = ring_of_discs(3, 1.0, 0.6).value;
  a.gaps = {gap_state::liquid, gap_state::open, gap_state::liquid};
  b.gaps = {gap_state::open, gap_state::liquid, gap_state::open};
  const auto ring = merge(a, 0, b, 1);
  REQUIRE(ring.ok());
  REQUIRE(ring.value.count == 4);
  // a: gaps 1 and 2; b: those after its gap 1, 2 and 0
  CHECK(ring.value.gaps[0] == gap_state::open);
  CHECK(ring.value.gaps[1] == gap_state::liquid);
  CHECK(ring.value.gaps[2] == gap_state::open);
  CHECK(ring.value.gaps[3] == gap_state::open);
  for (std::size_t k = 0; k < 4; ++k) {
    CHECK(distance(ring.value, k, ring.value.next(k)) == doctest::Approx(2.6));
  }
  CHECK(distance(ring.value, 0, 2) == doctest::Approx(2.6));
  const auto five = merge(ring.value, 0, b, 0);
  REQUIRE(five.ok());
  CHECK(five.value.count == 5);
  CHECK(merge(a, 0, ring_of_discs(3, 1.0, 0.61).value, 0).reason == opening_status::not_shared);
  CHECK(merge(a, 3, b, 0).reason == opening_status::invalid_input);
  const auto seven = ring_of_discs(7, 1.0, 0.6).value;
  CHECK(merge(seven, 0, seven, 0).reason == opening_status::too_many_sides);
}
