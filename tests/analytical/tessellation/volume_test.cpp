// SPDX-License-Identifier: BSD-3-Clause
#include "support/compiled_triangulation.hpp"
#include "support/shared_data.hpp"
#include "tetrapore/io/read_packing.hpp"
#include "tetrapore/network.hpp"
#include "tetrapore/packing/packing.hpp"

#include <cmath>
#include <fstream>
#include <random>
#include <string>
#include <vector>

using namespace tetrapore;

namespace {

struct balance {
  double region;  ///< sum of the cells
  double voids;
  double solid;
  [[nodiscard]] double defect() const { return std::abs(voids + solid - region) / region; }
};

balance balance_of(const network& net) {
  return {compensated_sum(net.arrays().volumes), compensated_sum(net.arrays().void_volumes), solid_volume(net)};
}

/// A domain for the packing, its axes as the letters say: w wall, p periodic, o open.
domain region_of(const packing& p, const std::string& axes) {
  domain d = unbounded();
  d.bounds = p.bounds.value_or(box{});
  for (std::size_t k = 0; k < 3; ++k) {
    const boundary b = axes[k] == 'w' ? boundary::wall : (axes[k] == 'p' ? boundary::periodic : boundary::open);
    d.faces[2 * k] = d.faces[2 * k + 1] = b;
  }
  return d;
}

/// 1e-12 of the region is the bound: sums of 1e5 numbers of relative error 1e-15 stay well below it.
constexpr double bound = 1e-12;

void check_filled(const packing& p, const std::string& axes) {
  CAPTURE(axes);
  const domain d = region_of(p, axes);
  const auto t = compiled_triangulation{}(p.grains, d);
  validate(t.net);
  const balance b = balance_of(t.net);
  CHECK(b.defect() < bound);
  if (axes.find('o') == std::string::npos) {
    CHECK(std::abs(b.region / d.bounds.volume() - 1) < bound);
  }
}

packing shared_packing(const std::string& name, io::read_options options = {}) {
  const auto path = shared_file("data/" + name);
  return path ? io::read_packing(*path, options).packing : packing{};
}

}  // namespace

TEST_CASE("void + solid = region for random packings with walls, periodic axes, open sides and their mixtures") {
  for (const char* name : {"open_200", "open_1000", "open_dem_1000"}) {
    CAPTURE(name);
    const packing p = shared_packing(std::string("packings/") + name + ".txt");
    if (p.grains.empty()) {
      return;
    }
    for (const char* axes : {"www", "ooo", "ppp", "pww", "wpo", "oow", "pop"}) {
      check_filled(p, axes);
    }
  }
}

TEST_CASE("void + solid = region for 10,000 and 40,000 grains") {
  for (const char* name : {"open_10000", "open_40000"}) {
    CAPTURE(name);
    const packing p = shared_packing(std::string("packings/") + name + ".txt");
    if (p.grains.empty()) {
      return;
    }
    check_filled(p, "www");
  }
}

TEST_CASE("void + solid = region for touching lattices, cospherical everywhere") {
  for (const char* name : {"lattice_sc", "lattice_bcc", "lattice_fcc"}) {
    CAPTURE(name);
    const packing p = shared_packing(std::string("packings/") + name + ".txt");
    if (p.grains.empty()) {
      return;
    }
    check_filled(p, "www");
    check_filled(p, "ooo");
  }
}

TEST_CASE("void + solid = box for periodic packings of other codes, also with overlaps") {
  const packing yuan = shared_packing("packings/packing.xyzd");
  if (yuan.grains.empty()) {
    return;
  }
  CHECK(yuan.grains.size() == 10000);
  check_filled(yuan, "ppp");
  packing lbpm = shared_packing("packings/Sph125_pack.out");
  check_filled(lbpm, "ppp");
}

TEST_CASE("void + solid = hull for the balls that Finney measured, which overlap slightly") {
  const auto path = shared_file("data/experiments/FinneyPack4021.txt");
  if (!path) {
    return;
  }
  std::vector<sphere<double>> grains;
  std::ifstream in(*path);
  for (double id = 0, x = 0, y = 0, z = 0; in >> id >> x >> y >> z;) {
    grains.push_back({{x, y, z}, 1.0});
  }
  REQUIRE(grains.size() == 4021);
  const auto t = compiled_triangulation{}(grains, unbounded());
  CHECK(balance_of(t.net).defect() < bound);
}

TEST_CASE("counts of vertices, edges, facets and cells are those of the data, and Euler's relation holds") {
  struct expectation {
    const char* file;
    std::size_t v, e, f, c;
  };
  for (const auto& x : {expectation{"packings/liggghts_dump.particles", 22410, 155539, 266019, 132889},
                        expectation{"packings/Sph125_pack.out", 125, 780, 1278, 622},
                        expectation{"packings/packing.xyzd", 10000, 70805, 121481, 60675},
                        expectation{"experiments/FinneyPack4021.txt", 4021, 27975, 47619, 23664}}) {
    CAPTURE(x.file);
    const auto path = shared_file(std::string("data/") + x.file);
    if (!path) {
      return;
    }
    std::vector<sphere<double>> grains;
    if (std::string(x.file).find("Finney") != std::string::npos) {
      std::ifstream in(*path);
      for (double id = 0, a = 0, b = 0, c = 0; in >> id >> a >> b >> c;) {
        grains.push_back({{a, b, c}, 1.0});
      }
    } else {
      grains = io::read_packing(*path).packing.grains;
    }
    const auto t = compiled_triangulation{}(grains, unbounded());
    const std::size_t edges = edges_of(t.net).size();
    CHECK(t.report.hidden.empty());
    CHECK(grains.size() == x.v);
    CHECK(edges == x.e);
    CHECK(t.net.throat_count() == x.f);
    CHECK(t.net.pore_count() == x.c);
    CHECK(grains.size() + t.net.throat_count() == edges + t.net.pore_count() + 1);
  }
}

TEST_CASE("void + solid = region at a million boxes from the origin") {
  packing p = shared_packing("packings/open_1000.txt");
  if (p.grains.empty()) {
    return;
  }
  const vec3<double> away{1e6, -1e6, 1e6};
  for (auto& g : p.grains) {
    g.centre += away;
  }
  p.bounds = box{p.bounds->lo + away, p.bounds->hi + away};
  for (const char* axes : {"www", "ppp"}) {
    check_filled(p, axes);
  }
}

TEST_CASE("the void of 100 random pores, those at walls among them, agrees with counting random points") {
  const packing p = shared_packing("packings/open_dem_1000.txt");
  if (p.grains.empty()) {
    return;
  }
  const auto t = compiled_triangulation{}(p.grains, region_of(p, "www"));
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  constexpr int points = 20000;
  double chi2 = 0;
  std::size_t at_walls = 0;
  for (int n = 0; n < 100; ++n) {
    const pore_id q(static_cast<std::size_t>(uniform(random) * static_cast<double>(t.net.pore_count())));
    const auto body = pore_body_at(t.net, q);
    at_walls += body.grain_count < 4 ? 1U : 0U;
    const auto shape = detail::in_frame(body, [](const auto& cell) { return cell.solid(); });
    const auto around = detail::bounds_of(body);
    int inside = 0;
    int outside_grains = 0;
    while (inside < points) {
      vec3<double> at;
      for (std::size_t k = 0; k < 3; ++k) {
        at[k] = around.lo[k] + uniform(random) * (around.hi[k] - around.lo[k]);
      }
      bool in_cell = true;
      for (std::size_t f = 0; f < shape.face_count() && in_cell; ++f) {
        in_cell = shape.inner_side(f).distance(at - body.grains[0].centre) >= 0;
      }
      if (!in_cell) {
        continue;
      }
      ++inside;
      bool dry = true;
      for (const auto& g : p.grains) {  // every grain of the packing, not the pore's own
        dry = dry && power(at, g) > 0;
      }
      outside_grains += dry ? 1 : 0;
    }
    const double share = t.net.void_volume(q) / t.net.volume(q);
    const double sigma = std::sqrt(share * (1 - share) / points);
    const double z = (static_cast<double>(outside_grains) / points - share) / sigma;
    chi2 += z * z;
  }
  CHECK(at_walls > 5);
  // chi² of 100 degrees of freedom: mean 100, standard deviation 14; five of these above, four below
  CHECK(chi2 < 170);
  CHECK(chi2 > 40);
}
