// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/real.hpp"
#include "tetrapore/lbm/calibrated/mixtures.hpp"
#include "tetrapore/lbm/coexistence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

/// \file
/// What the table of measured mixtures says: densities, surface tension, wall densities of a contact angle.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// Whether the table covers a mixture.
enum class calibration_status : unsigned char {
  ok,
  unknown_scheme,  ///< refused: no rows of this forcing and τ
  outside          ///< refused: G lies outside the rows of this forcing and τ
};

[[nodiscard]] constexpr verdict verdict_of(calibration_status s) noexcept {
  return s == calibration_status::ok ? verdict::ok : verdict::refused;
}
[[nodiscard]] constexpr const char* describe(calibration_status s) noexcept {
  switch (s) {
    case calibration_status::ok: return "ok";
    case calibration_status::unknown_scheme: return "no mixture of this forcing scheme and tau was measured";
    case calibration_status::outside: return "no mixture of so weak or so strong a repulsion was measured";
  }
  return "not a calibration status";
}

namespace detail {

/// A row between two of the same forcing and τ, linear in G.
[[nodiscard]] constexpr calibrated_mixture between(const calibrated_mixture& a, const calibrated_mixture& b,
                                                   double attraction) noexcept {
  const double s = (attraction - a.attraction) / (b.attraction - a.attraction);
  const auto mix = [s](double x, double y) { return x + (y - x) * s; };
  calibrated_mixture m{a.forcing,
                       a.tau,
                       attraction,
                       mix(a.main, b.main),
                       mix(a.dissolved, b.dissolved),
                       mix(a.factor, b.factor),
                       mix(a.width, b.width),
                       mix(a.flat_tension, b.flat_tension),
                       mix(a.density_exponent, b.density_exponent),
                       mix(a.bubble_tension, b.bubble_tension),
                       mix(a.curvature, b.curvature),
                       mix(a.spurious, b.spurious),
                       {}};
  for (std::size_t k = 0; k < m.wettability.size(); ++k) {
    m.wettability[k] = mix(a.wettability[k], b.wettability[k]);
  }
  return m;
}

}  // namespace detail

/// The measured mixture of a forcing scheme, τ and G; between rows of the same scheme and τ linear in G.
/// \par Units     lattice units
/// \par Accuracy  flat interfaces: the digits of the table. Between rows 0.5 % of σ at τ = 1
[[nodiscard]] constexpr outcome<calibrated_mixture, calibration_status> calibrated(forcing_kind forcing, double tau,
                                                                                   double attraction) noexcept {
  const auto near = [](double a, double b) { return (a > b ? a - b : b - a) <= 1e-9; };
  const calibrated_mixture* below = nullptr;
  const calibrated_mixture* above = nullptr;
  for (const calibrated_mixture& m : calibrated_mixtures) {
    if (m.forcing != forcing || !near(m.tau, tau)) {
      continue;
    }
    if (near(m.attraction, attraction)) {
      return {m, calibration_status::ok};
    }
    if (m.attraction < attraction && (below == nullptr || below->attraction < m.attraction)) {
      below = &m;
    }
    if (m.attraction > attraction && (above == nullptr || above->attraction > m.attraction)) {
      above = &m;
    }
  }
  if (below != nullptr && above != nullptr) {
    return {detail::between(*below, *above, attraction), calibration_status::ok};
  }
  return {{}, below == nullptr && above == nullptr ? calibration_status::unknown_scheme : calibration_status::outside};
}

/// The surface tension of a curved interface whose phases have a mean main density: half the sum of the gas's and the
/// liquid's own. Radius in nodes of the surface on which both components weigh the same; infinite: flat.
/// \par Units     lattice units
/// \par Accuracy  0.3 % of bubbles of 8 to 24 nodes at G = 1.8, τ = 1, velocity shift; 0.75 % more than a flat
///                interface across an axis there, by the anisotropy of the lattice
[[nodiscard]] inline double surface_tension(const calibrated_mixture& m, double mean_main,
                                            double radius = infinity<double>) noexcept {
  return m.bubble_tension * std::pow(mean_main / m.main, m.density_exponent) * (1 + m.curvature / radius);
}

/// The wettability of `wall_of_wettability` that makes a contact angle, linear in its cosine between those measured.
/// At 0 it is 1, the liquid itself, so that a film covers every wall.
/// \par Units     θ [rad]
/// \par Domain    0 ≤ θ ≤ π
/// \par Accuracy  between plates at twice the distance of the calibration 1.1° below 40° and 0.5° from there on
[[nodiscard]] inline double wettability(const calibrated_mixture& m, double contact_angle) {
  if (!(contact_angle >= 0 && contact_angle <= pi<double>)) {
    throw parameter_error("contact angle", short_number(contact_angle) + " rad", "0 to pi");
  }
  if (contact_angle > pi<double> / 2) {
    return -wettability(m, pi<double> - contact_angle);
  }
  if (contact_angle == 0) {
    return 1;
  }
  const double cosine = std::cos(contact_angle);
  double lower = 0;  // at a right angle
  double x = 0;
  for (std::size_t k = calibrated_angles.size(); k-- > 0;) {
    const double upper = std::cos(calibrated_angles[k] * pi<double> / 180);
    if (cosine <= upper) {
      return x + (m.wettability[k] - x) * (cosine - lower) / (upper - lower);
    }
    lower = upper;
    x = m.wettability[k];
  }
  return x;
}

/// The densities that a wall shows where the contact angle is θ; at 0 those of the liquid itself, so that a film covers
/// the wall. Component 1 is the liquid. Throws parameter_error where the table does not know the pair with this forcing
/// and τ, or knows it with a c that differs by 1 %: angles above 0 are those of the table's rows alone.
/// \par Units     lattice units; θ [rad], 0 to π
[[nodiscard]] inline std::array<double, 2> wall_densities(const coexistence& pair, forcing_kind forcing, double tau,
                                                          double contact_angle) {
  const auto dissolved = dissolved_density(pair);
  if (!dissolved.ok()) {
    throw parameter_error("mixture", describe(dissolved.reason), "two phases");
  }
  if (contact_angle == 0) {
    return wall_of_wettability(pair.main, dissolved.value, 1);
  }
  const auto row = calibrated(forcing, tau, pair.attraction);
  if (!row.ok() || !(std::abs(row.value.factor - pair.factor) < 0.01 * pair.factor)) {
    throw parameter_error(
        "mixture",
        "G = " + short_number(pair.attraction) + ", c = " + short_number(pair.factor) + ", tau = " + short_number(tau),
        "one of the table of measured mixtures, whose contact angles are known");
  }
  return wall_of_wettability(pair.main, dissolved.value, wettability(row.value, contact_angle));
}

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
