// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/lbm/mixture.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>

using namespace tetrapore::lbm;

TEST_CASE("one node collides in plain numbers, without storage") {
  using fluids = mixture<d3q19, bgk>;
  constexpr std::size_t count = fluids::directions;
  fluids m;
  m.collisions[0].tau = 0.8;
  m.collisions[1].tau = 1.3;
  m.attraction = {{{0.2, 1.5}, {1.5, -0.1}}};
  m.reference = {1, 0.5};
  m.gravity = {0, 1e-3, 0};
  std::array<std::array<double, count>, 2> f{};
  std::array<std::array<double, count>, 2> psi{};
  for (std::size_t c = 0; c < 2; ++c) {
    for (std::size_t i = 0; i < count; ++i) {
      const double k = static_cast<double>(i + count * c);
      f[c][i] = 0.01 * std::sin(3 * k);
      psi[c][i] = 0.5 + 0.1 * std::cos(5 * k);
    }
  }
  std::array<std::array<double, count>, 2> after{};
  m.collide<double>([&]<int C, int I>(detail::number<C>, detail::number<I>) { return f[C][I]; },
                    [&]<int C, int I>(detail::number<C>, detail::number<I>) { return psi[C][I]; },
                    [&]<int C, int I>(detail::number<C>, detail::number<I>, double x) { after[C][I] = x; });

  // the formulas as they are printed, u_a = Σ j/τ / Σ ρ/τ + τ_a F_a/ρ_a
  const auto& c_of = d3q19::velocity;
  std::array<double, 2> rho = m.reference;
  std::array<std::array<double, 3>, 2> momentum{};
  std::array<std::array<double, 3>, 2> slope{};
  for (std::size_t c = 0; c < 2; ++c) {
    for (std::size_t i = 0; i < count; ++i) {
      rho[c] += f[c][i];
      for (std::size_t a = 0; a < 3; ++a) {
        momentum[c][a] += f[c][i] * c_of[i][a];
        slope[c][a] += d3q19::weight[i] * psi[c][i] * c_of[i][a];
      }
    }
  }
  for (std::size_t c = 0; c < 2; ++c) {
    const double tau = m.collisions[c].tau;
    std::array<double, 3> u{};
    for (std::size_t a = 0; a < 3; ++a) {
      const double common = (momentum[0][a] / m.collisions[0].tau + momentum[1][a] / m.collisions[1].tau) /
                            (rho[0] / m.collisions[0].tau + rho[1] / m.collisions[1].tau);
      u[a] = common +
             tau * (m.gravity[a] - m.attraction[c][0] * slope[0][a] - m.attraction[c][1] * slope[1][a]);  // psi = rho
    }
    for (std::size_t i = 0; i < count; ++i) {
      double cu = 0;
      double uu = 0;
      for (std::size_t a = 0; a < 3; ++a) {
        cu += c_of[i][a] * u[a];
        uu += u[a] * u[a];
      }
      const double settled = d3q19::weight[i] * (rho[c] * (1 + 3 * cu + 4.5 * cu * cu - 1.5 * uu) - m.reference[c]);
      // sums of 19 numbers below 1, rounded
      CHECK(after[c][i] == doctest::Approx(f[c][i] + (settled - f[c][i]) / tau).epsilon(19 * 0x1p-53).scale(1));
    }
  }
}
