// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/calibrated/mixture.hpp"
#include "tetrapore/lbm/contact_angle.hpp"

/// \file
/// The measurement of a mixture, row by row of the table that ships (calibrated/mixtures.hpp).

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// A row, and why the measurement ended: `stable` where all of it stands.
struct calibration_run {
  calibrated_mixture mixture{};
  hold_end end = hold_end::stable;
  std::uint64_t updates = 0;
};

/// The flat interface of a mixture: densities, tension and how it follows the density.
template <class Forcing>
[[nodiscard]] calibration_run calibrate_flat(double attraction, double tau, double main) {
  using plane = mixture<d2q9, bgk, Forcing>;
  calibration_run r;
  const flat_interface flat = measure_flat_interface<plane>({.attraction = attraction, .tau = tau, .main = main});
  r.updates = flat.rest.updates;
  r.end = flat.rest.end;
  if (r.end != hold_end::stable) {
    return r;
  }
  const double more = 1.02 * main;
  const flat_interface denser = measure_flat_interface<plane>({.attraction = attraction, .tau = tau, .main = more});
  r.updates += denser.rest.updates;
  r.end = denser.rest.end;
  r.mixture = {kind_of_forcing<Forcing>,
               tau,
               attraction,
               flat.main,
               flat.dissolved,
               flat.factor,
               flat.width,
               flat.tension,
               std::log(denser.tension / flat.tension) / std::log(denser.main / flat.main),
               0,
               0,
               0,
               {}};
  return r;
}

/// Bubbles of 8 and 14 nodes, larger where the interface is wide; the mean main density is that of the row.
template <class Forcing>
void calibrate_bubbles(calibration_run& r) {
  calibrated_mixture& m = r.mixture;
  std::array<laplace_result, 2> b;
  for (std::size_t k = 0; k < 2 && r.end == hold_end::stable; ++k) {
    const double radius = std::array{8.0, 14.0}[k] * std::max(1.0, m.width / 3.3);
    b[k] = laplace<mixture<d3q19, bgk, Forcing>>({.attraction = m.attraction,
                                                  .tau = m.tau,
                                                  .radius = radius,
                                                  .half_box = static_cast<int>(1.5 * radius) + 6,
                                                  .main = m.main,
                                                  .tension = m.flat_tension});
    r.updates += b[k].rest.updates;
    r.end = b[k].rest.end;
  }
  if (r.end == hold_end::stable) {
    const double slope = (b[0].tension - b[1].tension) / (1 / b[0].radius - 1 / b[1].radius);
    m.bubble_tension = b[1].tension - slope / b[1].radius;
    m.curvature = slope / m.bubble_tension;
    m.spurious = b[1].spurious;
  }
}

/// The cosine that a wettability makes between plates, above 1 where a film covers them.
template <class Forcing>
[[nodiscard]] contact_result angle_of_wettability(const calibrated_mixture& m, double wettability, double expected,
                                                  int half_gap = 24, double more = 0) {
  return contact_angle<mixture<d2q9, bgk, Forcing>>({.attraction = m.attraction,
                                                     .tau = m.tau,
                                                     .main = m.main,
                                                     .more = more,
                                                     .tension = m.flat_tension,
                                                     .factor = m.factor,
                                                     .wettability = wettability,
                                                     .expected = expected,
                                                     .half_gap = half_gap});
}

/// The wettabilities of all calibrated angles, from 80° down: each is guessed from the one before and measured until
/// the cosine is within 0.01 of what is asked for; the rest is interpolated.
template <class Forcing>
void calibrate_angles(calibration_run& r) {
  double slope = 1.3;  // of the cosine
  double last = 0;
  double last_cosine = 0;
  double more = 0;
  for (std::size_t k = calibrated_angles.size(); k-- > 0 && r.end == hold_end::stable;) {
    const double angle = calibrated_angles[k] * pi<double> / 180;
    const double asked = std::cos(angle);
    double x = last + (asked - last_cosine) / slope;
    for (int turn = 0; turn < 4; ++turn) {
      const contact_result c = angle_of_wettability<Forcing>(r.mixture, x, angle, 24, more);
      more = c.more;
      r.updates += c.rest.updates;
      r.end = c.rest.end;
      if (r.end != hold_end::stable) {
        break;
      }
      slope = std::clamp((c.cosine - last_cosine) / (x - last), 0.5, 3.0);
      const double next = x + (asked - c.cosine) / slope;
      const bool close = std::abs(c.cosine - asked) < 0.01;
      if (close) {
        r.mixture.wettability[k] = next;
        last = x;
        last_cosine = c.cosine;
        break;
      }
      x = next;
      r.end = turn == 3 ? hold_end::step_limit : r.end;
    }
  }
}

/// Small angles feel the plates' distance most: 10° is set right in a gap twice as wide.
template <class Forcing>
void refine_small_angle(calibration_run& r) {
  std::array<double, 9>& x = r.mixture.wettability;
  const double angle = calibrated_angles[1] * pi<double> / 180;
  const double slope = (std::cos(angle) - std::cos(calibrated_angles[2] * pi<double> / 180)) / (x[1] - x[2]);
  const contact_result c = angle_of_wettability<Forcing>(r.mixture, x[1], angle, 48);
  r.updates += c.rest.updates;
  r.end = c.rest.end;
  x[1] = std::min(x[1] + (std::cos(angle) - c.cosine) / slope, x[0]);
}

/// All of a row.
template <class Forcing>
[[nodiscard]] calibration_run calibrate(double attraction, double tau, double main) {
  calibration_run r = calibrate_flat<Forcing>(attraction, tau, main);
  if (r.end == hold_end::stable) {
    calibrate_bubbles<Forcing>(r);
  }
  if (r.end == hold_end::stable) {
    calibrate_angles<Forcing>(r);
  }
  if (r.end == hold_end::stable) {
    refine_small_angle<Forcing>(r);
  }
  return r;
}

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
