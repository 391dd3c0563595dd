// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "collision.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

/// \file
/// Restitution against the Stokes number, by simulation and by theory.

namespace support {

/// Hard grains with asperities as high as the roughness: the film takes the speed (6πμa*²/m) ln(film/roughness) on the
/// way in and again on the way out, and the bridge takes from the energy what lifts it from the edge of the film to
/// rupture. Where the film holds no tension on the way out (Davis, Serayssol & Hinch 1986, J. Fluid Mech. 163, 479;
/// Barnocky & Davis 1988, Phys. Fluids 31, 1324) only the first half is taken.
struct restitution_theory {
  double half = 0;  ///< ln(film/roughness); 0 without a film
  double work = 0;  ///< of the bridge, over the kinetic energy of the approach

  [[nodiscard]] double film(double stokes) const { return std::max(0.0, 1 - 2 * half / stokes); }
  [[nodiscard]] double inward(double stokes) const { return std::max(0.0, 1 - half / stokes); }
  [[nodiscard]] double wet(double stokes) const {
    const double left = film(stokes) * film(stokes) - work;
    return left > 0 ? std::sqrt(left) : 0;
  }
  [[nodiscard]] double critical_film() const { return 2 * half; }
  [[nodiscard]] double critical_wet() const {
    return work < 1 ? 2 * half / (1 - std::sqrt(work)) : tp::infinity<double>;
  }
};

/// What the theory needs to know: a head-on meeting.
[[nodiscard]] inline restitution_theory theory_of(const wet_material& m, const encounter& e) {
  restitution_theory theory;
  theory.half = m.viscosity > 0 ? std::log(m.film / m.roughness) : 0;
  if (m.bridge_volume > 0) {
    const tp::young_laplace<> law{
        .surface_tension = m.surface_tension, .contact_angle1 = m.contact_angle, .contact_angle2 = m.contact_angle};
    const tp::given_volume<double> volume{m.bridge_volume};
    const tp::edge<double> formed{e.radius1, e.radius2, m.creation_gap, {0, 0, 1}};
    const auto first = law.bridge(formed, volume);
    const auto limit = law.rupture_gap(formed, volume);
    if (first.ok() && limit.ok()) {
      tp::edge<double> widest = formed;
      widest.gap = limit.value.gap;
      const double speed = e.speed * std::cos(e.obliquity);
      theory.work = (law.energy(widest, limit.value.last) - law.energy(formed, first.value)) /
                    (0.5 * reduced_mass(m, e) * speed * speed);
    }
  }
  return theory;
}

struct restitution_row {
  double stokes;
  double film;
  double wet;
  double film_theory;
  double wet_theory;
  double inward_theory;
};

struct restitution_sweep {
  restitution_theory theory;
  std::vector<restitution_row> rows;
  double critical_film = 0;  ///< Stokes number below which grains stick, by bisection
  double critical_wet = 0;
  double largest_defect = 0;  ///< of the energy
};

/// Lets the pair meet in liquids of other viscosities: at so many Stokes numbers up to the highest, and at the critical
/// ones.
[[nodiscard]] inline restitution_sweep sweep(const wet_material& m, const encounter& e, std::size_t points,
                                             double highest) {
  restitution_sweep s;
  s.theory = theory_of(m, e);
  const auto meet = [&](double stokes, bool bridge) {
    wet_material liquid = m;
    liquid.viscosity = viscosity_for(m, e, stokes);
    liquid.bridge_volume = bridge ? m.bridge_volume : 0;
    const collision c = collide(liquid, e);
    s.largest_defect = std::max(s.largest_defect, std::abs(c.energy_defect));
    return c;
  };
  const auto critical = [&](bool bridge) {
    double sticks = 0.1;
    double rebounds = 1e4;
    if (meet(rebounds, bridge).stuck) {
      return tp::infinity<double>;
    }
    for (int k = 0; k < 14; ++k) {  // to 1e-3 of it
      const double middle = std::sqrt(sticks * rebounds);
      (meet(middle, bridge).stuck ? sticks : rebounds) = middle;
    }
    return std::sqrt(sticks * rebounds);
  };
  s.critical_film = critical(false);
  s.critical_wet = critical(true);
  std::vector<double> numbers;
  for (std::size_t k = 1; k <= points; ++k) {  // closer together where they are small
    const double part = static_cast<double>(k) / static_cast<double>(points);
    numbers.push_back(highest * part * part);
  }
  for (const double corner : {s.critical_film, s.critical_wet, s.theory.critical_film(), s.theory.critical_wet()}) {
    if (corner < highest) {
      numbers.push_back(corner);
    }
  }
  std::sort(numbers.begin(), numbers.end());
  for (const double stokes : numbers) {
    s.rows.push_back({stokes, meet(stokes, false).restitution, meet(stokes, true).restitution, s.theory.film(stokes),
                      s.theory.wet(stokes), s.theory.inward(stokes)});
  }
  return s;
}

}  // namespace support
