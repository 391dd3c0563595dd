// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/flow_choices.hpp"
#include "support/gradient_slice.hpp"
#include "support/keys.hpp"
#include "support/plot.hpp"

#include "tetrapore/io/csv.hpp"
#include "tetrapore/io/vtp.hpp"
#include "tetrapore/io/vtu.hpp"
#include "tetrapore/one_phase.hpp"
#include "tetrapore/packing/statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>
#include <vector>

/// \file
/// What is told about a saturated flow: the numbers behind the keys on stdout, and the files.

namespace support {

using flow_of_the_job = tp::saturated_flow<chosen_law, chosen_solver>;

struct flow_seconds {
  double tessellation = 0;
  double laws = 0;
  double setup = 0;
  double solve = 0;
  double resolve = 0;
};

struct flow_summary {
  double permeability = 0;   ///< [m²]
  double over_r2 = 0;        ///< by the squared mean radius
  double flux_in = 0;        ///< [m³/s]
  double flux_out = 0;       ///< [m³/s]
  tp::vec3<double> force{};  ///< of the driving pressure on grains and walls [N]
  double force_defect = 0;   ///< its difference to the boundary pressure force, over that
  double min_pressure = 0;   ///< [Pa]
  double max_pressure = 0;   ///< [Pa]
  tp::solve_report solution;
};

/// The axis along which fluid flows.
[[nodiscard]] inline std::size_t flow_axis(const flow_job& job) {
  return job.gradient ? *job.gradient : axis_of(job.inlet);
}

/// Pressures at two faces, or a mean gradient along a periodic axis.
[[nodiscard]] inline tp::flow_conditions conditions_of(const flow_job& job, const tp::box& region) {
  tp::flow_conditions c;
  if (job.gradient) {
    c.mean_gradient[*job.gradient] = -job.pressure_drop / region.size()[*job.gradient];
  } else {
    c.at(job.inlet) = tp::held_pressure(job.pressure_drop);
    c.at(job.outlet) = tp::held_pressure(0);
  }
  return c;
}

[[nodiscard]] inline flow_summary summarise(const flow_of_the_job& flow, const tp::fluid_forces& forces,
                                            const flow_job& job) {
  flow_summary s;
  s.solution = flow.report();
  const tp::network& net = flow.net();
  const tp::box& region = net.region().bounds;
  const tp::vec3<double> gradient = flow.system().conditions().mean_gradient;
  if (job.gradient) {
    const double length = region.size()[*job.gradient];
    const double velocity = mean_velocity(flow)[*job.gradient];
    s.permeability = velocity * job.viscosity * length / job.pressure_drop;
    s.flux_in = velocity * region.volume() / length;
    s.flux_out = s.flux_in;  // what leaves by one face of a period is what enters by the other
  } else {
    s.permeability = box_permeability(flow, job.inlet, job.outlet, job.viscosity);
    s.flux_in = flow.flux(job.inlet);
    s.flux_out = -flow.flux(job.outlet);
  }
  double radius = 0;
  for (const auto& g : net.grains()) {
    radius += g.radius / static_cast<double>(net.grain_count());
  }
  s.over_r2 = s.permeability / (radius * radius);
  s.force = forces.total();
  const tp::vec3<double> boundary = boundary_force(net, flow.driving_pressure(), gradient);
  s.force_defect = norm(s.force - boundary) / norm(boundary);
  const auto p = flow.pressure().values();
  s.min_pressure = *std::min_element(p.begin(), p.end());
  s.max_pressure = *std::max_element(p.begin(), p.end());
  return s;
}

/// Mean pressure of the void in layers across the flow, from where the fluid comes.
[[nodiscard]] inline curve pressure_profile(const flow_of_the_job& flow, const flow_job& job) {
  constexpr std::size_t layers = 40;
  const tp::network& net = flow.net();
  const tp::box& region = net.region().bounds;
  const std::size_t axis = flow_axis(job);
  const double length = region.size()[axis];
  const bool downwards = !job.gradient && is_max(job.inlet);
  std::array<double, layers> sum{};
  std::array<double, layers> weight{};
  for (std::size_t i = 0; i < net.pore_count(); ++i) {
    const tp::pore_id p(i);
    const tp::vec3<double> at = flow.system().nodes().position(net, p);
    const double along = downwards ? region.hi[axis] - at[axis] : at[axis] - region.lo[axis];
    const double period = job.gradient ? std::floor(along / length) : 0.0;
    const auto layer = static_cast<std::ptrdiff_t>(std::floor((along / length - period) * layers));
    const auto k = static_cast<std::size_t>(std::clamp(layer, std::ptrdiff_t{0}, std::ptrdiff_t{layers - 1}));
    // the pressure of a pore in another period is that of its image in this one, less the drop of the periods between
    sum[k] += net.void_volume(p) * (flow.driving_pressure()[p] + period * job.pressure_drop);
    weight[k] += net.void_volume(p);
  }
  curve c;
  c.name = "mean over the void of a layer";
  for (std::size_t k = 0; k < layers; ++k) {
    if (weight[k] > 0) {
      c.x.push_back((static_cast<double>(k) + 0.5) / layers * length);
      c.y.push_back(sum[k] / weight[k]);
    }
  }
  return c;
}

inline void plot_profile(const std::filesystem::path& path, const flow_of_the_job& flow, const flow_job& job,
                         const flow_summary& s) {
  curve measured = pressure_profile(flow, job);
  const double length = flow.net().region().bounds.size()[flow_axis(job)];
  if (job.gradient) {  // only differences mean something: start the period at the whole drop
    const double shift = job.pressure_drop * (1 - measured.x.front() / length) - measured.y.front();
    for (double& y : measured.y) {
      y += shift;
    }
  }
  curve even{"even fall", {0, length}, {job.pressure_drop, 0}, "#888888", "6 4", false, 1.5};
  std::array<char, 64> k{};
  std::snprintf(k.data(), k.size(), "k = %.4g m², k / r² = %.4g", s.permeability, s.over_r2);
  plot p;
  p.title = "Saturated flow through " + job.path.filename().string();
  p.subtitle = std::to_string(flow.net().grain_count()) + " grains, law " + job.law + ", " + k.data();
  p.x_label = std::string("distance along ") + "xyz"[flow_axis(job)] + " from where the fluid enters [m]";
  p.y_label = "pressure [Pa]";
  p.x_end = length;
  p.y_end = std::max(job.pressure_drop, *std::max_element(measured.y.begin(), measured.y.end())) * 1.05;
  p.curves = {std::move(measured), std::move(even)};
  write_svg(path, p);
}

/// Writes pores.vtu, grains.vtp, forces.csv, pressure.svg and gradient.png; returns the share of the dissipation at the
/// throats of the slice (see gradient_map).
inline double write_flow(const flow_job& job, const flow_of_the_job& flow, const tp::fluid_forces& forces,
                         const flow_summary& s) {
  std::filesystem::create_directories(job.out);
  const tp::network& net = flow.net();
  std::vector<tp::vec3<double>> total;
  for (std::size_t g = 0; g < net.grain_count(); ++g) {
    total.push_back(forces.on(tp::grain_id(g)));
  }
  tp::io::write_pores(job.out / "pores.vtu", net,
                      {{"pressure [Pa]", flow.pressure().values()}, {"void_volume [m3]", net.arrays().void_volumes}});
  tp::io::write_grains(job.out / "grains.vtp", net.grains(), {{"force [N]", total}, {"torque [N m]", forces.torques}});
  tp::io::csv_writer table(job.out / "forces.csv",
                           {"grain", "force_x [N]", "force_y [N]", "force_z [N]", "pressure_x [N]", "pressure_y [N]",
                            "pressure_z [N]", "torque_x [N m]", "torque_y [N m]", "torque_z [N m]"});
  for (std::size_t g = 0; g < total.size(); ++g) {
    const auto& p = forces.pressure[g];
    const auto& t = forces.torques[g];
    table.row(g, total[g].x, total[g].y, total[g].z, p.x, p.y, p.z, t.x, t.y, t.z);
  }
  table.commit();
  plot_profile(job.out / "pressure.svg", flow, job, s);

  std::vector<double> drops(net.throat_count());
  for (std::size_t t = 0; t < drops.size(); ++t) {
    drops[t] = flow.pressure_drop(tp::throat_id(t));
  }
  gradient_map map(net, flow.system().nodes(), drops);
  const tp::box& region = net.region().bounds;
  const std::size_t axis = flow_axis(job);
  draw_gradient(job.out / "gradient.png", map, region, axis, job.pressure_drop / region.size()[axis]);
  return map.spent_at_throats(flow.conductances().values);
}

inline void print_flow(const flow_of_the_job& flow, const flow_summary& s, const flow_seconds& t, double at_throats) {
  const key_printer say;
  const tp::flow_nodes& nodes = flow.system().nodes();
  say("grains", flow.net().grain_count());
  say("pores", flow.net().pore_count());
  say("throats", flow.net().throat_count());
  say("nodes", nodes.size());
  say("flat_pores", nodes.flat_pores());
  say("coincident_throats", nodes.coincident_throats());
  say("closed_throats", flow.conductances().counts[tp::conductance_status::closed]);
  say("refused_throats", flow.conductances().counts.refused());
  say("permeability", s.permeability);
  say("permeability_over_r2", s.over_r2);
  say("flux_in", s.flux_in);
  say("flux_out", s.flux_out);
  say("force_total_x", s.force.x);
  say("force_total_y", s.force.y);
  say("force_total_z", s.force.z);
  say("force_defect", s.force_defect);
  say("min_pressure", s.min_pressure);
  say("max_pressure", s.max_pressure);
  say("contrast", flow.contrast());
  say("dissipation_at_throats", at_throats);
  say("iterations", s.solution.iterations);
  say("backward_error", s.solution.backward_error);
  say("seconds_tessellation", t.tessellation);
  say("seconds_laws", t.laws);
  say("seconds_setup", t.setup);
  say("seconds_solve", t.solve);
  say("seconds_resolve", t.resolve);
  say("peak_rss_mb", peak_rss_mb());
}

}  // namespace support
