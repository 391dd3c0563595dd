// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dem.hpp"

#include "tetrapore/law/conductance/hydraulic_radius.hpp"
#include "tetrapore/one_phase/coupling.hpp"
#include "tetrapore/packing/random_packing.hpp"
#include "tetrapore/solver/ldlt.hpp"
#include "tetrapore/tessellation/tessellation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

/// \file
/// An oedometer test on a saturated column of grains, and Terzaghi's theory of it.

namespace support {

/// One-dimensional consolidation of a layer that drains at its top. T = c_v t / H².
/// \par Source  Terzaghi & Fröhlich, Theorie der Setzung von Tonschichten (1936)
namespace terzaghi {

/// Calls f(M, exp(−M² T)) for M = π (2m + 1)/2, until the terms vanish.
template <class F>
void for_terms(double time, const F& f) {
  for (int m = 0; m < 20000; ++m) {
    const double frequency = std::numbers::pi * (2 * m + 1) / 2;
    const double decay = std::exp(-frequency * frequency * time);
    f(frequency, decay);
    if (decay < 1e-16) {
      return;
    }
  }
}

/// Settlement over the final one.
[[nodiscard]] inline double settlement(double time) {
  double left = 0;
  if (time > 0) {
    for_terms(time, [&](double m, double decay) { left += 2 / (m * m) * decay; });
  }
  return time > 0 ? 1 - left : 0;
}

/// Pressure over the load at a depth, counted from the drained top in heights of the layer.
[[nodiscard]] inline double pressure(double time, double depth) {
  double p = 0;
  for_terms(time, [&](double m, double decay) { p += 2 / m * std::sin(m * depth) * decay; });
  return p;
}

}  // namespace terzaghi

struct oedometer_options {
  std::size_t grains = 800;
  double radius = 1e-3;    ///< mean [m]
  double spread = 0.15;    ///< radii lie within (1 ± spread) × radius
  double slenderness = 5;  ///< height over width, before the first load
  double stress = 2e6;     ///< before the step [Pa]
  double step = 0.01;      ///< of the load, over the stress before
  double slowness = 50;    ///< time of consolidation H²/c_v over that of a wave H/c; chooses the viscosity
  double end = 1.5;        ///< T at which the test ends; from 0.05 on there is a profile
  double time_step = 1;    ///< over that of the contacts
  std::size_t refresh_every = 200;
  double rebuild_strain = 0.01;
  std::size_t rebuild_every = 0;
  std::uint64_t seed = 1;
  dem_material material{};
};

/// A random packing in a tall box, loose.
[[nodiscard]] inline tp::packing loose_column(const oedometer_options& o) {
  std::vector<double> radii(o.grains);
  tp::random_sequence random(o.seed);
  for (double& r : radii) {
    r = o.radius * (1 + o.spread * (2 * random.uniform() - 1));
  }
  return tp::random_packing(radii, {.solid_fraction = 0.5, .aspect = {1, o.slenderness, 1}, .seed = o.seed});
}

/// Grains at rest under the first load. They have been loaded by three times the step before, and relieved: what slips
/// has slipped, and the step itself is elastic.
[[nodiscard]] inline dem settled_column(tp::packing grains, const oedometer_options& o) {
  dem column(std::move(grains), o.material);
  column.load = o.stress * column.area();
  column.compact(1e-7);
  column.load *= 1 + 3 * o.step;
  column.relax(1e-7);
  column.load = o.stress * column.area();
  column.relax(1e-7);
  return column;
}

/// What is measured on the grains alone, and by a steady flow through them at rest.
struct soil {
  double height = 0;   ///< [m]
  double area = 0;     ///< [m²]
  double density = 0;  ///< of the grains with their pores, dry [kg/m³]
  double porosity = 0;
  double settlement = 0;    ///< final, of the load step without fluid [m]
  double modulus = 0;       ///< oedometric [Pa]
  double permeability = 0;  ///< [m²]
};

using slip_law = tp::hydraulic_radius;

[[nodiscard]] inline slip_law law_of(double viscosity) {
  return {.viscosity = viscosity, .wall = tp::wall_condition::slip};
}

/// \param grains  at rest under their load
template <tp::tessellation_engine Engine>
[[nodiscard]] soil measure_soil(const dem& grains, double load_step, const Engine& triangulate) {
  soil s;
  s.height = grains.height();
  s.area = grains.area();
  double mass = 0;
  for (const double m : grains.masses) {
    mass += m;
  }
  s.density = mass / grains.volume();
  dem pressed = grains;
  pressed.load += load_step;
  pressed.relax(1e-7);
  s.settlement = grains.height() - pressed.height();
  s.modulus = load_step / s.area / (s.settlement / s.height);

  const tp::tessellation mesh = triangulate(grains.grains, tp::walled(grains.bounds));
  double voids = 0;
  for (const double v : mesh.net.arrays().void_volumes) {
    voids += v;
  }
  s.porosity = voids / grains.volume();
  tp::flow_options through;
  through.conditions.at(tp::face::y_min) = tp::held_pressure(1.0);
  through.conditions.at(tp::face::y_max) = tp::held_pressure(0.0);
  through.refused = tp::refused_throats::closed;
  tp::saturated_flow flow(mesh.net, law_of(1.0), tp::ldlt_solver<>{}, through);
  flow.solve();
  s.permeability = -flow.flux(tp::face::y_max) * s.height / s.area;
  return s;
}

/// A profile of the pressure over the load step in equal layers, from the base up, with the theory beside it.
struct profile {
  double time = 0;  ///< T
  std::vector<double> pressure;
  std::vector<double> theory;
};

struct settlement_row {
  double time;     ///< T
  double settled;  ///< over the final settlement
  double theory;
};

struct consolidation {
  soil ground;
  double viscosity = 0;
  double diffusivity = 0;  ///< c_v [m²/s]
  double time_step = 0;    ///< [s]
  double drag_step = 0;    ///< bound on the step without added mass [s]
  std::vector<settlement_row> settlement;
  std::vector<profile> profiles;
  double settlement_error = 0;  ///< largest |U − theory|
  double pressure_error = 0;    ///< largest of a layer in a profile, over the load step
  double pressure_error_rms = 0;
  double initial_pressure = 0;  ///< mean of the lower half at T = 0.01, over the load step
  double mass_defect = 0;       ///< of the fluid, over the throughput
  double volume_defect = 0;     ///< outflow against the volume that the piston swept, over that volume
  std::size_t steps = 0;
  std::size_t rebuilds = 0;
  std::size_t unsolved = 0;
};

/// Mean pressure over the load in equal layers of the height, from the base up: of the pores whose node (where the
/// pressure is that of the pore; on the wall for pores at a wall) lies in the layer, by volume. Beside it the theory
/// at the same nodes.
template <class Flow>
[[nodiscard]] profile profile_of(const Flow& flow, double time, double load, std::size_t layers) {
  const tp::network& net = flow.net();
  const tp::box& b = net.region().bounds;
  profile out{time, std::vector<double>(layers, 0.0), std::vector<double>(layers, 0.0)};
  std::vector<double> volume(layers, 0.0);
  for (std::size_t i = 0; i < net.pore_count(); ++i) {
    const tp::pore_id p(i);
    const double y = (flow.flow().system().nodes().position(net, p).y - b.lo.y) / b.size().y;
    const auto layer =
        static_cast<std::size_t>(std::clamp(y * static_cast<double>(layers), 0.0, static_cast<double>(layers) - 1));
    out.pressure[layer] += net.volume(p) * flow.pressure()[p] / load;
    out.theory[layer] += net.volume(p) * terzaghi::pressure(time, std::clamp(1 - y, 0.0, 1.0));
    volume[layer] += net.volume(p);
  }
  for (std::size_t k = 0; k < layers; ++k) {
    out.pressure[k] /= volume[k];
    out.theory[k] /= volume[k];
  }
  return out;
}

/// Loads the piston by a step and follows the consolidation. The fluid has the pressure 0 at the piston, which lets it
/// through; the other walls are sealed.
/// \param grains  at rest under their load
template <tp::tessellation_engine Engine>
[[nodiscard]] consolidation consolidate(dem& grains, const oedometer_options& o, const Engine& triangulate) {
  constexpr std::size_t layers = 10;
  consolidation out;
  const double step = o.step * grains.load;
  out.ground = measure_soil(grains, step, triangulate);
  const soil& s = out.ground;
  // H²/c_v = slowness · H/c, with c_v = k E/μ and c² = E/ρ
  out.viscosity = o.slowness * s.permeability * std::sqrt(s.density * s.modulus) / s.height;
  out.diffusivity = s.permeability * s.modulus / out.viscosity;
  out.time_step = o.time_step * grains.time_step();
  const double per_step = out.diffusivity * out.time_step / (s.height * s.height);

  tp::flow_options drained;
  drained.conditions.at(tp::face::y_max) = tp::held_pressure(0.0);
  drained.refused = tp::refused_throats::closed;
  tp::coupled_flow flow(triangulate(grains.grains, tp::walled(grains.bounds)).net, law_of(out.viscosity),
                        tp::ldlt_solver<>{}, drained, {.refresh_every = o.refresh_every});
  out.drag_step = flow.largest_step(grains.masses);
  std::vector<double> added = flow.added_mass(out.time_step);

  const std::array<double, 5> times{0.05, 0.1, 0.2, 0.5, 1.0};
  const double start = grains.height();
  const double first_volume = grains.volume();
  const double pressure = step / s.area;
  grains.load += step;
  double squares = 0;
  double next_row = 0;
  double previous = 0;
  double last_volume = first_volume;  // at the last step of the fluid
  for (double time = 0; time < o.end;) {
    if (out.steps % 50 == 0 &&
        flow.rebuild_due({.every = o.rebuild_every, .strain = o.rebuild_strain}) != tp::rebuild_reason::none) {
      flow.rebuild(triangulate, grains.grains, grains.bounds);
      ++out.rebuilds;
      added = flow.added_mass(out.time_step);
    }
    grains.push();
    tp::box_motion box{grains.bounds};
    box.walls[static_cast<std::size_t>(tp::face::y_max)].y = grains.piston_velocity;
    const tp::coupling_report report = flow.step(out.time_step, grains.grains, grains.velocities, grains.forces, box);
    out.unsolved += report.ok() ? 0U : 1U;
    grains.piston_force += flow.wall_forces()[static_cast<std::size_t>(tp::face::y_max)].y;
    last_volume = grains.volume();
    grains.move(out.time_step, added);
    ++out.steps;
    previous = time;
    time += per_step;
    const double settled = (start - grains.height()) / s.settlement;
    const double theory = terzaghi::settlement(time);
    out.settlement_error = std::max(out.settlement_error, std::abs(settled - theory));
    if (!std::isfinite(settled)) {
      throw tp::packing_error("the column at T = " + tp::short_number(time), "no finite settlement", "a stable step");
    }
    if (time >= next_row) {
      out.settlement.push_back({time, settled, theory});
      next_row = std::max(1.02 * time, time + 5e-4);
    }
    if (previous < 0.01 && time >= 0.01) {
      out.initial_pressure = profile_of(flow, time, pressure, 2).pressure[0];
    }
    for (const double t : times) {
      if (previous < t && time >= t) {
        profile shown = profile_of(flow, time, pressure, layers);
        for (std::size_t k = 0; k < layers; ++k) {
          const double error = std::abs(shown.pressure[k] - shown.theory[k]);
          out.pressure_error = std::max(out.pressure_error, error);
          squares += error * error;
        }
        out.profiles.push_back(std::move(shown));
      }
    }
  }
  if (!out.profiles.empty()) {
    out.pressure_error_rms = std::sqrt(squares / static_cast<double>(layers * out.profiles.size()));
  }
  out.mass_defect = flow.ledger().defect() / flow.ledger().throughput;
  const double swept = first_volume - last_volume;
  out.volume_defect = std::abs(flow.ledger().outflow - swept) / swept;
  return out;
}

}  // namespace support
