// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/contracts.hpp"

#include <array>
#include <cstdint>

/// \file
/// What is measured of two components that repel each other: a row of the table that ships.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// How forces enter: a calibration holds for one scheme.
enum class forcing_kind : std::uint8_t { velocity_shift, guo };

/// The kind of a forcing scheme.
template <class Forcing>
inline constexpr forcing_kind kind_of_forcing =
    Forcing::carries_source ? forcing_kind::guo : forcing_kind::velocity_shift;

/// Contact angles [degrees] of which a row tells the wettability.
inline constexpr std::array<double, 9> calibrated_angles{0, 10, 20, 30, 40, 50, 60, 70, 80};

/// Two components of ψ = ρ with the same τ, BGK, on D3Q19 or D2Q9, measured by `calibrate`.
/// \par Units  lattice units
struct calibrated_mixture {
  forcing_kind forcing;
  double tau;
  double attraction;                  ///< G
  double main;                        ///< density of each component in its own phase
  double dissolved;                   ///< and in the other's, where the interface is flat
  double factor;                      ///< c: ln(main/dissolved) = c G (main − dissolved)
  double width;                       ///< of a flat interface, from 10 to 90 % [nodes]
  double flat_tension;                ///< σ of a flat interface across an axis
  double density_exponent;            ///< d ln σ / d ln main
  double bubble_tension;              ///< σ of bubbles in the limit of large R, the mean main density kept
  double curvature;                   ///< σ(R) = bubble_tension × (1 + curvature / R), R in nodes
  double spurious;                    ///< highest velocity beside a bubble of 14 nodes
  std::array<double, 9> wettability;  ///< that gives `calibrated_angles`; 90° takes 0, what lies beyond the opposite
};

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
