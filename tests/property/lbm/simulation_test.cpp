// SPDX-License-Identifier: BSD-3-Clause
//
// What every mixture on every storage keeps: mass to the last bit, momentum in a periodic box, mirrors to the last bit,
// rotations to rounding; the same numbers in all storages.

#include "tetrapore/lbm/simulation.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>

using namespace tetrapore::lbm;
using place = std::array<int, 3>;

namespace {

/// A number in 0 … 1 that belongs to a place.
double noise(const place& p, std::uint32_t salt) {
  std::uint64_t h = salt;
  for (const int x : p) {
    h = (h ^ static_cast<std::uint64_t>(x + 1000)) * std::uint64_t{0x9E3779B97F4A7C15};
    h ^= h >> 29U;
  }
  return static_cast<double>(h >> 11U) * 0x1p-53;
}

template <class Model>
Model repelling(double tau = 0.9) {
  Model m;
  for (std::size_t c = 0; c < Model::components; ++c) {
    m.collisions[c].tau = tau + 0.1 * static_cast<double>(c);
    m.reference[c] = 1;
    for (std::size_t b = 0; b < Model::components; ++b) {
      m.attraction[c][b] = b == c ? 0 : 1.5;
    }
  }
  return m;
}

lattice_box box_of(const place& size, face_kind kind = face_kind::periodic) {
  return {size, {kind, kind, kind}, {kind, kind, kind}};
}

/// Blobs of the components and a stir, seen through a map of places.
template <class Simulation, class Map>
void stir(Simulation& s, Map map, double sign_x = 1) {
  s.initialise([&](const place& p, auto& rho, auto& u) {
    const place q = map(p);
    for (std::size_t c = 0; c < rho.size(); ++c) {
      rho[c] = 0.2 + 0.7 * noise(q, 1 + static_cast<std::uint32_t>(c));
    }
    u = {sign_x * (0.02 * noise(q, 11) - 0.01), 0.02 * noise(q, 12) - 0.01, 0.02 * noise(q, 13) - 0.01};
  });
}

const auto as_it_is = [](const place& p) { return p; };

/// A box with a solid ball that shows the components different densities.
site_map<d3q19> with_ball(const place& size) {
  return {box_of(size), [size](int x, int y, int z) {
            const double d = std::hypot(x - 0.4 * size[0], y - 0.5 * size[1], z - 0.6 * size[2]);
            return site{d < 3 ? site_kind::solid : site_kind::fluid, 3};
          }};
}

template <class T, class Model>
double worst_drift(std::size_t steps) {
  simulation<Model, T> s(repelling<Model>(), with_ball({9, 10, 11}));
  s.set_wall(3, {0.4, 0.7});
  stir(s, as_it_is);
  const double before[] = {s.mass(0), s.mass(1)};
  s.run(steps);
  return std::max(std::abs(s.mass(0) / before[0] - 1), std::abs(s.mass(1) / before[1] - 1));
}

}  // namespace

TEST_CASE_TEMPLATE("the mass of a component stays what it was, in float too", T, double, float) {
  CHECK(worst_drift<T, mixture<d3q19, bgk>>(2000) < 1e-15);
  CHECK(worst_drift<T, mixture<d3q19, trt, guo>>(2000) < 1e-15);
  CHECK(worst_drift<T, mixture<d3q19, regularised, guo, exponential_potential>>(2000) < 1e-15);
}

TEST_CASE_TEMPLATE("a periodic box keeps its momentum", Model, mixture<d3q19, bgk>, mixture<d3q19, trt, guo>,
                   mixture<d3q27, regularised, guo>, mixture<d2q9, bgk, velocity_shift>) {
  const place size = Model::lattice_type::dimensions == 2 ? place{16, 15, 1} : place{8, 9, 10};
  simulation<Model, double> s(
      repelling<Model>(), site_map<typename Model::lattice_type>(box_of(size), [](int, int, int) { return site{}; }));
  stir(s, as_it_is);
  const auto momentum = [&] {
    std::array<double, 3> sum{};
    for (std::size_t n = 0; n < s.sites().size(); ++n) {
      for (std::size_t c = 0; c < 2; ++c) {
        for (std::size_t i = 1; i < Model::directions; ++i) {
          for (std::size_t a = 0; a < 3; ++a) {
            sum[a] += s.population(c, n, i) * Model::lattice_type::velocity[i][a];
          }
        }
      }
    }
    return sum;
  };
  const auto before = momentum();
  s.run(200);
  const auto after = momentum();
  for (std::size_t a = 0; a < static_cast<std::size_t>(Model::lattice_type::dimensions); ++a) {
    // each of 720 nodes rounds by 2^-53 a population: a walk of 200 steps
    CHECK(std::abs(after[a] - before[a]) < 1e-12);
  }
}

TEST_CASE_TEMPLATE("both storages and every width of batch give the same bits", T, double, float) {
  using model = mixture<d3q19, bgk>;
  simulation<model, T, storage::in_place> one(repelling<model>(), with_ball({9, 10, 21}));
  simulation<model, T, storage::two_lattices> two(repelling<model>(), with_ball({9, 10, 21}));
  simulation<model, T, storage::in_place, 2> narrow(repelling<model>(), with_ball({9, 10, 21}));
  for (const std::size_t steps : {0U, 1U, 10U, 31U}) {
    stir(one, as_it_is);
    stir(two, as_it_is);
    stir(narrow, as_it_is);
    one.run(steps);
    two.run(steps);
    narrow.run(steps);
    std::size_t differing = 0;
    for (std::size_t n = 0; n < one.sites().size(); ++n) {
      for (std::size_t c = 0; c < 2; ++c) {
        for (std::size_t i = 0; i < 19; ++i) {
          differing += one.population(c, n, i) != two.population(c, n, i) ? 1U : 0U;
          differing += one.population(c, n, i) != narrow.population(c, n, i) ? 1U : 0U;
        }
      }
    }
    CHECK(differing == 0);
  }
}

TEST_CASE_TEMPLATE("the mirror image of a state stays the mirror image, to the last bit", Model, mixture<d3q19, bgk>,
                   mixture<d3q19, trt, guo>, mixture<d3q27, regularised, guo>) {
  using map_type = site_map<typename Model::lattice_type>;
  const place size{8, 6, 7};
  const auto all_fluid = [](int, int, int) { return site{}; };
  simulation<Model, double> here(repelling<Model>(), map_type(box_of(size), all_fluid));
  simulation<Model, double> there(repelling<Model>(), map_type(box_of(size), all_fluid));
  const auto image = [&](const place& p) { return place{size[0] - 1 - p[0], p[1], p[2]}; };
  stir(here, as_it_is);
  stir(there, image, -1);
  here.run(50);
  there.run(50);
  std::size_t differing = 0;
  for (std::size_t n = 0; n < here.sites().size(); ++n) {
    const place p = image(here.sites().place(n));
    const auto m = static_cast<std::size_t>(there.sites().node_at(p[0], p[1], p[2]));
    for (std::size_t c = 0; c < 2; ++c) {
      for (std::size_t i = 0; i < Model::directions; ++i) {
        const auto j = static_cast<std::size_t>(mirrored<typename Model::lattice_type>(static_cast<int>(i), 0));
        differing += here.population(c, n, i) != there.population(c, m, j) ? 1U : 0U;
      }
    }
  }
  CHECK(differing == 0);
}

TEST_CASE("a box between mirrors is a quarter of the periodic box of all its images, to the last bit") {
  using model = mixture<d3q19, bgk>;
  const place size{5, 7, 6};
  const auto all_fluid = [](int, int, int) { return site{}; };
  lattice_box part = box_of(size, face_kind::mirror);
  part.low[2] = part.high[2] = face_kind::periodic;
  simulation<model, double> quarter(repelling<model>(), {part, all_fluid});
  simulation<model, double> whole(repelling<model>(), {box_of({10, 14, 6}), all_fluid});
  const auto fold = [&](const place& p) {
    return place{p[0] < 5 ? p[0] : 9 - p[0], p[1] < 7 ? p[1] : 13 - p[1], p[2]};
  };
  const auto rest = [&](auto& s) {
    s.initialise([&](const place& p, auto& rho, auto&) {
      rho[0] = 0.2 + 0.7 * noise(fold(p), 1);
      rho[1] = 0.2 + 0.7 * noise(fold(p), 2);
    });
  };
  rest(quarter);
  rest(whole);
  quarter.run(41);
  whole.run(41);
  std::size_t differing = 0;
  for (std::size_t n = 0; n < quarter.sites().size(); ++n) {
    const place p = quarter.sites().place(n);
    const auto m = static_cast<std::size_t>(whole.sites().node_at(p[0], p[1], p[2]));
    for (std::size_t i = 0; i < 19; ++i) {
      differing += quarter.population(0, n, i) != whole.population(0, m, i) ? 1U : 0U;
      differing += quarter.population(1, n, i) != whole.population(1, m, i) ? 1U : 0U;
    }
  }
  CHECK(differing == 0);
}

TEST_CASE("a box turned by a right angle stays the turned one, to rounding") {
  using model = mixture<d3q19, trt, guo>;
  const auto all_fluid = [](int, int, int) { return site{}; };
  simulation<model, double> here(repelling<model>(), {box_of({6, 7, 8}), all_fluid});
  simulation<model, double> there(repelling<model>(), {box_of({7, 6, 8}), all_fluid});
  // (x, y) of here is (y, 5 − x) of there
  const auto rest = [](auto& s, auto of) {
    s.initialise([&](const place& p, auto& rho, auto&) {
      rho[0] = 0.2 + 0.7 * noise(of(p), 1);
      rho[1] = 0.2 + 0.7 * noise(of(p), 2);
    });
  };
  rest(here, as_it_is);
  rest(there, [](const place& p) { return place{5 - p[1], p[0], p[2]}; });
  here.run(40);
  there.run(40);
  double worst = 0;
  for (std::size_t n = 0; n < here.sites().size(); ++n) {
    const place p = here.sites().place(n);
    const auto m = static_cast<std::size_t>(there.sites().node_at(p[1], 5 - p[0], p[2]));
    worst = std::max(worst, std::abs(here.density(0, n) - there.density(0, m)));
  }
  CHECK(worst < 1e-13);
}
