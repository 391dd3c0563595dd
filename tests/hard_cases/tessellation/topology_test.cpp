// SPDX-License-Identifier: BSD-3-Clause
#include "support/compiled_triangulation.hpp"
#include "support/random_spheres.hpp"
#include "tetrapore/law/entry.hpp"
#include "tetrapore/network.hpp"
#include "tetrapore/network/gather_opening.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>

using namespace tetrapore;

namespace {

constexpr auto wall = boundary::wall;
constexpr auto periodic = boundary::periodic;
constexpr auto open = boundary::open;

std::vector<sphere<double>> cubic_lattice(int n, double shift) {
  std::vector<sphere<double>> grains;
  const double a = 1.0 / n;
  for (int x = 0; x < n; ++x) {
    for (int y = 0; y < n; ++y) {
      for (int z = 0; z < n; ++z) {
        grains.push_back({{(x + 0.5) * a + shift, (y + 0.5) * a + shift, (z + 0.5) * a + shift}, 0.5 * a});
      }
    }
  }
  return grains;
}

double defect(const network& net) {
  const double region = compensated_sum(net.arrays().volumes);
  return std::abs(compensated_sum(net.arrays().void_volumes) + solid_volume(net) - region) / region;
}

std::string refusal(const std::vector<sphere<double>>& grains, const domain& d) {
  try {
    static_cast<void>(compiled_triangulation{}(grains, d));
  } catch (const packing_error& e) {
    return e.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("exact lattices close under any mixture of walls and periods, and fill their box") {
  for (const int n : {1, 2, 3, 5}) {
    for (const auto& d : {unit_box(periodic, periodic, periodic), unit_box(wall, periodic, periodic),
                          unit_box(wall, wall, periodic), unit_box(wall, wall, wall)}) {
      CAPTURE(n);
      if (n == 1 && d.any_periodic()) {
        continue;  // one grain: below the four that a packing needs
      }
      const auto grains = cubic_lattice(n, 0.0);
      if (grains.size() < 4) {
        continue;
      }
      const auto t = compiled_triangulation{}(grains, d);
      validate(t.net);
      CHECK(defect(t.net) < 1e-13);
      CHECK(std::abs(compensated_sum(t.net.arrays().volumes) - 1.0) < 1e-13);
      for (std::size_t i = 0; i < t.net.pore_count(); ++i) {
        CHECK(finite(t.net.power_centre(pore_id(i))));
      }
    }
  }
}

TEST_CASE("a periodic lattice of eight grains has the void of a simple cubic array") {
  const auto t = compiled_triangulation{}(cubic_lattice(2, 0.0), unit_box(periodic, periodic, periodic));
  CHECK(std::abs(compensated_sum(t.net.arrays().void_volumes) - (1 - pi<double> / 6)) < 1e-14);
  // every pore of a simple cubic array is a part of the same cavity: all power centres are centres of cubes
  for (std::size_t i = 0; i < t.net.pore_count(); ++i) {
    const auto c = t.net.power_centre(pore_id(i));
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(std::abs(2 * c[k] - std::nearbyint(2 * c[k])) < 1e-12);
    }
  }
}

TEST_CASE(
    "the size of the device that stands for a wall changes nothing: no volume, no centre, no area, no entry pressure") {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const auto grains = loose_spheres(200, seed);
    const auto a = compiled_triangulation{.wall_device = 0x1p24}(grains, unit_box(wall, wall, wall)).net;
    const auto b = compiled_triangulation{.wall_device = 10 * 0x1p24}(grains, unit_box(wall, wall, wall)).net;
    REQUIRE(a.pore_count() == b.pore_count());
    std::map<std::array<vertex, 4>, pore_id> by_name;
    const auto name_of = [](const network& net, pore_id p) {
      auto name = net.vertices(p);
      std::sort(name.begin(), name.end());
      return name;
    };
    for (std::size_t i = 0; i < b.pore_count(); ++i) {
      by_name.emplace(name_of(b, pore_id(i)), pore_id(i));
    }
    const mayer_stowe_princen law{.surface_tension = 1.0};
    for (std::size_t i = 0; i < a.pore_count(); ++i) {
      const pore_id p(i);
      const auto twin = by_name.find(name_of(a, p));
      REQUIRE(twin != by_name.end());
      const pore_id q = twin->second;
      CHECK(std::abs(a.volume(p) - b.volume(q)) <= 1e-10 * a.volume(p));
      CHECK(std::abs(a.void_volume(p) - b.void_volume(q)) <= 1e-10 * a.volume(p));
      CHECK(norm(a.power_centre(p) - b.power_centre(q)) <= 1e-10);
      for (std::size_t k = 0; k < 4; ++k) {
        const throat_id t = a.throats(p)[k];
        if (!t.valid()) {
          continue;
        }
        for (std::size_t m = 0; m < 4; ++m) {
          if (b.vertices(q)[m] == a.vertices(p)[k]) {
            const throat_id u = b.throats(q)[m];
            const double area = norm(throat_at(a, t).area_vector);
            CHECK(std::abs(norm(throat_at(b, u).area_vector) - area) <= 1e-10 * area);
            const auto pa = law.entry_pressure(opening_at(a, t));
            const auto pb = law.entry_pressure(opening_at(b, u));
            CHECK(pa.reason == pb.reason);
            CHECK((!pa.ok() || std::abs(pa.value - pb.value) <= 1e-10 * pa.value));
          }
        }
      }
    }
  }
}

TEST_CASE("a pore at a wall has its power centre on the plane") {
  const auto t = compiled_triangulation{}(loose_spheres(200, 4), unit_box(wall, wall, wall));
  for (std::size_t i = 0; i < t.net.pore_count(); ++i) {
    for (const vertex v : t.net.vertices(pore_id(i))) {
      if (v.is_wall()) {
        CHECK(std::abs(t.net.region().wall(v.wall()).distance(t.net.power_centre(pore_id(i)))) < 1e-13);
      }
    }
  }
}

TEST_CASE("at each of the eight corners lies one cuboid, which has no throat opposite to its grain") {
  const auto t = compiled_triangulation{}(loose_spheres(60, 9), unit_box(wall, wall, wall));
  int corners = 0;
  for (std::size_t i = 0; i < t.net.pore_count(); ++i) {
    if (t.net.grain_vertices(pore_id(i)) == 1) {
      ++corners;
      CHECK_FALSE(t.net.throats(pore_id(i))[0].valid());
    }
  }
  CHECK(corners == 8);
}

TEST_CASE("the power centres are no farther in power from their own grains than from any other") {
  const auto grains = loose_spheres(120, 6);
  for (const auto& d :
       {unit_box(wall, wall, wall), unit_box(open, open, open), unit_box(periodic, periodic, periodic)}) {
    const auto t = compiled_triangulation{}(grains, d);
    for (std::size_t i = 0; i < t.net.pore_count(); ++i) {
      const pore_id p(i);
      const double own = power(t.net.power_centre(p), t.net.grain_sphere(p, 0));
      double best = std::numeric_limits<double>::infinity();
      for (const auto& g : grains) {
        for (std::int8_t x = -1; x <= 1; ++x) {
          for (std::int8_t y = -1; y <= 1; ++y) {
            for (std::int8_t z = -1; z <= 1; ++z) {
              if (d.any_periodic() || (x == 0 && y == 0 && z == 0)) {
                best = std::min(best, power(t.net.power_centre(p), {g.centre + d.shift({x, y, z}), g.radius}));
              }
            }
          }
        }
      }
      CHECK(best >= own - 1e-10 * (std::abs(own) + norm2(t.net.power_centre(p))));
    }
  }
}

TEST_CASE("radii from 1 to 1000, overlapping and engulfed grains: hidden ones are named, the volume still fills") {
  auto grains = loose_spheres(60, 12);
  for (std::size_t i = 0; i < grains.size(); i += 3) {
    grains[i].radius *= 1e-3;
  }
  grains.push_back({grains[1].centre + vec3<double>{0.01 * grains[1].radius, 0, 0}, 0.5 * grains[1].radius});
  grains.push_back(grains[4]);
  const auto t = compiled_triangulation{}(grains, unit_box(wall, wall, wall));
  REQUIRE(t.report.hidden.size() == 2);
  std::size_t twins = 0;
  for (const auto& h : t.report.hidden) {
    const bool engulfed = h.grain.index() == 60;
    const bool duplicate =
        (h.grain.index() == 61 && h.twin.index() == 4) || (h.grain.index() == 4 && h.twin.index() == 61);
    CHECK((engulfed || duplicate));
    twins += h.twin.valid() ? 1U : 0U;
  }
  CHECK(twins == 1);
  CHECK(defect(t.net) < 1e-13);
}

TEST_CASE("at a million boxes from the origin the topology is that at the origin") {
  auto grains = loose_spheres(150, 21);
  for (auto& g : grains) {  // coordinates that survive the offset without rounding
    for (std::size_t k = 0; k < 3; ++k) {
      g.centre[k] = std::ldexp(std::nearbyint(std::ldexp(g.centre[k], 30)), -30);
    }
  }
  auto away = grains;
  const vec3<double> offset{1e6, -1e6, 1e6};
  for (auto& g : away) {
    g.centre += offset;
  }
  for (const auto& d : {unit_box(wall, wall, wall), unit_box(periodic, periodic, wall)}) {
    domain there = d;
    there.bounds = {d.bounds.lo + offset, d.bounds.hi + offset};
    const auto near = compiled_triangulation{}(grains, d);
    const auto far = compiled_triangulation{}(away, there);
    CHECK(edges_of(near.net) == edges_of(far.net));
    REQUIRE(near.net.pore_count() == far.net.pore_count());
    for (std::size_t i = 0; i < near.net.pore_count(); ++i) {
      CHECK(near.net.vertices(pore_id(i)) == far.net.vertices(pore_id(i)));
      CHECK(std::abs(near.net.void_volume(pore_id(i)) - far.net.void_volume(pore_id(i))) < 1e-15);
    }
  }
}

TEST_CASE("what cannot be triangulated is refused by name") {
  const auto good = loose_spheres(30, 2);
  const domain box = unit_box(wall, wall, wall);
  SUBCASE("NaN coordinate") {
    auto g = good;
    g[7].centre.y = std::numeric_limits<double>::quiet_NaN();
    CHECK(refusal(g, box).find("grain 7") != std::string::npos);
  }
  SUBCASE("infinite radius") {
    auto g = good;
    g[5].radius = std::numeric_limits<double>::infinity();
    CHECK(refusal(g, box).find("grain 5") != std::string::npos);
  }
  SUBCASE("no radius") {
    auto g = good;
    g[3].radius = 0;
    CHECK(refusal(g, box).find("grain 3") != std::string::npos);
  }
  SUBCASE("a centre outside the box") {
    auto g = good;
    g[9].centre.z = 1.25;
    CHECK(refusal(g, box).find("grain 9") != std::string::npos);
  }
  SUBCASE("three grains") {
    CHECK(refusal({good.begin(), good.begin() + 3}, box).find("at least 4") != std::string::npos);
  }
  SUBCASE("none") { CHECK(refusal({}, box).find("at least 4") != std::string::npos); }
  SUBCASE("all in one plane") {
    auto g = good;
    for (auto& s : g) {
      s.centre.z = 0.5;
    }
    CHECK(refusal(g, box).find("plane") != std::string::npos);
  }
  SUBCASE("a box turned over") {
    domain d = box;
    d.bounds.hi.x = -1;
    CHECK(refusal(good, d).find("box") != std::string::npos);
  }
}
