// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/packing.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>

using namespace tetrapore;

TEST_CASE("random packings of any mix of walls, sizes and proportions have no overlap and keep their solid fraction") {
  random_sequence random(2024);
  for (int trial = 0; trial < 12; ++trial) {
    CAPTURE(trial);
    const std::size_t n = 60 + random.below(200);
    const double unit = std::pow(10.0, 8.0 * random.uniform() - 6.0);
    const auto radii = trial % 2 == 0 ? uniform_radii(n, unit, 0.6 * random.uniform())
                                      : lognormal_radii(n, unit, 0.3 * random.uniform());
    const random_packing_options options{.solid_fraction = 0.35 + 0.15 * random.uniform(),
                                         .periodic = {random.below(2) == 1, random.below(2) == 1, random.below(2) == 1},
                                         .aspect = {1.0 + random.uniform(), 1.0, 1.0 + random.uniform()},
                                         .seed = random.bits()};
    const auto p = random_packing(radii, options);
    check(p);
    const auto overlap = largest_overlap(p);
    CHECK(overlap.grains <= 0.0);
    CHECK(overlap.walls <= 0.0);
    CHECK(solid_fraction(p) == doctest::Approx(options.solid_fraction.get()).epsilon(1e-12));
    for (const auto& g : p.grains) {
      for (std::size_t k = 0; k < 3; ++k) {
        REQUIRE(g.centre[k] >= p.bounds->lo[k]);
        REQUIRE(g.centre[k] < p.bounds->hi[k]);
      }
    }
  }
}

TEST_CASE("the unit of length changes nothing: radii a power of two larger give the packing a power of two larger") {
  const auto small = uniform_radii(150, 1.0, 0.3);
  auto large = small;
  for (double& r : large) {
    r *= 1024.0;
  }
  const auto a = random_packing(small, {.solid_fraction = 0.5});
  const auto b = random_packing(large, {.solid_fraction = 0.5});
  double worst = 0;
  for (std::size_t i = 0; i < a.grains.size(); ++i) {
    worst = std::max(worst, norm(b.grains[i].centre * (1.0 / 1024.0) - a.grains[i].centre));
  }
  CHECK(worst < 1e-9);
}

TEST_CASE("a size ratio above a hundred is packed") {
  const auto p =
      random_packing(lognormal_radii(1000, 1.0, 0.8), {.solid_fraction = 0.6, .periodic = {true, true, true}});
  CHECK(largest_overlap(p).grains <= 0.0);
  const auto r = radii_of(p.grains);
  CHECK(r.largest / r.smallest > 100.0);
}

TEST_CASE("a grain packs with its own images: one in a periodic box, near the simple cubic lattice") {
  const auto p = random_packing(uniform_radii(1, 1.0, 0.0), {.solid_fraction = 0.52, .periodic = {true, true, true}});
  CHECK(largest_overlap(p, 0.1).grains == doctest::Approx(2.0 - std::cbrt(4.0 / 3.0 * pi<double> / 0.52)));
}

TEST_CASE("shifting a periodic packing by any vector and wrapping it changes no gap") {
  const auto p = random_packing(uniform_radii(120, 1.0, 0.3), {.solid_fraction = 0.5, .periodic = {true, true, true}});
  auto q = p;
  for (auto& g : q.grains) {
    g.centre += vec3<double>{123.4, -77.7, 0.1};
  }
  const auto report = wrap(q);
  CHECK(report.wrapped == 120);
  CHECK(report.duplicates.empty());
  CHECK(largest_overlap(q).grains == doctest::Approx(largest_overlap(p).grains).epsilon(1e-6));
  CHECK(coordination_number(q, 1e-2) == doctest::Approx(coordination_number(p, 1e-2)).epsilon(1e-12));
}
