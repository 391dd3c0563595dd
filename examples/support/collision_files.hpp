// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "collision_job.hpp"
#include "keys.hpp"
#include "plot.hpp"
#include "restitution.hpp"

#include "tetrapore/io/csv.hpp"

#include <filesystem>

/// \file
/// Files and lines of wet_collision.

namespace support {

inline void write_trace(const std::filesystem::path& folder, const collision& c) {
  tp::io::csv_writer table(folder / "collision.csv", {"time [s]", "gap [m]", "film [m]", "pull [N]", "rate [m/s]",
                                                      "kinetic [J]", "elastic [J]", "capillary [J]", "dissipated [J]"});
  for (const instant& i : c.trace) {
    table.row(i.time, i.gap, i.film, i.force, i.rate, i.energy.kinetic, i.energy.elastic, i.energy.capillary,
              i.dissipated);
  }
  table.commit();
}

inline void write_sweep(const std::filesystem::path& folder, const restitution_sweep& s) {
  tp::io::csv_writer table(folder / "restitution.csv", {"St", "film", "film_and_bridge", "film_theory",
                                                        "film_and_bridge_theory", "resisted_inward_alone"});
  curve film{"film alone", {}, {}, "#2b6cb0", "", false, 2.5};
  curve wet{"film and bridge", {}, {}, "#2f855a", "", false, 2.5};
  curve film_theory{"1 − St_c/St, hard rough grains", {}, {}, "#2b6cb0", "6 4", false, 1.5};
  curve wet_theory{"the same, less what the bridge takes", {}, {}, "#2f855a", "6 4", false, 1.5};
  curve inward{"1 − St_c/2St: no suction on the way out", {}, {}, "#888", "2 4", false, 1.5};
  for (const restitution_row& r : s.rows) {
    table.row(r.stokes, r.film, r.wet, r.film_theory, r.wet_theory, r.inward_theory);
    for (const auto& [to, y] : {std::pair{&film, r.film},
                                {&wet, r.wet},
                                {&film_theory, r.film_theory},
                                {&wet_theory, r.wet_theory},
                                {&inward, r.inward_theory}}) {
      to->x.push_back(r.stokes);
      to->y.push_back(y);
    }
  }
  table.commit();
  plot p;
  p.title = "Rebound of two wet grains";
  p.subtitle = "coefficient of restitution against the Stokes number, by the viscosity; 0: the grains stick";
  p.x_label = "St = m v / 6πμa*² [–]";
  p.y_label = "coefficient of restitution [–]";
  p.x_end = s.rows.back().stokes;
  p.y_end = 1.5;
  p.curves = {film, wet, film_theory, wet_theory, inward};
  write_svg(folder / "restitution.svg", p);
}

inline void write_cloud(const std::filesystem::path& folder, const cloud_run& c) {
  tp::io::csv_writer table(
      folder / "cloud.csv",
      {"time [s]", "kinetic [J]", "potential [J]", "elastic [J]", "capillary [J]", "film [J]", "friction [J]",
       "rupture [J]", "energy_defect", "bridges", "formed", "ruptures", "liquid_in_bridges [m3]"});
  const double start = c.trace.front().energy.sum();
  curve kinetic{"kinetic", {}, {}, "#2b6cb0", "", false, 2.5};
  curve motion{"kinetic and potential", {}, {}, "#2f855a", "", false, 2};
  curve film{"taken by the films", {}, {}, "#d9534f", "", false, 2};
  curve friction{"taken by friction, slip and roll", {}, {}, "#805ad5", "", false, 2};
  curve rupture{"taken by bridges that ruptured", {}, {}, "#dd6b20", "", false, 2};
  curve all{"all that the books hold", {}, {}, "#222", "6 4", false, 1.5};
  for (const cloud_instant& i : c.trace) {
    const energies& e = i.energy;
    table.row(i.time, e.kinetic, e.potential, e.elastic, e.capillary, i.books.film, i.books.friction, i.books.rupture,
              i.energy_defect, i.bridges, i.books.formed, i.books.ruptures, i.liquid_in_bridges);
    for (const auto& [to, y] : {std::pair{&kinetic, e.kinetic},
                                {&motion, e.kinetic + e.potential},
                                {&film, i.books.film},
                                {&friction, i.books.friction},
                                {&rupture, i.books.rupture},
                                {&all, e.sum() + i.books.dissipated()}}) {
      to->x.push_back(1000 * i.time);
      to->y.push_back(y / start);
    }
  }
  table.commit();
  plot p;
  p.title = "Energy of a cloud of wet grains";
  p.subtitle = std::to_string(c.grains) + " grains in a box; where the energy that they start with goes";
  p.x_label = "time [ms]";
  p.y_label = "energy over that of the start [–]";
  p.x_end = 1000 * c.trace.back().time;
  p.y_end = 1.6;
  p.curves = {kinetic, motion, film, friction, rupture, all};
  write_svg(folder / "cloud.svg", p);
}

inline void print_refusals(const key_printer& say, const ledger& b, const std::string& prefix) {
  say((prefix + "refused_flooded").c_str(), b.refused_flooded);
  say((prefix + "refused_not_covered").c_str(), b.refused_not_covered);
  say((prefix + "refused_invalid_input").c_str(), b.refused_invalid_input);
  say((prefix + "refused_not_converged").c_str(), b.refused_not_converged);
}

inline void print_collision(const key_printer& say, const collision_job& job, const collision& c) {
  const restitution_theory theory = theory_of(job.material, job.pair);
  say("stokes", c.stokes);
  say("restitution", c.restitution);
  say("restitution_theory", theory.wet(c.stokes));
  say("stuck", std::size_t{c.stuck});
  say("duration", c.duration);
  say("largest_overlap", c.books.largest_overlap);
  say("largest_force", c.books.largest_force);
  say("thinnest_film", c.books.thinnest_film);
  say("formed", c.books.formed);
  say("ruptures", c.books.ruptures);
  say("bridges", c.bridges);
  say("rupture_gap", c.books.last_rupture_gap);
  say("energy_before", c.before.sum());
  say("energy_kinetic", c.after.kinetic);
  say("energy_elastic", c.after.elastic);
  say("energy_capillary", c.after.capillary);
  say("dissipated_film", c.books.film);
  say("dissipated_friction", c.books.friction);
  say("dissipated_rupture", c.books.rupture);
  say("energy_defect", c.energy_defect);
  say("momentum_defect", c.momentum_defect);
  say("angular_momentum_defect", c.angular_momentum_defect);
  say("liquid_defect", c.liquid_defect);
  say("steps", c.books.steps);
  print_refusals(say, c.books, "");
}

inline void print_sweep(const key_printer& say, const restitution_sweep& s) {
  say("critical_stokes_film", s.critical_film);
  say("critical_stokes_wet", s.critical_wet);
  say("critical_stokes_film_theory", s.theory.critical_film());
  say("critical_stokes_wet_theory", s.theory.critical_wet());
  say("sweep_defect", s.largest_defect);
}

inline void print_cloud(const key_printer& say, const cloud_run& c) {
  const cloud_instant& end = c.trace.back();
  say("cloud_grains", c.grains);
  say("cloud_energy_before", c.trace.front().energy.sum());
  say("cloud_energy_kinetic", end.energy.kinetic);
  say("cloud_energy_potential", end.energy.potential);
  say("cloud_energy_elastic", end.energy.elastic);
  say("cloud_energy_capillary", end.energy.capillary);
  say("cloud_dissipated_film", end.books.film);
  say("cloud_dissipated_friction", end.books.friction);
  say("cloud_dissipated_rupture", end.books.rupture);
  say("cloud_energy_defect", end.energy_defect);
  say("cloud_formed", end.books.formed);
  say("cloud_ruptures", end.books.ruptures);
  say("cloud_bridges", end.bridges);
  say("cloud_liquid", c.liquid);
  say("cloud_liquid_in_bridges", end.liquid_in_bridges);
  say("cloud_liquid_defect", c.liquid_defect);
  say("cloud_thinnest_film", end.books.thinnest_film);
  say("cloud_largest_overlap", end.books.largest_overlap);
  say("cloud_steps", end.books.steps);
  print_refusals(say, end.books, "cloud_");
}

}  // namespace support
