// SPDX-License-Identifier: BSD-3-Clause
//
// One component whose exponential pseudopotential attracts: liquid beside vapour, against the equal-area rule.

#include "tetrapore/lbm/simulation.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

using namespace tetrapore::lbm;

namespace {

constexpr double strength = -4.4;  // the critical one is -4

double psi(double rho) { return 1 - std::exp(-rho); }
double pressure(double rho) { return rho / 3 + strength * psi(rho) * psi(rho) / 6; }

/// The density of a pressure in a range in which pressure rises.
double density_of(double p, double low, double high) {
  for (int turn = 0; turn < 60; ++turn) {
    const double middle = (low + high) / 2;
    (pressure(middle) < p ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// Vapour and liquid of one pressure p with ∫ (p − pressure(ρ)) dψ/ψ = 0 between them.
std::array<double, 2> equal_areas() {
  const double root = std::sqrt(1 + 4 / strength);
  const double vapour_ends = -std::log((1 + root) / 2);  // pressure' = 0: ψ (1 − ψ) = −1/G
  const double liquid_begins = -std::log((1 - root) / 2);
  double low = std::max(0.0, pressure(liquid_begins));
  double high = pressure(vapour_ends);
  std::array<double, 2> rho{};
  for (int turn = 0; turn < 60; ++turn) {
    const double p = (low + high) / 2;
    rho = {density_of(p, 0, vapour_ends), density_of(p, liquid_begins, 20)};
    constexpr int pieces = 2000;
    double area = 0;
    for (int k = 0; k < pieces; ++k) {
      const double at = rho[0] + (rho[1] - rho[0]) * (k + 0.5) / pieces;
      area += (p - pressure(at)) * std::exp(-at) / psi(at);
    }
    (area < 0 ? low : high) = p;
  }
  return rho;
}

/// How fast, per node, what differs from a phase fades: 4 sinh²(rate/2) = −12 pressure'/(G ψ ψ').
double rate_of(double rho) {
  const double slope = std::exp(-rho);
  return 2 * std::asinh(std::sqrt(-12 * (1 / (3 * strength * psi(rho) * slope) + 1.0 / 3)) / 2);
}

}  // namespace

TEST_CASE("liquid and vapour have the densities of the equal-area rule") {
  // With Guo's source and τ = 1 what a node at rest sends is known, so that momentum balances where
  // ρ/3 + G ψ (ψ₊ + ψ₋)/12 of a node and its neighbours is one number along the row. That is the extremum of a sum over
  // nodes, of ψ ψ₊ less a function of ψ: an interface that can stand anywhere has the same on both sides, which is the
  // equal-area rule itself. What pins an interface to nodes is of the order exp(−π²/rate).
  using fluid = mixture<d2q9, bgk, guo, exponential_potential, 1>;
  fluid model;
  model.attraction = {{{strength}}};
  model.reference = {1};
  constexpr int nodes = 64;
  const lattice_box box{{1, nodes, 1},
                        {face_kind::periodic, face_kind::mirror, face_kind::periodic},
                        {face_kind::periodic, face_kind::mirror, face_kind::periodic}};
  simulation<fluid, double> s(model, {box, [](int, int, int) { return site{}; }});
  s.initialise([](const std::array<int, 3>& p, auto& rho, auto&) { rho[0] = p[1] < nodes / 2 ? 1.2 : 0.4; });
  s.run(40000);
  const auto [vapour, liquid] = equal_areas();
  const double pinned = std::exp(-std::numbers::pi * std::numbers::pi / std::max(rate_of(vapour), rate_of(liquid)));
  CHECK(pinned < 1e-4);
  CHECK(s.density(0, 0) == doctest::Approx(liquid).epsilon(pinned).scale(0));
  CHECK(s.density(0, nodes - 1) == doctest::Approx(vapour).epsilon(pinned).scale(0));
}
