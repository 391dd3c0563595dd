// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/calibration.hpp"
#include "tetrapore/lbm/flat_interface.hpp"

/// \file
/// The pair of a mixture that no table knows, measured on the spot.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// A pair of repelling components as a flat interface shows it, or how the measurement ended.
/// \par Units     lattice units; `main` is the density of each component in its own phase
/// \par Domain    models of two components that relax with one τ
/// \par Accuracy  factor and tension of the flat interface: those of measure_flat_interface. A curved one has 1 % more
///                tension at τ = 1 and 0.7, 5 to 7 % at τ = 1.5 (table of measured mixtures); w is (c − 1)/2, which is
///                right at τ = 1: a hold shows whether something flows
/// \par Source    measure_flat_interface; its cost is about 0.2 s
template <class Model>
[[nodiscard]] outcome<calibrated_pair, hold_end> measure_pair(double attraction, double tau, double main = 1) {
  using plane = mixture<d2q9, typename Model::collision_type, typename Model::forcing_type, decltype(Model::potential),
                        Model::components>;
  const flat_interface f = measure_flat_interface<plane>({.attraction = attraction, .tau = tau, .main = main});
  return {{attraction, f.main, f.factor, (f.factor - 1) / 2, f.tension, f.tension, 0}, f.rest.end};
}

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
