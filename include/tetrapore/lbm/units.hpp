// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/required.hpp"
#include "tetrapore/lbm/calibration.hpp"

/// \file
/// Lattice units to SI and back, for a measured mixture and given fluids; choices that a lattice cannot carry are
/// refused with a reason.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// Two fluids between grains. \par Units  SI
struct physical_fluids {
  required<double> surface_tension;  ///< [N/m]
  required<double> viscosity;        ///< of the one that flows [Pa s]
  required<double> density;          ///< of it [kg/m³]
  double contact_angle = 0;          ///< [rad]
};

/// What is to be computed. \par Units  SI
struct lattice_choice {
  required<double> node;             ///< distance of nodes [m]
  required<double> smallest_radius;  ///< of a throat's inscribed circle or a meniscus, whichever is smaller [m]
  double velocity = 0;               ///< the highest that matters [m/s]; 0: fluids at rest
};

/// Why scales are refused.
enum class scale_status : unsigned char {
  ok,
  invalid_input,         ///< refused: a number that is not above 0, or NaN, of the mixture's too
  nearly_inviscid,       ///< refused: τ below 0.51, where nothing damps
  over_relaxed,          ///< refused: τ above 2, where walls move with the viscosity
  unresolved_interface,  ///< refused: the radius is less than the interface is wide
  unresolved_film,       ///< refused: films of two nodes on both walls close the opening
  dissolving,            ///< refused: at so high a capillary pressure a phase falls apart
  drowned_in_spurious,   ///< refused: the velocity is below that of spurious currents
  too_fast,              ///< refused: the Mach number is above 0.1
  not_quasi_static       ///< refused: the capillary number is above 0.01
};

[[nodiscard]] constexpr verdict verdict_of(scale_status s) noexcept {
  return s == scale_status::ok ? verdict::ok : verdict::refused;
}
[[nodiscard]] constexpr const char* describe(scale_status s) noexcept {
  switch (s) {
    case scale_status::ok: return "ok";
    case scale_status::invalid_input: return "a length, velocity or property of fluids or mixture outside the domain";
    case scale_status::nearly_inviscid: return "tau is below 0.51: nothing damps";
    case scale_status::over_relaxed: return "tau is above 2: walls move with the viscosity";
    case scale_status::unresolved_interface: return "the smallest radius is less than the interface is wide";
    case scale_status::unresolved_film: return "wetting films of two nodes on both walls close the opening";
    case scale_status::dissolving: return "at the capillary pressure of the smallest radius a phase falls apart";
    case scale_status::drowned_in_spurious: return "the velocity is below that of spurious currents";
    case scale_status::too_fast: return "the Mach number is above 0.1";
    case scale_status::not_quasi_static: return "the capillary number is above 0.01";
  }
  return "not a status of scales";
}

/// What one lattice unit is. \par Units  SI
///
/// Length and surface tension fix pressures and forces, all that fluids at rest ask for. The time follows from the
/// viscosity, so that capillary numbers are those of the fluids; the density is then what it is, `inertia` times the
/// true one, which does not matter while inertia does not: Reynolds numbers are `inertia` times the true ones.
struct lattice_scales {
  double length;              ///< [m] of a node
  double time;                ///< [s] of a step
  double tension;             ///< [N/m] of a unit of surface tension
  double pressure;            ///< [Pa]
  double force;               ///< [N]
  double velocity;            ///< [m/s]
  double inertia;             ///< density that the lattice's fluid has, over the true one
  double surface_tension;     ///< σ of the mixture, lattice units
  double capillary_pressure;  ///< 2σ over the smallest radius, lattice units
};

/// Scales of a mixture on a lattice, or why not.
/// \par Source  dimensional analysis; limits as stated by `scale_status`
[[nodiscard]] inline outcome<lattice_scales, scale_status> scales(const calibrated_mixture& m,
                                                                  const physical_fluids& fluids,
                                                                  const lattice_choice& choice) noexcept {
  constexpr double nan = quiet_nan<double>;
  const auto refused = [](scale_status why) {
    return outcome<lattice_scales, scale_status>{{nan, nan, nan, nan, nan, nan, nan, nan, nan}, why};
  };
  const auto positive = [](double x) { return x > 0 && std::isfinite(x); };
  const double sigma = fluids.surface_tension;
  const double mu = fluids.viscosity;
  const double rho = fluids.density;
  const double dx = choice.node;
  const double smallest = choice.smallest_radius;
  if (!positive(sigma) || !positive(mu) || !positive(rho) || !positive(dx) || !positive(smallest) || !positive(m.tau) ||
      !positive(m.attraction) || !positive(m.main) || !positive(m.dissolved) || !positive(m.factor) ||
      !positive(m.width) || !positive(m.flat_tension) || !positive(m.bubble_tension) ||
      !std::isfinite(m.density_exponent) || !std::isfinite(m.curvature) || !(m.spurious >= 0) ||
      !(fluids.contact_angle >= 0 && fluids.contact_angle <= pi<double>) ||
      !(choice.velocity >= 0 && std::isfinite(choice.velocity))) {
    return refused(scale_status::invalid_input);
  }
  if (!(m.tau >= 0.51)) {
    return refused(scale_status::nearly_inviscid);
  }
  if (!(m.tau <= 2)) {
    return refused(scale_status::over_relaxed);
  }
  const double nodes = smallest / dx;
  if (fluids.contact_angle == 0 && !(nodes >= 2)) {
    return refused(scale_status::unresolved_film);
  }
  if (!(nodes >= m.width)) {
    return refused(scale_status::unresolved_interface);
  }
  const double lattice_sigma = surface_tension(m, m.main);
  const double capillary = 2 * lattice_sigma / nodes;
  if (!reservoirs({m.attraction, m.factor, (m.factor - 1) / 2, m.main}, capillary).ok()) {
    return refused(scale_status::dissolving);
  }
  lattice_scales s{};
  const double lattice_rho = m.main + m.dissolved;
  const double lattice_mu = lattice_rho * (m.tau - 0.5) / 3;
  s.length = dx;
  s.tension = sigma / lattice_sigma;
  s.pressure = s.tension / dx;
  s.force = s.tension * dx;
  s.velocity = s.tension * lattice_mu / mu;  // σ/μ of both
  s.time = dx / s.velocity;
  s.inertia = lattice_rho * s.pressure / (s.velocity * s.velocity) / rho;
  s.surface_tension = lattice_sigma;
  s.capillary_pressure = capillary;
  if (choice.velocity > 0) {
    const double u = choice.velocity / s.velocity;
    if (u * std::sqrt(3.0) > 0.1) {
      return refused(scale_status::too_fast);
    }
    if (mu * choice.velocity / sigma > 0.01) {
      return refused(scale_status::not_quasi_static);
    }
    if (u < m.spurious) {
      return refused(scale_status::drowned_in_spurious);
    }
  }
  return {s, scale_status::ok};
}

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
