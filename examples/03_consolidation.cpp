// SPDX-License-Identifier: BSD-3-Clause
//
// Consolidation: a saturated column of grains under a piston, coupled two-way with the water in its pores.
//
// The grains are moved by a small discrete-element simulator (support/dem.hpp), which stands for the one that you have.
// When the load on the piston rises, water carries the whole of it at first; as it drains through the piston, the
// grains take over and the column settles. Terzaghi's theory says how fast, from two numbers that are measured on the
// same grains: their permeability, by a steady flow, and their stiffness, by the same load step without water.
// `consolidation --help` lists the options.
#include "support/keys.hpp"
#include "support/oedometer.hpp"
#include "support/plot.hpp"
#include "support/stopwatch.hpp"

#include "tetrapore/io/csv.hpp"
#include "tetrapore/io/read_packing.hpp"
#include "tetrapore/packing/check.hpp"
#include "tetrapore/tessellation/cgal.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

namespace tp = tetrapore;

struct job {
  support::oedometer_options test;
  std::filesystem::path packing;  ///< empty: a random one is made
  std::filesystem::path out = "consolidation_out";
};

// Step 1: grains at rest under the piston.
support::dem column_of(const job& j) {
  if (j.packing.empty()) {
    return support::settled_column(support::loose_column(j.test), j.test);
  }
  tp::packing grains = tp::io::read_packing(j.packing).packing;
  tp::check(grains);
  return support::settled_column(std::move(grains), j.test);
}

// Step 2, the load step and what follows, is `support::consolidate`. Step 3: files and numbers.
void write_files(const job& j, const support::consolidation& c) {
  tp::io::csv_writer settlement(j.out / "settlement.csv", {"T", "U", "U_terzaghi"});
  support::plot u;
  u.title = "Settlement under a load step";
  u.subtitle = "one-dimensional consolidation, drained at the piston";
  u.x_label = "time factor T = c_v t / H² [–]";
  u.y_label = "settlement over the final one U [–]";
  u.x_end = j.test.end;
  support::curve measured{"grains and water", {}, {}, "#2b6cb0", "", false, 2.5};
  support::curve theory{"Terzaghi, from the packing's own k and stiffness", {}, {}, "#d9534f", "6 4", false, 1.8};
  for (const support::settlement_row& row : c.settlement) {
    settlement.row(row.time, row.settled, row.theory);
    measured.x.push_back(row.time);
    measured.y.push_back(row.settled);
    theory.x.push_back(row.time);
    theory.y.push_back(row.theory);
  }
  settlement.commit();
  u.curves = {measured, theory};
  support::write_svg(j.out / "settlement.svg", u);

  tp::io::csv_writer profiles(j.out / "profiles.csv", {"T", "height", "pressure", "pressure_terzaghi"});
  support::plot p;
  p.title = "Pressure in the column";
  p.subtitle = "from the left: T = 1, 0.5, 0.2, 0.1, 0.05; dashed: Terzaghi";
  p.x_label = "pressure over the load step [–]";
  p.y_label = "height over that of the column [–]";
  p.x_end = 1.2;
  for (const support::profile& at : c.profiles) {
    support::curve mine{"grains and water", at.pressure, {}, "#2b6cb0", "", false, 2.5};
    support::curve its{"Terzaghi", at.theory, {}, "#d9534f", "6 4", false, 1.8};
    for (std::size_t k = 0; k < at.pressure.size(); ++k) {
      const double height = (static_cast<double>(k) + 0.5) / static_cast<double>(at.pressure.size());
      mine.y.push_back(height);
      its.y.push_back(height);
      profiles.row(at.time, height, at.pressure[k], at.theory[k]);
    }
    p.curves.push_back(std::move(mine));
    p.curves.push_back(std::move(its));
  }
  profiles.commit();
  support::write_svg(j.out / "profiles.svg", p);
}

void run(const job& j) {
  support::stopwatch watch;
  support::dem column = column_of(j);
  const double seconds_packing = watch.lap();
  std::fprintf(stderr, "%zu grains at rest under %g Pa\n", column.grains.size(), j.test.stress);
  const support::consolidation c = support::consolidate(column, j.test, tp::cgal_triangulation{});
  const double seconds_coupled = watch.lap();
  std::filesystem::create_directories(j.out);
  write_files(j, c);
  std::fprintf(stderr, "wrote %s\n", j.out.string().c_str());

  const support::soil& s = c.ground;
  const support::key_printer say{.digits = 6};
  say("grains", column.grains.size());
  say("height", s.height);
  say("porosity", s.porosity);
  say("permeability", s.permeability);
  say("modulus", s.modulus);
  say("viscosity", c.viscosity);
  say("c_v", c.diffusivity);
  say("consolidation_over_wave_time", j.test.slowness);
  say("time_step", c.time_step);
  say("drag_step_bound", c.drag_step);
  say("initial_pressure", c.initial_pressure);
  say("settlement_final", s.settlement);
  say("settlement_error_max", c.settlement_error);
  say("pressure_error_max", c.pressure_error);
  say("pressure_error_rms", c.pressure_error_rms);
  say("mass_defect", c.mass_defect);
  say("swept_volume_defect", c.volume_defect);
  say("steps", c.steps);
  say("rebuilds", c.rebuilds);
  say("unsolved_steps", c.unsolved);
  say("seconds_packing", seconds_packing);
  say("seconds_coupled", seconds_coupled);
  say("peak_rss_mb", support::peak_rss_mb());
}

int main(int argc, char** argv) {
  job j;
  CLI::App app{"Oedometer test on a saturated column of grains, against Terzaghi's theory"};
  app.add_option("packing", j.packing, "file of spheres in a box; without it a random column is made");
  app.add_option("--grains", j.test.grains, "grains of a random column")->capture_default_str();
  app.add_option("--slenderness", j.test.slenderness, "its height over its width")->capture_default_str();
  app.add_option("--seed", j.test.seed, "of a random column")->capture_default_str();
  app.add_option("--modulus", j.test.material.modulus, "of the contacts [Pa]")->capture_default_str();
  app.add_option("--stress", j.test.stress, "under the piston before the step [Pa]")->capture_default_str();
  app.add_option("--step", j.test.step, "of the load, over the stress")->capture_default_str();
  app.add_option("--slowness", j.test.slowness, "time of consolidation over that of a wave; sets the viscosity")
      ->capture_default_str();
  app.add_option("--end", j.test.end, "time factor T at which the test ends, at least 0.05")->capture_default_str();
  app.add_option("--refresh-every", j.test.refresh_every, "steps between two computations of the conductances")
      ->capture_default_str();
  app.add_option("--rebuild-every", j.test.rebuild_every, "steps between two triangulations; 0: by strain alone")
      ->capture_default_str();
  app.add_option("--out", j.out, "folder of the files")->capture_default_str();
  try {
    app.parse(argc, argv);
    for (const auto& [name, value] :
         {std::pair{"--modulus", j.test.material.modulus}, std::pair{"--slenderness", j.test.slenderness},
          std::pair{"--stress", j.test.stress}, std::pair{"--step", j.test.step},
          std::pair{"--slowness", j.test.slowness}, std::pair{"--end", j.test.end}}) {
      if (!(value > 0) || !std::isfinite(value)) {
        throw tp::parameter_error(name, tp::short_number(value), "a finite number above 0");
      }
    }
    if (j.test.end < 0.05) {  // the time of the first profile
      throw tp::parameter_error("--end", tp::short_number(j.test.end), "at least 0.05");
    }
    if (j.test.refresh_every == 0) {
      throw tp::parameter_error("--refresh-every", "0", "at least 1");
    }
    if (j.packing.empty() && j.test.grains < 50) {
      throw tp::parameter_error("--grains", std::to_string(j.test.grains), "at least 50");
    }
    run(j);
    return 0;
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  } catch (const tp::io::output_error& e) {
    std::fprintf(stderr, "consolidation: %s\n", e.what());
    return 1;
  } catch (const tp::setup_error& e) {
    std::fprintf(stderr, "consolidation: %s\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "consolidation: %s\n", e.what());
    return 1;
  }
}
