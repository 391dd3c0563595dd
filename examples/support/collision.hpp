// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "wet_grains.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

/// \file
/// Two wet grains that meet: approach, contact, and rebound or not.

namespace support {

/// Two grains and how they meet.
struct encounter {
  double radius1 = 1e-3;  ///< [m]
  double radius2 = 1e-3;
  double speed = 0.2;     ///< of approach, along the line of approach [m/s]
  double obliquity = 0;   ///< of that line to the line of centres where they meet [rad]
  double steps = 500;     ///< in half a period of a contact
  double liquid = 5e-12;  ///< on each grain [m³]
};

struct instant {
  double time;
  double gap;
  double film;   ///< thickness; NaN without
  double force;  ///< by which the pair is pulled together [N]
  double rate;   ///< of the gap
  energies energy;
  double dissipated;
};

/// How a meeting went.
struct collision {
  double restitution = 0;
  double stokes = 0;    ///< reduced mass × normal speed / (6πμ a*²); infinite without a film
  double duration = 0;  ///< from the first touch of the films to the last, or to when it is clear that there is none
  bool stuck = false;
  ledger books;
  std::size_t bridges = 0;
  energies before;
  energies after;
  double energy_defect = 0;            ///< what the books do not explain, over the energy before
  double momentum_defect = 0;          ///< change of the whole momentum, over the momentum of one grain
  double angular_momentum_defect = 0;  ///< of the whole angular momentum, over momentum × sum of radii
  double liquid_defect = 0;            ///< of all liquid, over what there was
  std::vector<instant> trace;          ///< at most 4000 rows
};

[[nodiscard]] inline double reduced(double a, double b) { return a * b / (a + b); }

/// 6πμ a*²: what the film resists by, times gap over rate.
[[nodiscard]] inline double film_drag(const wet_material& m, const encounter& e) {
  const double star = reduced(e.radius1, e.radius2);
  return 6 * tp::pi<double> * m.viscosity * star * star;
}
[[nodiscard]] inline double reduced_mass(const wet_material& m, const encounter& e) {
  return reduced(m.mass(e.radius1), m.mass(e.radius2));
}
[[nodiscard]] inline double stokes_number(const wet_material& m, const encounter& e) {
  return reduced_mass(m, e) * e.speed * std::cos(e.obliquity) / film_drag(m, e);
}
[[nodiscard]] inline double viscosity_for(const wet_material& m, const encounter& e, double stokes) {
  return m.viscosity * stokes_number(m, e) / stokes;
}

/// The gap at which two grains begin to act on each other.
[[nodiscard]] inline double reach_of(const wet_material& m) {
  return std::max(m.viscosity > 0 ? m.film : 0, m.bridge_volume > 0 ? m.creation_gap : 0);
}

/// Lets two grains meet. The grains start where their films do, in the frame of their common centre of mass.
[[nodiscard]] inline collision collide(const wet_material& m, const encounter& e, bool with_trace = false) {
  const double far = m.viscosity > 0 ? m.film : 0;
  const double start = reach_of(m);
  const double mass = reduced_mass(m, e);
  const double dt = m.contact_time(mass) / e.steps;
  const vec normal{0, 0, 1};
  const vec approach = normal * std::cos(e.obliquity) + vec{std::sin(e.obliquity), 0, 0};
  wet_grains pair({{-normal * e.radius1, e.radius1}, {normal * (e.radius2 + start), e.radius2}}, tp::unbounded(), m, {},
                  e.liquid);
  pair.velocities[0] = approach * (e.speed * mass / pair.masses[0]);
  pair.velocities[1] = -approach * (e.speed * mass / pair.masses[1]);

  collision result;
  result.stokes = stokes_number(m, e);
  result.before = pair.energy();
  const auto momenta = pair.momenta();
  const double liquid = pair.liquid();
  const auto rate = [&] {
    const vec apart = pair.grains[1].centre - pair.grains[0].centre;
    return dot(pair.velocities[1] - pair.velocities[0], apart) / norm(apart);
  };
  const double inward = -rate();
  const double patience = 100 * (start / inward + m.contact_time(mass));
  double time = 0;
  double barrier = tp::quiet_nan<double>;  // energy of the bridge where it lets go
  bool rebounds = false;
  std::size_t stride = 1;
  while (time < patience) {
    pair.step(dt);
    time += dt;
    const wet_grains::pair_memory& now = pair.pairs().front();
    const double opening = rate();
    const energies energy = pair.energy();
    if (with_trace && pair.books().steps % stride == 0) {
      const double none = tp::quiet_nan<double>;
      result.trace.push_back({time, now.shape.gap, now.near && far > 0 ? now.wet.thickness : none,
                              now.pull + (now.presence.present ? now.last.force : 0), opening, energy,
                              pair.books().dissipated()});
      if (result.trace.size() == 4000) {  // every second row goes, and from here on every second one is taken
        std::size_t kept = 0;
        for (std::size_t k = 1; k < result.trace.size(); k += 2) {
          result.trace[kept++] = result.trace[k];
        }
        result.trace.resize(kept);
        stride *= 2;
      }
    }
    const bool bound = now.presence.present;
    rebounds = rebounds || opening > 0;
    if (!bound && !now.near && now.shape.gap > start && opening > 0) {
      break;  // nothing acts any more
    }
    // Everything but the bridge only takes energy: what is left must lift the pair to where the bridge lets go.
    if (bound && !(barrier == barrier)) {
      const auto limit = pair.capillarity().rupture_gap(now.shape, tp::given_volume<double>{now.volume});
      tp::edge<double> widest = now.shape;
      widest.gap = limit.value.gap;
      barrier = pair.capillarity().energy(widest, limit.value.last) - now.formed_at;
    }
    const double left = energy.kinetic + energy.elastic;
    const bool trapped = bound && rebounds && opening < 0 && left + energy.capillary < barrier;
    if (trapped || left < 1e-8 * result.before.kinetic) {
      result.stuck = true;
      break;
    }
  }
  const auto& last = pair.pairs().front();
  result.stuck = result.stuck || last.presence.present || last.near;
  result.restitution = result.stuck ? 0 : rate() / inward;
  result.duration = time;
  result.books = pair.books();
  result.bridges = pair.bridges();
  result.after = pair.energy();
  result.energy_defect = (result.before.sum() - result.after.sum() - result.books.dissipated()) / result.before.kinetic;
  const auto after = pair.momenta();
  const double scale = mass * e.speed;
  result.momentum_defect = norm(after[0] - momenta[0]) / scale;
  result.angular_momentum_defect = norm(after[1] - momenta[1]) / (scale * (e.radius1 + e.radius2));
  result.liquid_defect = liquid > 0 ? std::abs(pair.liquid() - liquid) / liquid : 0;
  return result;
}

}  // namespace support
