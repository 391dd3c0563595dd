// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/eliminate.hpp"
#include "tetrapore/core/error.hpp"
#include "tetrapore/core/outcome.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

/// \file
/// Two components side by side: which densities belong to a capillary pressure.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// Why densities are what they are.
enum class coexistence_status : unsigned char {
  ok,
  no_separation,  ///< refused: the repulsion is too weak for two phases of this density
  dissolved,      ///< refused: at this capillary pressure a phase gives way, no densities go with it
  invalid_input   ///< refused: NaN, a strength or density that is not above 0
};

[[nodiscard]] constexpr verdict verdict_of(coexistence_status s) noexcept {
  return s == coexistence_status::ok ? verdict::ok : verdict::refused;
}
[[nodiscard]] constexpr const char* describe(coexistence_status s) noexcept {
  switch (s) {
    case coexistence_status::ok: return "ok";
    case coexistence_status::no_separation: return "the components mix: their repulsion is too weak for two phases";
    case coexistence_status::dissolved: return "a phase dissolves: no densities belong to this capillary pressure";
    case coexistence_status::invalid_input: return "a strength, density or pressure outside the domain";
  }
  return "not a coexistence status";
}

/// How two components of ψ = ρ that repel each other part.
///
/// At rest ∇ρ_a/3 = c F_a − (c − 1) (ρ_a/ρ) F with ρ = ρ_a + ρ_b, F = F_a + F_b: the common velocity of the collision
/// carries a share of what the components drift against each other. With F_a = −ρ_a G ∇ρ_b / 3
///
///   μ_a = ln ρ_a + c G ρ_b + w ln (ρ_a + ρ_b),  w = c − 1
///
/// of each component is the same on both sides of an interface, and Σ ρ_a dμ_a = 3 c dp with p of `pressure_of`.
/// c = 1/(1 − 1/2τ) with the velocity shift and 1 with a source where the force is weak. Steep interfaces, in which the
/// square of the force counts, lower both, so they are measured: c on a flat interface, where w does not matter, and w
/// as that at which nothing flows through a curved one.
/// \par Units  lattice units
/// \par Source  moments of a step at rest, derived here
struct coexistence {
  double attraction;  ///< G > 0
  double factor;      ///< c
  double common;      ///< w
  double main;        ///< density of each component in its own phase where the interface is flat
};

/// What was measured on flat interfaces and bubbles of D3Q19, BGK, velocity shift, τ = 1.
/// \par Units     lattice units
/// \par Accuracy  factor 1e-4; common 0.05; surface tension 1 % between bubbles of R = 7 … 18
struct calibrated_pair {
  double attraction;       ///< G
  double main;             ///< density of each component in its own phase, flat interface
  double factor;           ///< c of `coexistence`, from the flat interface
  double common;           ///< w, from a meniscus in a throat
  double surface_tension;  ///< of a bubble of R = 18 nodes, mean main density as above
};

/// Densities on both sides of an interface: first the non-wetting component, then the wetting one.
struct reservoir_pair {
  std::array<double, 2> gas;
  std::array<double, 2> liquid;
};

/// The densities of a wall that prefers component 1 by `wettability`: 1 shows that component's own phase, 0 both
/// phases alike, −1 the phase of component 0. Which contact angle that makes is measured (calibration.hpp).
[[nodiscard]] constexpr std::array<double, 2> wall_of_wettability(double main, double dissolved,
                                                                  double wettability) noexcept {
  const double mean = (main + dissolved) / 2;
  const double half = wettability * (main - dissolved) / 2;
  return {mean - half, mean + half};
}

/// p = (ρ_a + ρ_b)/3 + G ρ_a ρ_b / 3.
[[nodiscard]] constexpr double pressure_of(const coexistence& c, const std::array<double, 2>& rho) noexcept {
  return (rho[0] + rho[1] + c.attraction * rho[0] * rho[1]) / 3;
}

/// The density of a component dissolved in the other's phase, where the interface is flat: ln(a/b) = c G (a − b).
/// \par Domain  c G a > 1; at the critical point 1 both densities are the same
[[nodiscard]] inline outcome<double, coexistence_status> dissolved_density(const coexistence& c) noexcept {
  const double strength = c.attraction * c.factor;
  if (!(strength > 0) || !(c.main > 0) || !std::isfinite(strength) || !std::isfinite(c.main)) {
    return {quiet_nan<double>, coexistence_status::invalid_input};
  }
  const double k = strength * c.main;
  if (!(k > 1)) {
    return {quiet_nan<double>, coexistence_status::no_separation};
  }
  // x = b/a solves x = exp(−k (1 − x)) below 1; from 0 on the convex ln x + k (1 − x) Newton rises to the root
  double x = std::exp(-k);
  for (int turn = 0; turn < 100; ++turn) {
    const double step = (std::log(x) + k * (1 - x)) / (1 / x - k);
    x -= step;
    if (std::abs(step) <= 1e-15 * x) {
      break;
    }
  }
  return {x * c.main, coexistence_status::ok};
}

namespace detail {

/// Whether a phase of given densities does not fall apart: dμ_a/dρ_a dμ_b/dρ_b exceeds the square of dμ_a/dρ_b.
[[nodiscard]] inline bool keeps_together(const coexistence& c, const std::array<double, 2>& rho) noexcept {
  const double w = c.common / (rho[0] + rho[1]);
  const double across = c.attraction * c.factor + w;
  return (1 / rho[0] + w) * (1 / rho[1] + w) > across * across;
}

}  // namespace detail

/// The densities of two reservoirs whose pressures differ by p_c: μ of each component is the same in both.
///
/// `gas_share` of p_c raises the gas above the pressure of the flat interface, the rest lowers the liquid below. With
/// one half the surface tension, which follows the densities, keeps its value to first order in p_c.
/// \par Units   lattice units
/// \par Domain  p_c of either sign, up to where a phase dissolves
/// \par Source  equal potentials as `coexistence` derives them
[[nodiscard]] inline outcome<reservoir_pair, coexistence_status> reservoirs(const coexistence& c, double capillary,
                                                                            double gas_share = 0.5) noexcept {
  constexpr double nan = quiet_nan<double>;
  const auto refused = [&](coexistence_status why) {
    return outcome<reservoir_pair, coexistence_status>{{{nan, nan}, {nan, nan}}, why};
  };
  const auto flat = dissolved_density(c);
  if (!flat.ok()) {
    return refused(flat.reason);
  }
  if (!std::isfinite(capillary) || !(gas_share >= 0 && gas_share <= 1)) {
    return refused(coexistence_status::invalid_input);
  }
  const double k = c.attraction * c.factor;
  const double rest = pressure_of(c, {c.main, flat.value});
  // unknowns: logarithms of gas (a, b) and liquid (a, b); p_c rises from 0 in steps that Newton follows
  std::array<double, 4> x{std::log(c.main), std::log(flat.value), std::log(flat.value), std::log(c.main)};
  if (!(std::abs(capillary) < 20 * rest)) {
    return refused(coexistence_status::dissolved);
  }
  const int steps = 1 + static_cast<int>(std::abs(capillary) / (0.02 * rest));
  for (int s = 1; s <= steps; ++s) {
    const double p = capillary * s / steps;
    double moved = 1;
    for (int turn = 0; turn < 30 && moved > 1e-14; ++turn) {
      std::array<double, 4> r{};
      for (std::size_t i = 0; i < 4; ++i) {
        r[i] = std::exp(x[i]);
      }
      const double g = c.attraction;
      const double w = c.common;
      const double gas = r[0] + r[1];
      const double liquid = r[2] + r[3];
      const double common = w * std::log(gas / liquid);
      // d(equation)/d(unknown), and the equation itself
      double a[4][5] = {{1 + w * r[0] / gas, (k + w / gas) * r[1], -1 - w * r[2] / liquid, -(k + w / liquid) * r[3],
                         x[0] + k * r[1] - x[2] - k * r[3] + common},
                        {(k + w / gas) * r[0], 1 + w * r[1] / gas, -(k + w / liquid) * r[2], -1 - w * r[3] / liquid,
                         x[1] + k * r[0] - x[3] - k * r[2] + common},
                        {r[0] * (1 + g * r[1]) / 3, r[1] * (1 + g * r[0]) / 3, 0, 0,
                         pressure_of(c, {r[0], r[1]}) - rest - gas_share * p},
                        {0, 0, r[2] * (1 + g * r[3]) / 3, r[3] * (1 + g * r[2]) / 3,
                         pressure_of(c, {r[2], r[3]}) - rest + (1 - gas_share) * p}};
      if (!tetrapore::detail::eliminate<4, 1, double>(a)) {
        return refused(coexistence_status::dissolved);
      }
      moved = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        x[i] -= a[i][4];
        moved = std::max(moved, std::abs(a[i][4]));
      }
      if (!(moved < 0.5)) {  // a leap to other phases
        return refused(coexistence_status::dissolved);
      }
    }
    const bool two_phases = detail::keeps_together(c, {std::exp(x[0]), std::exp(x[1])}) &&
                            detail::keeps_together(c, {std::exp(x[2]), std::exp(x[3])});
    if (!(moved <= 1e-10) || !two_phases || !(x[0] > x[1]) || !(x[3] > x[2])) {
      return refused(coexistence_status::dissolved);
    }
  }
  return {{{std::exp(x[0]), std::exp(x[1])}, {std::exp(x[2]), std::exp(x[3])}}, coexistence_status::ok};
}

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
