// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/contracts.hpp"

/// \file
/// The choice of how a simulation keeps its nodes.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// How a simulation keeps its nodes.
enum class storage {
  in_place,      ///< populations once: even steps turn them round at their node, odd ones exchange them with neighbours
  two_lattices,  ///< populations twice: from one into the other. The plain reference
  moments        ///< density and momentum alone, where a collision leaves nothing else (tetrapore/lbm/moments.hpp)
};

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
