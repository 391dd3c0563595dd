// SPDX-License-Identifier: BSD-3-Clause
//
// Two components that repel each other, measured: densities of a flat interface, surface tension of bubbles of three
// sizes. Prints the rows of include/tetrapore/lbm/coexistence.hpp: calibrate_pair G…
//
// D3Q19, BGK, velocity shift, τ = 1. The mean of the main densities of both phases is brought to 1.003, at which the
// tension of a bubble of 18 nodes of the tabulated mixture (G = 1.8) is .0910.
#include "tetrapore/lbm/coexistence.hpp"
#include "tetrapore/lbm/simulation.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <numbers>

namespace lbm = tetrapore::lbm;
using fluid = lbm::mixture<lbm::d3q19, lbm::bgk>;

namespace {

constexpr double main_density = 1.003;

fluid fluid_of(double attraction) {
  fluid m;
  m.attraction = {{{0, attraction}, {attraction, 0}}};
  m.reference = {1, 1};
  return m;
}

/// c of the flat interface.
double measured_factor(double attraction) {
  double c = 2;
  double start = main_density;
  for (int turn = 0; turn < 4; ++turn) {
    const double dissolved = lbm::dissolved_density({attraction, c, 0, start}).value;
    const lbm::lattice_box box{{1, 1, 64},
                               {lbm::face_kind::periodic, lbm::face_kind::periodic, lbm::face_kind::mirror},
                               {lbm::face_kind::periodic, lbm::face_kind::periodic, lbm::face_kind::mirror}};
    lbm::simulation<fluid, double, lbm::storage::in_place, 1> s(fluid_of(attraction),
                                                                {box, [](int, int, int) { return lbm::site{}; }});
    s.initialise([&](const std::array<int, 3>& p, auto& rho, auto&) {
      const double gas = 0.5 * (1 + std::tanh((31.5 - p[2]) / 1.5));
      rho = {dissolved + (start - dissolved) * gas, start + (dissolved - start) * gas};
    });
    s.run(20000);
    const auto rho = s.densities_at(0);
    c = std::log(rho[0] / rho[1]) / (attraction * (rho[0] - rho[1]));
    start += main_density - rho[0];
  }
  return c;
}

struct bubble {
  double radius;
  double tension;
};

bubble measured_bubble(const lbm::coexistence& pair, double radius, double tension) {
  bubble b{radius, tension};
  lbm::coexistence start = pair;
  for (int turn = 0; turn < 3; ++turn) {
    const int n = static_cast<int>(1.75 * radius) + 2;
    const auto rho = lbm::reservoirs(start, 2 * b.tension / b.radius).value;
    const std::array<lbm::face_kind, 3> mirrors{lbm::face_kind::mirror, lbm::face_kind::mirror, lbm::face_kind::mirror};
    lbm::simulation<fluid, float> s(fluid_of(pair.attraction),
                                    {{{n, n, n}, mirrors, mirrors}, [](int, int, int) { return lbm::site{}; }});
    s.initialise([&](const std::array<int, 3>& p, auto& start_rho, auto&) {
      const double r = std::hypot(p[0] + 0.5, p[1] + 0.5, p[2] + 0.5);
      const double gas = 0.5 * (1 + std::tanh((radius - r) / 1.5));
      for (std::size_t c = 0; c < 2; ++c) {
        start_rho[c] = rho.liquid[c] + (rho.gas[c] - rho.liquid[c]) * gas;
      }
    });
    s.run(4000);
    const auto node = [&](int at) { return static_cast<std::size_t>(s.sites().node_at(at, at, at)); };
    const auto in = s.densities_at(node(0));
    const auto out = s.densities_at(node(n - 1));
    double volume = 0;  // of the octant, by what the difference of densities exceeds that of the liquid
    for (std::size_t k = 0; k < s.sites().size(); ++k) {
      const auto here = s.densities_at(k);
      volume += ((here[0] - here[1]) - (out[0] - out[1])) / ((in[0] - in[1]) - (out[0] - out[1]));
    }
    b.radius = std::cbrt(6 * volume / std::numbers::pi);
    b.tension = b.radius / 2 * (s.model().pressure(in) - s.model().pressure(out));
    start.main += pair.main - (in[0] + out[1]) / 2;
  }
  return b;
}

}  // namespace

int main(int argc, char** argv) {
  for (int k = 1; k < argc; ++k) {
    const double attraction = std::strtod(argv[k], nullptr);
    const lbm::coexistence pair{attraction, measured_factor(attraction), 0.5, main_density};
    std::array<bubble, 3> b{};
    double guess = 0.09;
    for (std::size_t i = 0; i < 3; ++i) {
      b[i] = measured_bubble(pair, std::array{7.0, 11.0, 17.0}[i], guess);
      guess = b[i].tension;
      std::fprintf(stderr, "R = %.3f: %.5f\n", b[i].radius, b[i].tension);
    }
    // the line through σ against 1/R that comes closest
    double x = 0, y = 0, xx = 0, xy = 0;
    for (const bubble& one : b) {
      x += 1 / (3 * one.radius);
      y += one.tension / 3;
      xx += 1 / (3 * one.radius * one.radius);
      xy += one.tension / (3 * one.radius);
    }
    const double slope = (xy - x * y) / (xx - x * x);
    const double flat = y - slope * x;
    std::printf("{%.1f, %.3f, %.5f, %.2f, %.4f, %.4f, %.2f},\n", attraction, main_density, pair.factor, pair.common,
                flat + slope / 18, flat, slope / flat);
    std::fflush(stdout);
  }
}
