// SPDX-License-Identifier: BSD-3-Clause
//
// Permeability by lattice Boltzmann, of simple cubic spheres against Zick & Homsy (J. Fluid Mech. 115, 13, 1982), and
// its curved walls against Poiseuille's flow in a round tube.

#include "support/killed_waits.hpp"
#include "support/sanitized.hpp"
#include "tetrapore/lbm/permeability.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

using namespace tetrapore;
using namespace tetrapore::lbm;

namespace {

periodic_spheres simple_cubic(double fraction) {
  const double radius = std::cbrt(3 * fraction / (4 * std::numbers::pi));
  return {{1, 1, 1}, {{{0, 0, 0}, radius}}, {false, true, true}};
}

bool refused(const periodic_spheres& p, int nodes, std::size_t axis, const permeability_options& how = {}) {
  try {
    (void)measure_permeability(p, nodes, axis, how);
  } catch (const parameter_error&) {
    return true;
  }
  return false;
}

/// The largest error of the velocity in a round tube, relative to that of the axis.
double tube_error(double radius, double tau) {
  using fluid = mixture<d3q19, trt, guo, linear_potential, 1>;
  const double centre = radius + 1.3;  // nowhere in the middle between nodes
  const int width = static_cast<int>(2 * centre) + 1;
  const auto squared = [&](double x, double y) { return (x - centre) * (x - centre) + (y - centre) * (y - centre); };
  fluid m;
  m.collisions[0].tau = tau;
  m.reference = {1};
  const double top = 0.01;
  m.gravity = {0, 0, 4 * m.viscosity(0) * top / (radius * radius)};
  simulation<fluid> s(m, {{{width, width, 1}, {}, {}}, [&](int x, int y, int) {
                            return site{squared(x, y) < radius * radius ? site_kind::fluid : site_kind::solid, 0};
                          }});
  std::vector<wall_cut> cuts;
  for (std::size_t n = 0; n < s.sites().size(); ++n) {
    const auto& p = s.sites().place(n);
    for (int k = 1; k < 19; ++k) {
      const auto& c = d3q19::velocity[static_cast<std::size_t>(k)];
      if (s.sites().node_at(p[0] + c[0], p[1] + c[1], 0) == site_map<d3q19>::none) {
        const double a = c[0] * c[0] + c[1] * c[1];
        const double b = c[0] * (p[0] - centre) + c[1] * (p[1] - centre);
        cuts.push_back({n, k, (std::sqrt(b * b + a * (radius * radius - squared(p[0], p[1]))) - b) / a});
      }
    }
  }
  curved_walls walls(s, cuts);
  REQUIRE(walls.size() > 0);
  for (auto left = static_cast<int>(5 * radius * radius / m.viscosity(0)); left > 0; --left) {
    s.step();
    walls.apply();
  }
  double worst = 0;
  for (std::size_t n = 0; n < s.sites().size(); ++n) {
    const auto& p = s.sites().place(n);
    const double exact = top * (1 - squared(p[0], p[1]) / (radius * radius));
    worst = std::max(worst, std::abs(s.velocity(n)[2] - exact) / top);
  }
  return worst;
}

}  // namespace

TEST_CASE("in a round tube the error falls as the square of the width of a node, whatever the viscosity") {
  const double coarse = tube_error(5.4, 1);
  const double fine = tube_error(10.8, 1);
  CHECK(coarse < 0.03);  // of the order of (1/5.4)² = .034; half-way alone .12
  CHECK(fine < coarse / 3);
  CHECK(tube_error(5.4, 0.7) == doctest::Approx(coarse).epsilon(1e-3).scale(0));
}

TEST_CASE("a cut that is not on its link is refused") {
  simulation<mixture<d3q19, trt, guo, linear_potential, 1>> s(
      {}, {{{3, 3, 3}, {}, {}}, [](int x, int, int) {
             return site{x == 1 ? site_kind::solid : site_kind::fluid, 0};
           }});
  for (const double share : {0.0, -0.5, 1.01, std::numeric_limits<double>::quiet_NaN()}) {
    CHECK_THROWS_AS((curved_walls(s, std::vector<wall_cut>{{0, 1, share}})), parameter_error);
  }
}

TEST_CASE("simple cubic spheres resist as Zick and Homsy say") {
  // drag / (6πμaU) of three solid fractions, given to three figures; 1 % is asked of the lattice
  for (const auto& [fraction, drag] : {std::array{0.343, 15.4}, std::array{0.45, 28.1}, std::array{0.5236, 42.1}}) {
    if (sanitized && fraction < 0.5) {
      continue;
    }
    const periodic_spheres p = simple_cubic(fraction);
    const double exact = 1 / (6 * std::numbers::pi * p.spheres[0].radius * drag);
    const auto k = measure_permeability(p, 24, 0);
    REQUIRE(k.ok());
    CHECK(std::abs(k.value.permeability / exact - 1) < 0.01);
    CHECK(measured(k).value == k.value.permeability);
    CHECK(measured(k).upper - measured(k).lower < 1e-6 * k.value.permeability);
    CHECK(k.value.half_way_links < k.value.wall_links / 5);
    CHECK(std::abs(k.value.porosity - (1 - fraction)) < 0.01);
  }
}

TEST_CASE("two lattices whose errors are of the second order give the limit and the error of the finer") {
  const auto of = [](double node) {
    lattice_permeability k{};
    k.node = node;
    k.permeability = 2 * (1 - 0.5 * node * node);
    return k;
  };
  const auto limit = extrapolated(of(0.3), of(0.1));
  CHECK(limit.permeability == doctest::Approx(2).epsilon(1e-14).scale(0));
  CHECK(limit.discretisation == doctest::Approx(0.005).epsilon(1e-12).scale(0));
}

TEST_CASE("permeability does not depend on the viscosity that it is measured with") {
  const periodic_spheres p = simple_cubic(0.45);
  const double reference = measure_permeability(p, 12, 0).value.permeability;
  for (const double tau : {0.6, 1.6}) {
    // what is left is how steady the flux is asked to be
    CHECK(measure_permeability(p, 12, 0, {.tau = tau}).value.permeability ==
          doctest::Approx(reference).epsilon(1e-5).scale(0));
  }
}

TEST_CASE("half of a box between mirrors and the whole of it have one permeability") {
  periodic_spheres p = simple_cubic(0.343);
  const double halved = measure_permeability(p, 12, 0).value.permeability;
  p.halved = {false, false, false};
  CHECK(measure_permeability(p, 12, 0).value.permeability == doctest::Approx(halved).epsilon(1e-9).scale(0));
  CHECK(measure_permeability(p, 12, 2).value.permeability == doctest::Approx(halved).epsilon(1e-5).scale(0));
}

TEST_CASE("a permeability that cannot be measured is refused, or said not to be steady") {
  periodic_spheres p = simple_cubic(0.343);
  CHECK(refused(p, 13, 0));  // half of an odd number of nodes
  CHECK(refused(p, 12, 1));  // along a halved axis
  CHECK(refused(p, 12, 3));
  CHECK(refused(p, 12, 0, {.tau = 0.5}));
  const auto cut = measure_permeability(p, 24, 0, {.cap = 100});
  CHECK(cut.reason == flow_status::still_changing);
  CHECK(cut.kind() == verdict::failed);
  CHECK(std::isnan(cut.value.permeability));
  p.spheres[0].radius = 2;
  CHECK(refused(p, 12, 0));  // no fluid left
  p.spheres[0].radius = 0.01;
  CHECK(refused(p, 12, 0));  // smaller than the lattice sees
  p.spheres.clear();
  CHECK(refused(p, 12, 0));  // nothing resists
  p.spheres[0].radius = std::numeric_limits<double>::quiet_NaN();
  CHECK(refused(p, 12, 0));
}

TEST_CASE("a permeability that is killed goes on to the bit; the state of another is refused") {
  const auto of = [](double fraction, double tau) {
    return [=](kept_waits* kept) {
      permeability_options how{.tau = tau, .steady = 1e-3};
      how.kept = kept;
      const auto k = measure_permeability(simple_cubic(fraction), 8, 0, how);
      return std::vector{k.value.permeability, static_cast<double>(k.value.steps), static_cast<double>(k.reason)};
    };
  };
  const auto all = killed_waits::goes_on_to_the_bit(of(0.3, 1), 1);
  killed_waits::refuses(all, of(0.301, 1));
  killed_waits::refuses(all, of(0.3, 1.001));
  killed_waits::goes_on_to_the_bit(of(0.3, 0.8), 1);  // an odd number of steps between two looks
}
