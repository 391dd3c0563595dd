// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/drainage_results.hpp"
#include "support/plot.hpp"
#include "support/render.hpp"

#include "tetrapore/io/csv.hpp"
#include "tetrapore/io/pvd.hpp"
#include "tetrapore/io/vtp.hpp"
#include "tetrapore/io/vtu.hpp"

#include <string>
#include <vector>

/// \file
/// The files that primary_drainage leaves.

namespace support {

/// Name of a status in a file.
[[nodiscard]] inline const char* word_for(tp::entry_status s) {
  using enum tp::entry_status;
  switch (s) {
    case ok: return "ok";
    case dry_corner: return "dry_corner";
    case lost_arc: return "lost_arc";
    case merged: return "merged";
    case closed: return "closed";
    case gap_limited: return "gap_limited";
    case no_hole: return "no_hole";
    case not_covered: return "not_covered";
    case invalid_input: return "invalid_input";
    case not_converged: return "not_converged";
  }
  return "unknown";
}

/// The first row is the start; each row after it is the state when the burst that its pressure released has ended.
inline void write_retention(const std::filesystem::path& path, const tp::retention_curve& c, const summary& s) {
  tp::io::csv_writer table(path, {"p_c [Pa]", "p_c r/sigma", "S", "S_interior", "gas_pores"});
  table.row(0, 0, 1, std::isnan(c.interior_end_saturation()) ? nan : 1, 0);
  for (const tp::retention_point& p : c.points()) {
    table.row(p.pressure, p.pressure / s.pressure_unit, p.saturation, p.interior_saturation, p.events);
  }
  table.commit();
}

inline void write_events(const std::filesystem::path& path, const history& h) {
  tp::io::csv_writer table(
      path, {"event", "burst", "pore", "throat", "p_c [Pa]", "threshold [Pa]", "status", "volume [m3]", "S"});
  double drained = 0;
  for (std::size_t i = 0; i < h.events.size(); ++i) {
    const auto& e = h.events[i];
    drained += e.volume;
    table.row(i + 1, e.level, e.pore.index(), e.throat.index(), e.pressure, e.threshold, word_for(e.reason), e.volume,
              1 - drained / h.void_volume);
  }
  table.commit();
}

inline void write_sizes(const std::filesystem::path& path, const tp::network& net, const sizes& s) {
  tp::io::csv_writer table(path, {"kind", "id", "inscribed_radius [m]", "void_volume [m3]", "fluid_area [m2]",
                                  "coordination", "entry_pressure [Pa]", "status"});
  for (std::size_t p = 0; p < net.pore_count(); ++p) {
    table.row("pore", p, s.pore_radius[p], net.void_volume(tp::pore_id(p)), "", s.coordination[p], "", "");
  }
  for (std::size_t t = 0; t < net.throat_count(); ++t) {
    const bool boundary = net.is_boundary(tp::throat_id(t));
    table.row("throat", t, s.throat_radius[t], "", s.throat_area[t], "", s.entry_pressure[t],
              boundary ? "boundary" : word_for(s.entry_status[t]));
  }
  table.commit();
}

/// The final state with its history: gas entered each pore at `invasion_pressure`, when S was `S_at_invasion`.
inline void write_final_pores(const std::filesystem::path& path, const tp::network& net, const sizes& s,
                              const history& h) {
  std::vector<double> saturation(net.pore_count(), nan);
  double drained = 0;
  for (const auto& e : h.events) {
    drained += e.volume;
    saturation[e.pore.index()] = 1 - drained / h.void_volume;
  }
  std::vector<std::int32_t> cluster(net.pore_count(), -1);
  std::vector<std::uint8_t> reservoir(net.pore_count(), 0);
  for (std::size_t i = 0; i < net.pore_count(); ++i) {
    const tp::pore_id p(i);
    if (h.end.is_trapped(p)) {
      cluster[i] = static_cast<std::int32_t>(h.end.cluster(p));
    }
    reservoir[i] = h.end.is_inlet(p) ? 1 : h.end.is_outlet(p) ? 2 : 0;
  }
  tp::io::write_pores(path, net,
                      {{"phase", phases_of(h.end)},
                       {"S_at_invasion", saturation},
                       {"invasion_pressure [Pa]", h.end.invasion_pressures()},
                       {"trapped_cluster", cluster},
                       {"reservoir", reservoir},
                       {"void_volume [m3]", net.arrays().void_volumes},
                       {"inscribed_radius [m]", s.pore_radius},
                       {"coordination", s.coordination}});
}

/// One VTU file per snapshot, and the list of them. The time is 1 − S.
inline void write_phases(const std::filesystem::path& folder, const tp::network& net, const history& h) {
  std::filesystem::create_directories(folder / "phases");
  tp::io::pvd_series series(folder / "phases.pvd");
  for (const snapshot& shot : h.snapshots) {
    const auto percent = static_cast<int>(std::lround(1000 * shot.saturation));
    const auto path = folder / "phases" / ("phases_s" + std::to_string(percent) + ".vtu");
    tp::io::write_pores(path, net, {{"phase", shot.phases}});
    series.add(1 - shot.saturation, path);
  }
  series.write();
}

/// A number with four digits, as a label shows it.
[[nodiscard]] inline std::string rounded(double x) {
  std::array<char, 32> text{};
  return {text.data(), static_cast<std::size_t>(std::snprintf(text.data(), text.size(), "%.4g", x))};
}

/// The curve with its fit. The pressure axis ends at three times the middle of the curve: a tail of a few small pores
/// above it would press the rest flat.
inline void plot_retention(const std::filesystem::path& path, const tp::retention_curve& c, const summary& s,
                           const drainage_job& job) {
  const double last = c.points().empty() ? 10 * s.pressure_unit : c.points().back().pressure;
  const double middle = c.pressure_at(0.5 * (1 + c.end_saturation())).value_or(last);
  const double end = std::min(1.06 * last, 3 * middle);
  const bool kilo = end >= 5000;
  const double unit = kilo ? 1000 : 1;

  const std::string law = job.entry == "msp" ? "Mayer-Stowe-Princen, " + job.gap_limited : "inscribed circle";
  curve all{"all pores (" + law + ")", {1}, {0}, "#2b6cb0", "", true, 2.5};
  curve interior{"pores that touch no wall", {1}, {0}, "#2f9e63", "7 4", true, 1.8};
  for (const tp::retention_point& p : c.points()) {
    all.x.push_back(p.saturation);
    all.y.push_back(p.pressure / unit);
    interior.x.push_back(p.interior_saturation);
    interior.y.push_back(p.pressure / unit);
  }
  plot p;
  p.title = "Primary drainage of " + job.path.filename().string();
  p.subtitle = std::to_string(s.grains) + " grains of mean radius " + rounded(1000 * s.mean_radius) +
               " mm, σ = " + rounded(job.surface_tension) + " N/m, θ = " + rounded(job.contact_angle) +
               "°, gas enters at " + describe(job.inlet);
  p.x_label = "saturation of the wetting phase S [–]";
  p.y_label = std::string("capillary pressure p_c [") + (kilo ? "kPa]" : "Pa]");
  p.right_label = "p_c × mean radius / σ [–]";
  p.right_factor = unit / s.pressure_unit;
  p.y_end = end / unit;
  p.curves.push_back(std::move(all));
  if (!std::isnan(c.interior_end_saturation())) {
    p.curves.push_back(std::move(interior));
  }
  if (s.fitted.ok()) {
    const tp::van_genuchten& v = s.fitted.value.law;
    curve fit{"van Genuchten, n = " + rounded(v.n) + ", 1/α = " + rounded(1 / v.alpha) + " Pa",
              {},
              {},
              "#d9534f",
              "2 3",
              false,
              1.8};
    for (int k = 1; k <= 400; ++k) {
      fit.x.push_back(v.saturation(end * k / 400));
      fit.y.push_back(end / unit * k / 400);
    }
    p.curves.push_back(std::move(fit));
  }
  if (s.residual_saturation > 0) {
    p.marks.push_back({s.residual_saturation, "trapped: S = " + rounded(s.residual_saturation)});
  }
  write_svg(path, p);
}

/// Draws the state where the saturation first fell to 0.4, or the last one where it never did.
inline void draw_phases(const std::filesystem::path& path, const tp::network& net, const history& h,
                        const drainage_job& job) {
  const snapshot* shown = &h.snapshots.back();
  for (const snapshot& s : h.snapshots) {
    if (s.saturation <= 0.4) {
      shown = &s;
      break;
    }
  }
  if (shown->saturation > 0.4) {
    std::fprintf(stderr, "the saturation never falls to 0.4: the picture shows S = %.3f\n", shown->saturation);
  }
  palette colours;
  colours.fluids = {{0.97, 0.63, 0.16}, {0.16, 0.46, 0.80}, {0.06, 0.20, 0.46}};  // gas, liquid, trapped liquid
  std::vector<std::uint8_t> fluid;
  for (const phase f : shown->phases) {
    fluid.push_back(static_cast<std::uint8_t>(f));
  }
  write_png(path, renderer(net, fluid, colours, {.up = job.inlet}).draw());
}

inline void write_everything(const drainage_job& job, const tp::network& net, const sizes& s, const history& h,
                             const summary& told) {
  std::error_code error;
  std::filesystem::create_directories(job.out, error);
  if (error) {
    throw tp::io::output_error(job.out, error.message());
  }
  write_retention(job.out / "retention.csv", h.curve, told);
  plot_retention(job.out / "retention.svg", h.curve, told, job);
  write_events(job.out / "events.csv", h);
  write_sizes(job.out / "sizes.csv", net, s);
  write_final_pores(job.out / "pores.vtu", net, s, h);
  tp::io::write_grains(job.out / "grains.vtp", net.grains());
  write_phases(job.out, net, h);
  draw_phases(job.out / "phases_s40.png", net, h, job);
}

}  // namespace support
