// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/io/read_packing.hpp"
#include "tetrapore/io/read_sizes.hpp"
#include "tetrapore/packing.hpp"

#include "support/errors.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>

using namespace tetrapore;

namespace {
constexpr std::array<bool, 3> all_axes{true, true, true};
const std::filesystem::path shipped_data = std::filesystem::path(TETRAPORE_TEST_DATA) / "../examples/data";
}  // namespace

TEST_CASE("the random sequence is xoshiro256** seeded by splitmix64") {
  // The first numbers of the published algorithms for seed 0: splitmix64 gives e220a8397b1dcdaf … as the state.
  random_sequence random(0);
  CHECK(random.bits() == 0x99ec5f36cb75f2b4ULL);
  CHECK(random.bits() == 0xbf6e1f784956452aULL);
  CHECK(random.bits() == 0x1a5f849d4933e6e0ULL);
}

TEST_CASE("lattices have the known solid fraction, contacts and gaps") {
  struct known {
    lattice_kind kind;
    std::size_t per_cell;
    double solid;
    double contacts;
  };
  const double close = pi<double> / std::sqrt(18.0);
  for (const auto& k :
       {known{lattice_kind::simple_cubic, 1, pi<double> / 6.0, 6},
        known{lattice_kind::body_centred, 2, pi<double> * std::sqrt(3.0) / 8.0, 8},
        known{lattice_kind::face_centred, 4, close, 12}, known{lattice_kind::hexagonal_close, 4, close, 12}}) {
    CAPTURE(static_cast<int>(k.kind));
    const auto p = lattice(k.kind, {3, 4, 5}, 0.7, all_axes);
    CHECK(p.grains.size() == 60 * k.per_cell);
    CHECK(solid_fraction(p) == doctest::Approx(k.solid).epsilon(1e-14));
    CHECK(coordination_number(p, 1e-9) == k.contacts);
    CHECK(std::abs(largest_overlap(p).grains) < 1e-14 * 20.0);
  }
}

TEST_CASE("even a single periodic cell has all its contacts, with images of itself") {
  CHECK(coordination_number(lattice(lattice_kind::simple_cubic, {1, 1, 1}, 1.0, all_axes), 1e-9) == 6.0);
  CHECK(coordination_number(lattice(lattice_kind::face_centred, {1, 1, 1}, 1.0, all_axes), 1e-9) == 12.0);
}

TEST_CASE("the walls of a lattice touch its outermost spheres") {
  for (const auto kind : {lattice_kind::simple_cubic, lattice_kind::body_centred, lattice_kind::face_centred,
                          lattice_kind::hexagonal_close}) {
    const auto p = lattice(kind, {2, 3, 4}, 0.5, {false, true, false});
    const auto b = bounding_box(p.grains);
    CHECK(p.bounds->lo.x == b.lo.x);
    CHECK(p.bounds->hi.x == b.hi.x);
    CHECK(p.bounds->hi.z == b.hi.z);
    CHECK(p.bounds->lo.y == 0.0);
    CHECK(largest_overlap(p).walls < 1e-15);
  }
}

TEST_CASE("close pairs of a mix of sizes are those that a look at all pairs finds") {
  random_sequence random(5);
  for (const auto& periodic : {std::array<bool, 3>{}, all_axes, std::array<bool, 3>{true, false, true}}) {
    packing p;
    p.bounds = box{{-1.0, 2.0, 0.0}, {1.0, 3.5, 3.0}};
    p.periodic = periodic;
    const auto size = p.bounds->size();
    for (int i = 0; i < 150; ++i) {
      vec3<double> c{};
      for (std::size_t k = 0; k < 3; ++k) {
        c[k] = p.bounds->lo[k] + size[k] * (1.4 * random.uniform() - 0.2);
      }
      p.grains.push_back({c, 0.3 * std::pow(0.02, random.uniform())});
    }
    const double reach = 0.4;
    std::size_t expected = 0;
    for (std::size_t i = 0; i < p.grains.size(); ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        for (int x = periodic[0] ? -3 : 0; x <= (periodic[0] ? 3 : 0); ++x) {
          for (int y = periodic[1] ? -3 : 0; y <= (periodic[1] ? 3 : 0); ++y) {
            for (int z = periodic[2] ? -3 : 0; z <= (periodic[2] ? 3 : 0); ++z) {
              if (i == j && std::array<int, 3>{x, y, z} <= std::array<int, 3>{}) {
                continue;
              }
              const vec3<double> shift{x * size.x, y * size.y, z * size.z};
              const double near = p.grains[i].radius + p.grains[j].radius + reach;
              expected += norm(p.grains[j].centre + shift - p.grains[i].centre) < near ? 1U : 0U;
            }
          }
        }
      }
    }
    std::size_t found = 0;
    for_each_close_pair(p, reach, [&](const close_pair& pair, const vec3<double>& apart) {
      const vec3<double> shift{pair.shift.x * size.x, pair.shift.y * size.y, pair.shift.z * size.z};
      const auto direct = p.grains[pair.j].centre + shift - p.grains[pair.i].centre;
      found += norm(direct - apart) < 1e-14 ? 1U : 0U;
    });
    CHECK(found == expected);
    CHECK(expected > 150);
  }
}

TEST_CASE("a random packing has no overlap, the solid fraction asked for, and exactly the radii given") {
  struct wanted {
    std::array<bool, 3> periodic;
    double solid;
    std::vector<double> radii;
  };
  for (const auto& w : {wanted{{false, false, false}, 0.55, uniform_radii(500, 1e-3, 0.3)},
                        wanted{all_axes, 0.60, uniform_radii(500, 1.0, 0.0)},
                        wanted{{true, false, true}, 0.56, lognormal_radii(500, 1.0, 0.4)}}) {
    const auto p = random_packing(w.radii, {.solid_fraction = w.solid, .periodic = w.periodic, .seed = 3});
    CHECK(solid_fraction(p) == doctest::Approx(w.solid).epsilon(1e-13));
    const auto overlap = largest_overlap(p);
    CHECK(overlap.grains <= 0.0);
    CHECK(overlap.walls <= 0.0);
    CHECK(overlap.grains > -1e-5);  // near-contacts: the packing is at rest, not a gas
    auto radii = w.radii;
    std::vector<double> found;
    for (const auto& g : p.grains) {
      found.push_back(g.radius);
    }
    std::sort(radii.begin(), radii.end());
    std::sort(found.begin(), found.end());
    CHECK(found == radii);
    check(p);
  }
}

TEST_CASE("a seed gives the same bits again, another seed another packing") {
  const auto radii = uniform_radii(200, 1.0, 0.3);
  const auto a = random_packing(radii, {.solid_fraction = 0.5, .seed = 11});
  const auto b = random_packing(radii, {.solid_fraction = 0.5, .seed = 11});
  const auto c = random_packing(radii, {.solid_fraction = 0.5, .seed = 12});
  CHECK(a.grains == b.grains);
  CHECK_FALSE(a.grains == c.grains);
}

TEST_CASE("a random packing of other proportions fills its box") {
  const auto p = random_packing(uniform_radii(600, 1.0, 0.2), {.solid_fraction = 0.5, .aspect = {1, 3, 1}, .seed = 2});
  CHECK(p.bounds->hi.y == doctest::Approx(3.0 * p.bounds->hi.x).epsilon(1e-15));
  const auto b = bounding_box(p.grains);
  CHECK(b.hi.y > 0.98 * p.bounds->hi.y);
}

TEST_CASE("radii follow their distribution") {
  const auto even = uniform_radii(1001, 2.0, 0.25);
  CHECK(even.front() == doctest::Approx(1.5).epsilon(1e-3));
  CHECK(even[500] == doctest::Approx(2.0).epsilon(1e-14));
  const auto log = lognormal_radii(4001, 3.0, 0.5);
  CHECK(log[2000] == doctest::Approx(3.0).epsilon(1e-12));
  CHECK(log[3366] == doctest::Approx(3.0 * std::exp(0.5)).epsilon(1e-3));  // the quantile of one deviation, 84.13 %
  double mean = 0;
  double square = 0;
  for (const double r : log) {
    mean += std::log(r / 3.0) / 4001.0;
    square += std::log(r / 3.0) * std::log(r / 3.0) / 4001.0;
  }
  CHECK(std::abs(mean) < 1e-11);
  CHECK(std::sqrt(square) == doctest::Approx(0.5).epsilon(1e-3));
}

TEST_CASE("grains from a grading curve have its masses: half a per cent for 10,000 beads") {
  const auto curve = io::read_sizes(shipped_data / "glass_beads_psd.csv");
  const auto radii = radii_by_mass(10000, curve);
  double all = 0;
  double small = 0;
  double middle = 0;
  double below_12 = 0;
  for (const double r : radii) {
    const double m = r * r * r;
    all += m;
    small += r == 0.3e-3 ? m : 0.0;
    middle += r == 0.425e-3 ? m : 0.0;
    below_12 += r < 0.6e-3 ? m : 0.0;
  }
  CHECK(small / all == doctest::Approx(0.35).epsilon(5e-3));
  CHECK(middle / all == doctest::Approx(0.35).epsilon(5e-3));
  CHECK(below_12 / all == doctest::Approx(0.85).epsilon(5e-3));
  CHECK(radii.back() < 0.7e-3);
  CHECK(radii.back() > 0.699e-3);
}

TEST_CASE("the packing that ships holds 10,000 beads of the grading curve, apart from each other and the walls") {
  const auto r = io::read_packing(shipped_data / "beads_10000.txt");
  check(r.packing);
  CHECK(r.packing.grains.size() == 10000);
  CHECK(solid_fraction(r.packing) == doctest::Approx(0.60).epsilon(1e-6));
  const auto overlap = largest_overlap(r.packing);
  CHECK(overlap.grains <= 0.0);
  CHECK(overlap.walls <= 0.0);
  auto expected = radii_by_mass(10000, io::read_sizes(shipped_data / "glass_beads_psd.csv"));
  std::vector<double> found;
  for (const auto& g : r.packing.grains) {
    found.push_back(g.radius);
  }
  std::sort(found.begin(), found.end());
  double worst = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    worst = std::max(worst, std::abs(found[i] / expected[i] - 1.0));
  }
  CHECK(worst < 1e-8);  // nine digits
}

TEST_CASE("tiling repeats a periodic packing, in its larger box") {
  const auto p =
      random_packing(uniform_radii(100, 1.0, 0.3), {.solid_fraction = 0.55, .periodic = {true, false, true}});
  const auto t = tile(p, {3, 1, 2});
  CHECK(t.grains.size() == 600);
  CHECK(t.periodic == p.periodic);
  CHECK(t.bounds->size().x == doctest::Approx(3.0 * p.bounds->size().x).epsilon(1e-15));
  CHECK(t.bounds->size().y == p.bounds->size().y);
  CHECK(solid_fraction(t) == doctest::Approx(0.55).epsilon(1e-13));
  CHECK(largest_overlap(t).grains <= 1e-12);
  CHECK(coordination_number(t, 1e-3) == doctest::Approx(coordination_number(p, 1e-3)).epsilon(1e-15));
  CHECK(tile(p, {1, 1, 1}).grains == p.grains);
}

TEST_CASE("wrapping keeps grains inside, keeps their order, and removes images only") {
  packing p;
  p.bounds = box{{0, 0, 0}, {1, 2, 3}};
  p.periodic = {true, true, false};
  p.grains = {{{0.5, 0.5, 0.5}, 0.1},   {{1.5, 2.5, 0.5}, 0.1},   // an image of the first
              {{-0.25, 0.5, 4.0}, 0.1},                           // outside along z, where nothing repeats
              {{0.5, 0.5, 0.5}, 0.1},                             // the first again, at its place: not an image
              {{0.5, 4.5, 0.5}, 0.2},                             // an image of the first but for its radius
              {{1.0, 2.0, 1.0}, 0.1},   {{0.0, 0.0, 1.0}, 0.1}};  // the upper corner is the lower one
  const auto report = wrap(p);
  CHECK(report.wrapped == 4);
  CHECK(report.duplicates == std::vector<std::size_t>{1, 6});
  CHECK(p.grains.size() == 5);
  CHECK(p.grains[1].centre == vec3<double>{0.75, 0.5, 4.0});
  p.grains = {{{1.5, 0.5, 0.5}, 0.1}, {{1.5, 0.5, 0.5}, 0.1}};  // one place outside the box, given twice
  CHECK(wrap(p).duplicates.empty());
}

TEST_CASE("a grain a million box lengths away has lost its place, and is refused") {
  packing p;
  p.bounds = box{{0, 0, 0}, {1, 1, 1}};
  p.periodic = {true, false, false};
  p.grains = {{{0.5, 0.5, 0.5}, 0.1}, {{2e6, 0.5, 0.5}, 0.1}};
  CHECK(contains(message_of<packing_error>([&] { return wrap(p); }), "grain 1: found centre x = 2e+06"));
  CHECK(contains(message_of<packing_error>([&] { return largest_overlap(p); }), "wrap the packing first"));
  p.periodic = {};
  CHECK(wrap(p).wrapped == 0);
}
