// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/outcome.hpp"

#include <concepts>
#include <cstdint>

/// \file
/// What an experiment says, in one form for all of them.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// \par Units  those of the experiment's result
struct measurement {
  double value;  ///< what the experiment is for; NaN where it ended without
  double lower;  ///< what it lies between on this lattice: the bracket of a search, or as much as it still changed
  double upper;
  double discretisation;  ///< relative error of a lattice of these nodes; NaN where none was measured
  std::uint64_t updates;  ///< of a fluid node, all components as one
  verdict found;
  const char* why;  ///< it stopped
};

/// Results of experiments.
/// Syntax: `measured(result)` gives a measurement.
/// Models: entry_result, flat_interface, laplace_result, contact_result, drop_result, pendular_result, tube_result,
/// measured permeabilities.
template <class R>
concept experiment_result = requires(const R r) {
  { measured(r) } -> std::same_as<measurement>;
};

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
