// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/calibration.hpp"
#include "tetrapore/lbm/flat_interface.hpp"

#include <cmath>
#include <string>
#include <type_traits>

/// \file
/// Pairs as they are measured: of a mixture that no table knows on the spot, and whether one is what it claims.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

namespace detail {

/// The row of the table of measured mixtures for a pair of a model, at the main density of the row to 2 %.
template <class Model>
[[nodiscard]] outcome<calibrated_mixture, calibration_status> row_of(double attraction, double tau,
                                                                     double main) noexcept {
  constexpr bool in_table = std::is_same_v<typename Model::collision_type, bgk> &&
                            std::is_same_v<decltype(Model::potential), linear_potential>;
  auto row = calibrated(kind_of_forcing<typename Model::forcing_type>, tau, attraction);
  if (row.ok() && !(in_table && std::abs(main - row.value.main) <= 0.02 * row.value.main)) {
    row.reason = calibration_status::outside;
  }
  return row;
}

}  // namespace detail

/// A pair of repelling components as a flat interface shows it, with the tension of bubbles where the table of measured
/// mixtures knows it; or how the measurement ended. `check_pair` finds nothing wrong with it.
/// \par Units     lattice units; `main` is the density of each component in its own phase
/// \par Domain    models of two components that relax with one τ
/// \par Accuracy  factor and tension of the flat interface: those of measure_flat_interface. Bubbles of the mixtures in
///                the table have −1.4 to +1.6 % more tension than it at τ = 1 and 0.7, 6 to 8 % more at τ = 1.5: so
///                much may that of a pair off the table be wrong by. w is (c − 1)/2: measured at τ = 1, elsewhere an
///                assumption, so that a pair off τ = 1 is approximate: where w is wrong something flows through a
///                meniscus at rest, and a hold that shows another p_c than was set says so. Entry pressures of such
///                pairs have no stated discretisation
/// \par Source    measure_flat_interface; its cost is about 0.2 s
template <class Model>
[[nodiscard]] outcome<calibrated_pair, hold_end> measure_pair(double attraction, double tau, double main = 1) {
  using plane = mixture<d2q9, typename Model::collision_type, typename Model::forcing_type, decltype(Model::potential),
                        Model::components>;
  const flat_interface f = measure_flat_interface<plane>({.attraction = attraction, .tau = tau, .main = main});
  const auto known = detail::row_of<Model>(attraction, tau, f.main);
  const double tension = known.ok() ? surface_tension(known.value, f.main) : f.tension;
  return {{attraction, f.main, f.factor, (f.factor - 1) / 2, tension}, f.rest.end};
}

/// Throws parameter_error where factor or tension of a pair differ by 2 % from what was measured: in the table of
/// measured mixtures or, where it has none of this main density, on a flat interface, now.
template <class Model>
void check_pair(const calibrated_pair& pair, double tau) {
  double factor = 0;
  double tension = 0;
  if (const auto known = detail::row_of<Model>(pair.attraction, tau, pair.main); known.ok()) {
    factor = known.value.factor;
    tension = surface_tension(known.value, pair.main);
  } else {
    const auto found = measure_pair<Model>(pair.attraction, tau, pair.main);
    if (!found.ok()) {
      throw parameter_error("mixture",
                            "G = " + short_number(pair.attraction) + ", tau = " + short_number(tau) +
                                ", whose flat interface does not come to rest: " + describe(found.reason),
                            "two phases");
    }
    factor = found.value.factor;
    tension = found.value.surface_tension;
  }
  const auto differs = [](double a, double b) { return !(std::abs(a - b) <= 0.02 * std::abs(b)); };
  if (differs(pair.factor, factor) || differs(pair.surface_tension, tension)) {
    throw parameter_error(
        "mixture", "c = " + short_number(pair.factor) + ", surface tension = " + short_number(pair.surface_tension),
        short_number(factor) + ", " + short_number(tension) + " as measured");
  }
}

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
