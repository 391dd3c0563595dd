// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/one_phase/volume_rates.hpp"
#include "tetrapore/simplex/pore_volume.hpp"

#include <doctest/doctest.h>

#include "support/small_networks.hpp"
#include "support/walled_cells.hpp"

#include <cmath>

using namespace tetrapore;
using namespace tetrapore_test;

namespace {

moving_body<double> random_motion(random_engine& random, std::size_t grains, double offset = 0) {
  moving_body<double> m{random_cell(random, grains), {}, {}};
  for (std::size_t k = 0; k < grains; ++k) {
    m.velocities[k] = uniform_point(random, -1, 1);
  }
  for (std::size_t w = 0; w < m.body.wall_count(); ++w) {
    m.wall_speeds[w] = uniform(random, -1, 1);
  }
  const vec3<double> move{offset, 2 * offset, -offset};
  for (auto& g : m.body.grains) {
    g.centre += move;
  }
  for (auto& w : m.body.walls) {
    w.point += move;
  }
  return m;
}

/// The cell after a time.
template <class T>
pore_body<T> later(const moving_body<double>& m, T time) {
  pore_body<T> b = convert<T>(m.body);
  for (std::size_t k = 0; k < b.grain_count; ++k) {
    for (std::size_t a = 0; a < 3; ++a) {
      b.grains[k].centre[a] = b.grains[k].centre[a] + time * static_cast<T>(m.velocities[k][a]);
    }
  }
  for (std::size_t w = 0; w < b.wall_count(); ++w) {
    b.walls[w].point += b.walls[w].normal * (time * static_cast<T>(m.wall_speeds[w]));
  }
  return b;
}

}  // namespace

TEST_CASE("the volume rate of every shape of cell is the derivative of its volume") {
  random_engine random(11);
  for (const double offset : {0.0, 1e3}) {
    for (std::size_t grains = 1; grains <= 4; ++grains) {
      for (int n = 0; n < 500; ++n) {
        const moving_body<double> m = random_motion(random, grains, offset);
        // a cubic in time: the five-point rule is exact, up to the rounding of long double over the step
        const long double h = 0.125L;
        const auto v = [&](long double t) { return total_volume(later<long double>(m, t)); };
        const auto slope = static_cast<double>((8 * (v(h) - v(-h)) - (v(2 * h) - v(-2 * h))) / (12 * h));
        CHECK(std::abs(volume_rate(m) - slope) < 64 * epsilon<double> * 4);
      }
    }
  }
}

TEST_CASE("cells that move as one body keep their volume to the last bit") {
  random_engine random(12);
  for (std::size_t grains = 1; grains <= 4; ++grains) {
    for (int n = 0; n < 200; ++n) {
      moving_body<double> m = random_motion(random, grains);
      m.velocities.fill({0.75, -0.5, 0.375});
      for (std::size_t w = 0; w < m.body.wall_count(); ++w) {
        m.wall_speeds[w] = dot(m.velocities[0], m.body.walls[w].normal);
      }
      CHECK(volume_rate(m) == 0);
    }
  }
}

TEST_CASE("cells between grains and walls that all grow alike grow by the trace of the growth") {
  random_engine random(13);
  for (std::size_t grains = 1; grains <= 4; ++grains) {
    for (int n = 0; n < 200; ++n) {
      moving_body<double> m = random_motion(random, grains);
      const vec3<double> growth = uniform_point(random, -1, 1);
      for (std::size_t k = 0; k < grains; ++k) {
        const vec3<double>& c = m.body.grains[k].centre;
        m.velocities[k] = {growth.x * c.x, growth.y * c.y, growth.z * c.z};
      }
      m.wall_speeds.fill(0);  // the walls pass through the origin
      const double expected = (growth.x + growth.y + growth.z) * total_volume(m.body);
      CHECK(std::abs(volume_rate(m) - expected) < 64 * epsilon<double>);
    }
  }
}

TEST_CASE("a closed box of two grains keeps its volume, a piston takes what it sweeps") {
  network net = two_grains_in_a_box();
  const std::vector<vec3<double>> velocities{{0.3, -0.2, 0.7}, {-0.4, 0.1, 0.9}};
  motion m{.velocities = velocities};
  const auto sum = [&] {
    double total = 0;
    const volume_rates rates = rates_of_volume(net, m);
    for (const double v : rates.values) {
      total += v;
    }
    CHECK(rates.rounding < 1e-12);
    return std::pair{total, rates.rounding};
  };
  const auto [closed, rounding] = sum();
  CHECK(std::abs(closed) <= rounding);
  m.walls[static_cast<std::size_t>(face::z_max)] = {5, 5, -0.25};
  const auto [pushed, error] = sum();
  CHECK(std::abs(pushed - -0.25 * 4 * 2) <= error);
}

TEST_CASE("volume rates want a velocity for each grain") {
  const network net = one_tetrahedron();
  const std::vector<vec3<double>> three(3);
  CHECK_THROWS_AS((void)rates_of_volume(net, {.velocities = three}), parameter_error);
}
