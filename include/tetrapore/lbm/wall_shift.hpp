// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/contracts.hpp"

#include <cmath>

/// \file
/// How far inside its nodes a wall acts on a meniscus: what plates show, and by how much grains and tubes have to be
/// retracted.
///
/// Between plates of half distance h at rest p_c = σ cos θ / (h − δ). Two distances tell θ and δ, at one main density.
/// δ comes of what a wall does to the fluids beside it; where θ = 0, of a film, the thicker the less p_c presses on it.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// δ of a wall along an axis where θ > 0. \par Units  nodes
/// \par Accuracy  0.05 between plates at θ = 20, 40 and 60°, h = 13 to 30 (60°: 0.7)
inline constexpr double axis_wall_shift = 0.5;

/// δ of an inclined wall, steps of nodes that have its volume, where θ > 0. \par Units  nodes
/// \par Accuracy  0.05 between plates with slopes of 1 and 1/2 at θ = 40 and 60°, 0.85 at 20°; h = 8.5 to 13. The angle
///                is that of a wall along an axis: within 0.6° at 40°, 1.1° at 60° and 1.6° at 20°
inline constexpr double wall_shift = 0.7;

/// δ where θ = 0, of a film on which p presses: what holds a film falls with its thickness over 0.475 nodes.
/// \par Units     σ/p and result [nodes]
/// \par Domain    G = 1.8, τ = 1, velocity shift, main density 1; σ/p from 3
/// \par Accuracy  0.02 between plates along an axis, σ/p = 4.8 to 28; 0.08 where they are inclined (7 to 11)
[[nodiscard]] inline double film_shift(double radius) noexcept { return 0.49 + 0.475 * std::log(radius); }

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
