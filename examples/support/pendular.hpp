// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bridge_choices.hpp"
#include "stopwatch.hpp"

#include "tetrapore/geometry/ball_volume.hpp"
#include "tetrapore/packing/close_edges.hpp"
#include "tetrapore/packing/statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

/// \file
/// A packing with a bridge on every close pair that can hold one.

namespace support {

/// What all bridges have in common at a step.
enum class control : std::uint8_t { suction, volume };

inline constexpr std::size_t bridge_status_count = 8;

/// What all bridges of one step come to.
struct pendular_state {
  double held = 0;                                       ///< suction [Pa] or volume of a bridge [m³]
  std::array<std::size_t, bridge_status_count> count{};  ///< by status
  std::size_t overlapping = 0;                           ///< bridges that touch another one
  double liquid_volume = 0;                              ///< [m³], as if bridges did not touch
  double mean_force = 0;                                 ///< [N]
  std::array<double, 6> stress{};  ///< (1/V) Σ F n ⊗ l: xx, yy, zz, yz, xz, xy [Pa], positive where bridges pull
  double rumpf = 0;                ///< strength by Rumpf's formula [Pa]

  [[nodiscard]] std::size_t of(tp::bridge_status s) const { return count[static_cast<std::size_t>(s)]; }
  [[nodiscard]] std::size_t formed() const { return of(tp::bridge_status::ok); }
  [[nodiscard]] std::size_t ruptured() const {
    return of(tp::bridge_status::ruptured) + of(tp::bridge_status::lopsided) + of(tp::bridge_status::no_liquid);
  }
  [[nodiscard]] double mean_stress() const { return (stress[0] + stress[1] + stress[2]) / 3; }
};

/// What the bridges hang in.
struct pendular_scene {
  tp::packing packing;
  tp::domain region;
  double reach = 0;                   ///< the widest gap of the list [m]
  std::vector<tp::close_edge> pairs;  ///< all with a smaller gap
  double void_volume = 0;             ///< of the box [m³]

  [[nodiscard]] double box_volume() const { return region.bounds.volume(); }
  [[nodiscard]] double saturation(const pendular_state& s) const { return s.liquid_volume / void_volume; }
  [[nodiscard]] std::size_t pairs_in_overlap() const {
    return static_cast<std::size_t>(std::count_if(
        pairs.begin(), pairs.end(), [](const tp::close_edge& e) { return e.shape.gap < -1e-12 * e.shape.radius1; }));
  }
};

/// Void of the box: less the balls inside its walls, overlaps of two counted once. Exact unless three grains overlap in
/// one place or two overlap beyond a wall.
[[nodiscard]] inline double void_volume_of(const tp::packing& packing, const tp::domain& region) {
  double solid = 0;
  for (const auto& g : packing.grains) {
    solid += tp::ball_volume(g.radius) - tp::protruding_volume(g, region);
  }
  tp::for_each_close_pair(packing, 0, [&](const tp::close_pair& p, const tp::vec3<double>& apart) {
    solid -= tp::lens_volume(packing.grains[p.i].radius, packing.grains[p.j].radius, norm(apart));
  });
  return region.bounds.volume() - solid;
}

/// Calls f(given) with the volume or the suction of a step.
template <class Law, class F>
auto with_given(control held, double value, const F& f) {
  if constexpr (takes_suction<Law>) {
    if (held == control::suction) {
      return f(tp::given_suction<double>{value});
    }
  }
  return f(tp::given_volume<double>{value});
}

namespace detail {

/// A gap that no bridge of this law spans, whatever the radii of the packing: a fifth wider than the widest that one
/// does, among pairs of radii from the smallest to the largest, each a quarter above the one before, and a wall.
template <class Law, class Given>
[[nodiscard]] double reach_of(const Law& law, const tp::radius_range& radii, const Given& given) {
  constexpr double plane = std::numeric_limits<double>::infinity();
  constexpr double ratio = 1.1;
  std::vector<double> rungs;
  for (double r = radii.smallest; r < radii.largest; r *= 1.25) {
    rungs.push_back(r);
  }
  rungs.push_back(radii.largest);
  const std::size_t grains = rungs.size();
  rungs.push_back(plane);
  double reach = 0;
  for (std::size_t i = 0; i < grains; ++i) {
    for (std::size_t j = i; j < rungs.size(); ++j) {
      // only gaps wider than what is known already
      for (double gap = std::max(1e-6 * radii.smallest, reach); gap < 20 * radii.largest; gap *= ratio) {
        if (law.bridge(tp::edge<double>{rungs[i], rungs[j], gap, {1, 0, 0}}, given).ok()) {
          reach = gap * ratio;
        }
      }
    }
  }
  return reach * ratio;
}

/// Counts the bridges whose contact line meets that of another one on the same grain, or on the same wall.
[[nodiscard]] inline std::size_t overlapping_bridges(const pendular_scene& scene, std::span<const bridge_answer> all) {
  struct footprint {
    std::size_t bridge;
    tp::vec3<double> towards;  ///< from the centre of the grain
    double half_angle;
  };
  const auto& grains = scene.packing.grains;
  std::vector<std::vector<footprint>> on(grains.size());
  std::vector<std::array<std::size_t, 6>> on_wall(grains.size());  ///< index of the bridge to each wall, plus one
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].reason == tp::bridge_status::ok) {
      const tp::close_edge& e = scene.pairs[i];
      const auto half = [](double contact, double radius) { return std::asin(std::min(1.0, contact / radius)); };
      on[e.key.a.index()].push_back({i, e.shape.normal, half(all[i].contact1, e.shape.radius1)});
      if (e.key.b.is_wall()) {
        on_wall[e.key.a.index()][static_cast<std::size_t>(e.key.b.wall())] = i + 1;
      } else {
        on[e.key.b.grain().index()].push_back({i, -e.shape.normal, half(all[i].contact2, e.shape.radius2)});
      }
    }
  }
  std::vector<char> touches(all.size(), 0);
  for (const auto& prints : on) {
    for (std::size_t i = 0; i < prints.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double between = std::acos(std::clamp(dot(prints[i].towards, prints[j].towards), -1.0, 1.0));
        if (between < prints[i].half_angle + prints[j].half_angle) {
          touches[prints[i].bridge] = touches[prints[j].bridge] = 1;
        }
      }
    }
  }
  for (const tp::close_edge& e : scene.pairs) {  // on a wall only feet of neighbours can meet
    if (e.key.b.is_wall()) {
      continue;
    }
    for (const tp::face wall : tp::all_faces) {
      const std::size_t a = on_wall[e.key.a.index()][static_cast<std::size_t>(wall)];
      const std::size_t b = on_wall[e.key.b.grain().index()][static_cast<std::size_t>(wall)];
      if (a != 0 && b != 0) {
        tp::vec3<double> apart = e.branch;
        apart[axis_of(wall)] = 0;
        if (norm(apart) < all[a - 1].contact2 + all[b - 1].contact2) {
          touches[a - 1] = touches[b - 1] = 1;
        }
      }
    }
  }
  return static_cast<std::size_t>(std::count(touches.begin(), touches.end(), 1));
}

}  // namespace detail

/// The pairs on which bridges can hang from the first step on, the wettest.
[[nodiscard]] inline pendular_scene make_scene(tp::packing packing, const bridge_law_of_the_job& law, control held,
                                               double first) {
  pendular_scene scene;
  scene.packing = std::move(packing);
  scene.region = domain_of(scene.packing);
  scene.void_volume = void_volume_of(scene.packing, scene.region);
  const tp::radius_range radii = tp::radii_of(scene.packing.grains);
  scene.reach = std::visit(
      [&]<class Law>(const Law& l) {
        return with_given<Law>(held, first, [&](const auto& given) { return detail::reach_of(l, radii, given); });
      },
      law);
  scene.pairs = tp::close_edges(scene.packing.grains, scene.region, scene.reach);
  return scene;
}

/// The bridge of every pair.
struct answers {
  std::vector<bridge_answer> of_pair;
  std::size_t asked = 0;  ///< times that the law was
  double seconds = 0;     ///< that it took
};

/// The bridges of a step after those of the one before, which was wetter: a bridge that has let go stays so.
/// \param before  empty for the first step
[[nodiscard]] inline answers ask(const pendular_scene& scene, const bridge_law_of_the_job& law, control held,
                                 double value, std::span<const bridge_answer> before) {
  const auto is_gone = [](const bridge_answer& b) { return verdict_of(b.reason) == tp::verdict::absent; };
  answers all;
  all.of_pair.assign(before.begin(), before.end());
  all.of_pair.resize(scene.pairs.size());
  stopwatch watch;
  std::visit(
      [&]<class Law>(const Law& l) {
        with_given<Law>(held, value, [&](const auto& given) {
          for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
            if (before.empty() || !is_gone(before[i])) {
              all.of_pair[i] = bridge_of(l, scene.pairs[i].shape, given);
              ++all.asked;
            }
          }
        });
      },
      law);
  all.seconds = watch.lap();
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    stand_in_a_cylinder(scene.pairs[i].shape, all.of_pair[i]);
  }
  return all;
}

/// Seconds of the law for the bridges among these answers alone, asked once more.
[[nodiscard]] inline double seconds_of_bridges(const pendular_scene& scene, const bridge_law_of_the_job& law,
                                               control held, double value, std::span<const bridge_answer> known) {
  double pull = 0;
  stopwatch watch;
  std::visit(
      [&]<class Law>(const Law& l) {
        with_given<Law>(held, value, [&](const auto& given) {
          for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
            if (known[i].reason == tp::bridge_status::ok) {
              pull += bridge_of(l, scene.pairs[i].shape, given).force;
            }
          }
        });
      },
      law);
  const double spent = watch.lap();
  const volatile double used = pull;  // or the compiler may leave out the work
  static_cast<void>(used);
  return spent;
}

[[nodiscard]] inline pendular_state sum_up(const pendular_scene& scene, std::span<const bridge_answer> bridges,
                                           double held) {
  pendular_state s;
  s.held = held;
  double force = 0;
  double ends = 0;  // of bridges on grains
  for (std::size_t i = 0; i < bridges.size(); ++i) {
    const bridge_answer& b = bridges[i];
    ++s.count[static_cast<std::size_t>(b.reason)];
    if (b.reason != tp::bridge_status::ok) {
      continue;
    }
    const auto& [key, shape, branch] = scene.pairs[i];
    const tp::vec3<double> pull = b.force / scene.box_volume() * shape.normal;
    const std::array<double, 6> part{pull.x * branch.x, pull.y * branch.y, pull.z * branch.z,
                                     pull.y * branch.z, pull.x * branch.z, pull.x * branch.y};
    for (std::size_t k = 0; k < 6; ++k) {
      s.stress[k] += part[k];
    }
    force += b.force;
    s.liquid_volume += b.volume;
    ends += key.b.is_wall() ? 1 : 2;
  }
  if (s.formed() > 0) {
    s.mean_force = force / static_cast<double>(s.formed());
    const double diameter = 2 * tp::radii_of(scene.packing.grains).mean;
    const double solid_fraction = 1 - scene.void_volume / scene.box_volume();
    const double coordination = ends / static_cast<double>(scene.packing.grains.size());
    s.rumpf = solid_fraction * coordination * s.mean_force / (std::numbers::pi * diameter * diameter);
  }
  s.overlapping = detail::overlapping_bridges(scene, bridges);
  return s;
}

}  // namespace support
