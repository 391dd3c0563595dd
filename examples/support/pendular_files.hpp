// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/bridge_shapes.hpp"
#include "support/keys.hpp"
#include "support/pendular_job.hpp"
#include "support/plot.hpp"

#include "tetrapore/io/csv.hpp"
#include "tetrapore/io/vtp.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

/// \file
/// The files and keys of pendular_packing.

namespace support {

/// Name of a status in a file.
[[nodiscard]] inline const char* word_for(tp::bridge_status s) {
  using enum tp::bridge_status;
  switch (s) {
    case ok: return "ok";
    case no_liquid: return "no_liquid";
    case ruptured: return "ruptured";
    case lopsided: return "lopsided";
    case flooded: return "flooded";
    case not_covered: return "not_covered";
    case invalid_input: return "invalid_input";
    case not_converged: return "not_converged";
  }
  return "unknown";
}

/// All steps from wet to dry, and the bridges of the last.
struct pendular_results {
  std::vector<pendular_state> states;
  std::vector<bridge_answer> last;
  double seconds_laws = 0;
  std::size_t asked = 0;    ///< times that the law was, also of pairs that turned out to have no bridge
  double seconds_last = 0;  ///< for the bridges of the last step alone

  /// The wettest state in which no two bridges touch; null where they do in all.
  [[nodiscard]] const pendular_state* pendular_limit() const {
    const auto at =
        std::find_if(states.begin(), states.end(), [](const pendular_state& s) { return s.overlapping == 0; });
    return at == states.end() ? nullptr : &*at;
  }
};

struct pendular_seconds {
  double read = 0;
  double pairs = 0;
  double tables = 0;
  double states = 0;  ///< laws included
  double write = 0;
};

inline void write_states(const std::filesystem::path& path, const pendular_scene& scene, const pendular_results& all,
                         control held) {
  using enum tp::bridge_status;
  tp::io::csv_writer table(path, {held == control::suction ? "suction [Pa]" : "volume_of_a_bridge [m3]",
                                  "bridges",
                                  "ruptured",
                                  "flooded",
                                  "not_covered",
                                  "invalid_input",
                                  "not_converged",
                                  "overlapping",
                                  "liquid_volume [m3]",
                                  "S",
                                  "liquid_content",
                                  "mean_force [N]",
                                  "stress_xx [Pa]",
                                  "stress_yy [Pa]",
                                  "stress_zz [Pa]",
                                  "stress_yz [Pa]",
                                  "stress_xz [Pa]",
                                  "stress_xy [Pa]",
                                  "mean_stress [Pa]",
                                  "rumpf_strength [Pa]"});
  for (const pendular_state& s : all.states) {
    table.row(s.held, s.formed(), s.ruptured(), s.of(flooded), s.of(not_covered), s.of(invalid_input),
              s.of(not_converged), s.overlapping, s.liquid_volume, scene.saturation(s),
              s.liquid_volume / scene.box_volume(), s.mean_force, s.stress[0], s.stress[1], s.stress[2], s.stress[3],
              s.stress[4], s.stress[5], s.mean_stress(), s.rumpf);
  }
  table.commit();
}

/// One row per close pair; b is a grain or the name of a wall.
inline void write_bridges(const std::filesystem::path& path, const pendular_scene& scene,
                          std::span<const bridge_answer> bridges) {
  tp::io::csv_writer table(path, {"a", "b", "image_x", "image_y", "image_z", "gap [m]", "status", "force [N]",
                                  "volume [m3]", "suction [Pa]", "contact_radius_a [m]", "contact_radius_b [m]"});
  for (std::size_t i = 0; i < bridges.size(); ++i) {
    const auto& [key, shape, branch] = scene.pairs[i];
    const bridge_answer& b = bridges[i];
    const std::string other = key.b.is_wall() ? describe(key.b.wall()) : std::to_string(key.b.grain().index());
    table.row(key.a.index(), other, key.shift.x, key.shift.y, key.shift.z, shape.gap, word_for(b.reason), b.force,
              b.volume, b.suction, b.contact1, b.contact2);
  }
  table.commit();
}

/// The menisci as surfaces of revolution.
inline void write_tubes(const std::filesystem::path& path, const pendular_scene& scene,
                        std::span<const bridge_answer> bridges, const bridge_law_of_the_job& law, control held,
                        double value) {
  std::vector<tp::io::tube> tubes;
  std::vector<float> force;
  std::vector<float> volume;
  std::vector<float> gap;
  for (std::size_t i = 0; i < bridges.size(); ++i) {
    if (bridges[i].reason == tp::bridge_status::ok) {
      const tp::close_edge& e = scene.pairs[i];
      tubes.push_back({scene.packing.grains[e.key.a.index()].centre + e.shape.radius1 * e.shape.normal, e.shape.normal,
                       std::visit(
                           [&]<class Law>(const Law& l) {
                             return with_given<Law>(held, value,
                                                    [&](const auto& given) { return outline_of(l, e.shape, given); });
                           },
                           law)});
      force.push_back(static_cast<float>(bridges[i].force));
      volume.push_back(static_cast<float>(bridges[i].volume));
      gap.push_back(static_cast<float>(e.shape.gap));
    }
  }
  tp::io::write_tubes(path, tubes, {{"force [N]", force}, {"volume [m3]", volume}, {"gap [m]", gap}}, 10);
}

[[nodiscard]] inline std::string four_digits(double x) {
  std::array<char, 32> text{};
  return {text.data(), static_cast<std::size_t>(std::snprintf(text.data(), text.size(), "%.4g", x))};
}

/// What all plots of a run say about it.
[[nodiscard]] inline plot titled(const std::string& what, const pendular_scene& scene, const pendular_job& job) {
  plot p;
  p.title = what + " of " + job.path.filename().string();
  p.subtitle = std::to_string(scene.packing.grains.size()) + " grains of mean radius " +
               four_digits(1000 * tp::radii_of(scene.packing.grains).mean) +
               " mm, σ = " + four_digits(job.surface_tension) + " N/m, θ = " + four_digits(job.contact_angle) +
               "°, law " + job.law;
  return p;
}

/// The stress of the bridges against saturation.
inline void plot_strength(const std::filesystem::path& path, const pendular_scene& scene, const pendular_results& all,
                          const pendular_job& job) {
  plot p = titled("Capillary strength", scene, job);
  double wettest = 0;
  double strongest = 0;
  for (const pendular_state& s : all.states) {
    wettest = std::max(wettest, scene.saturation(s));
    strongest = std::max({strongest, s.stress[0], s.stress[1], s.stress[2], s.rumpf});
  }
  const double unit = strongest >= 5000 ? 1000 : 1;
  p.x_label = "saturation S [–]";
  p.y_label = std::string("tensile stress [") + (unit > 1 ? "kPa]" : "Pa]");
  const pendular_state* limit = all.pendular_limit();
  const bool touching = limit != nullptr && limit != &all.states.front();
  p.x_end = wettest > 0 ? std::min(1.05 * wettest, touching ? 4 * scene.saturation(*limit) : 1.05 * wettest) : 1;
  p.y_end = strongest > 0 ? 1.5 * strongest / unit : 1;  // the legend lies above the curves
  const auto against_saturation = [&](curve c, const auto& value) {
    for (const pendular_state& s : all.states) {
      c.x.push_back(scene.saturation(s));
      c.y.push_back(value(s) / unit);
    }
    p.curves.push_back(std::move(c));
  };
  const std::array<const char*, 3> names{"of the bridges, xx", "of the bridges, yy", "of the bridges, zz"};
  const std::array<const char*, 3> colours{"#9dc3e6", "#7fb8a4", "#c9a6d8"};
  for (std::size_t k = 0; k < 3; ++k) {
    against_saturation({names[k], {}, {}, colours[k], "", false, 1.3},
                       [k](const pendular_state& s) { return s.stress[k]; });
  }
  against_saturation({"of the bridges, mean", {}, {}, "#2b6cb0", "", false, 2.5},
                     [](const pendular_state& s) { return s.mean_stress(); });
  against_saturation({"Rumpf", {}, {}, "#d9534f", "6 4", false, 1.8}, [](const pendular_state& s) { return s.rumpf; });
  if (touching) {
    p.marks.push_back(
        {scene.saturation(*limit), "bridges touch to the right of S = " + four_digits(scene.saturation(*limit))});
  }
  write_svg(path, p);
}

/// How much liquid the bridges hold, against what they have in common.
inline void plot_content(const std::filesystem::path& path, const pendular_scene& scene, const pendular_results& all,
                         const pendular_job& job) {
  plot p = titled("Pendular liquid", scene, job);
  const bool by_suction = job.held == control::suction;
  const pendular_state* limit = all.pendular_limit();
  const bool touching = limit != nullptr && limit != &all.states.front();
  curve c{"all bridges", {}, {}, "#2b6cb0", "", false, 2.5};
  double most = 0;
  double wettest = 0;
  for (const pendular_state& s : all.states) {
    most = std::max(most, s.held);
    wettest = std::max(wettest, scene.saturation(s));
  }
  most = by_suction && touching ? std::min(1.05 * most, 5 * limit->held) : 1.05 * most;
  const double unit = !by_suction ? 1e-9 : most >= 5000 ? 1000 : 1;
  for (const pendular_state& s : all.states) {
    c.x.push_back(s.held / unit);
    c.y.push_back(scene.saturation(s));
  }
  if (touching) {
    p.marks.push_back({limit->held / unit, ""});
    c.name += by_suction ? "; left of the line they touch" : "; right of the line they touch";
  }
  p.curves.push_back(std::move(c));
  p.x_label = !by_suction ? "volume of a bridge [mm³]" : unit > 1 ? "suction [kPa]" : "suction [Pa]";
  p.y_label = "saturation S [–]";
  p.x_end = most / unit;
  p.y_end = wettest > 0 ? 1.15 * wettest : 1;
  write_svg(path, p);
}

/// Writes states.csv, bridges.csv, bridges.vtp, grains.vtp, strength.svg and content.svg.
inline void write_pendular(const pendular_job& job, const pendular_scene& scene, const pendular_results& all,
                           const bridge_law_of_the_job& law) {
  std::filesystem::create_directories(job.out);
  write_states(job.out / "states.csv", scene, all, job.held);
  write_bridges(job.out / "bridges.csv", scene, all.last);
  write_tubes(job.out / "bridges.vtp", scene, all.last, law, job.held, job.steps.back());
  tp::io::write_grains(job.out / "grains.vtp", scene.packing.grains, {});
  plot_strength(job.out / "strength.svg", scene, all, job);
  plot_content(job.out / "content.svg", scene, all, job);
}

/// The table of the steps, then keys: what says nothing else is of the last step, the driest.
inline void print_pendular(const pendular_scene& scene, const pendular_results& all, const pendular_job& job,
                           const bridge_tables* tables, const pendular_seconds& spent) {
  using enum tp::bridge_status;
  std::printf("%14s %9s %9s %11s %12s %14s %14s\n", job.held == control::suction ? "suction[Pa]" : "volume[m3]",
              "bridges", "ruptured", "overlapping", "S", "stress[Pa]", "Rumpf[Pa]");
  for (const pendular_state& s : all.states) {
    std::printf("%14.6g %9zu %9zu %11zu %12.6g %14.6g %14.6g\n", s.held, s.formed(), s.ruptured(), s.overlapping,
                scene.saturation(s), s.mean_stress(), s.rumpf);
  }
  const key_printer say;
  const pendular_state& last = all.states.back();
  const pendular_state* limit = all.pendular_limit();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  say("grains", scene.packing.grains.size());
  say("porosity", scene.void_volume / scene.box_volume());
  say("reach", scene.reach);
  say("pairs", scene.pairs.size());
  say("pairs_in_overlap", scene.pairs_in_overlap());
  say("tables", tables == nullptr ? std::size_t{0} : tables->size());
  say("pairs_without_table", tables == nullptr ? std::size_t{0} : scene.pairs.size() - tables->covered());
  say("table_error", tables == nullptr ? nan : tables->error());
  say("steps", all.states.size());
  say("bridges", last.formed());
  say("ruptured", last.ruptured());
  say("refused_flooded", last.of(flooded));
  say("refused_not_covered", last.of(not_covered));
  say("refused_invalid_input", last.of(invalid_input));
  say("refused_not_converged", last.of(not_converged));
  say("overlapping", last.overlapping);
  say("liquid_volume", last.liquid_volume);
  say("liquid_content", last.liquid_volume / scene.box_volume());
  say("saturation", scene.saturation(last));
  say("mean_force", last.mean_force);
  const std::array<const char*, 6> names{"stress_xx", "stress_yy", "stress_zz", "stress_yz", "stress_xz", "stress_xy"};
  for (std::size_t k = 0; k < 6; ++k) {
    say(names[k], last.stress[k]);
  }
  say("mean_stress", last.mean_stress());
  say("rumpf_strength", last.rumpf);
  say("wettest_saturation", scene.saturation(all.states.front()));
  say("wettest_overlapping", all.states.front().overlapping);
  say("pendular_limit_saturation", limit == nullptr ? nan : scene.saturation(*limit));
  say("pendular_limit_volume", limit == nullptr ? nan : limit->liquid_volume);
  say("seconds_read", spent.read);
  say("seconds_pairs", spent.pairs);
  say("seconds_tables", spent.tables);
  say("seconds_laws", all.seconds_laws);
  say("seconds_states", spent.states - all.seconds_laws - all.seconds_last);
  say("seconds_write", spent.write);
  say("ns_per_pair", all.asked > 0 ? 1e9 * all.seconds_laws / static_cast<double>(all.asked) : nan);
  say("ns_per_bridge", last.formed() > 0 ? 1e9 * all.seconds_last / static_cast<double>(last.formed()) : nan);
  say("peak_rss_mb", peak_rss_mb());
}

}  // namespace support
