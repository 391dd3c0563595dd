// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/bridge/young_laplace.hpp"
#include "tetrapore/lbm/calibration.hpp"
#include "tetrapore/lbm/contact_angle.hpp"
#include "tetrapore/lbm/wall_shift.hpp"

#include <optional>

/// \file
/// A liquid bridge between two equal grains, one eighth of it between mirrors: the force that it pulls with and its
/// suction, beside the exact law.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// Two grains on the z axis. \par Units  lattice units but where said
struct pendular_set_up {
  calibrated_mixture mixture{};
  double radius = 24;                  ///< of the grains [nodes]
  double gap = 0;                      ///< between them, in radii
  double suction = 0.5;                ///< that it is to end at, × radius/σ: its volume is changed until it does
  double contact_angle = 0;            ///< [rad]
  std::optional<double> retraction{};  ///< nodes by which grains shrink; none: what plates say (wall_shift.hpp)
  int margin = 10;                     ///< nodes beyond the bridge
  double near = 0.05;                  ///< by how much the suction may differ from what is asked for
  rest_options rest{1000, 3e-4, 3, 60000};
};

/// What a bridge shows, and what the law says of it at the same suction.
/// \par Units  σ and radius: suction × radius/σ, force/(σ radius), volume/radius³
struct pendular_result {
  double radius = 0;  ///< of the grains [nodes]
  double suction = 0;
  double force = 0;      ///< through the plane between the grains, momentum counted link by link
  double volume = 0;     ///< of the liquid, the film on the grains included
  double neck = 0;       ///< radius of the neck
  double law_force = 0;  ///< at the suction
  double law_volume = 0;
  double law_neck = 0;
  double retraction = 0;  ///< nodes by which the grains shrank
  double tension = 0;     ///< σ at these densities
  double dry = 0;         ///< share of the grains' outer nodes that have no neighbour in which liquid outweighs gas
  rest_report rest;
  bridge_status law = bridge_status::ok;
};

/// The force over σ and radius. Its error from 16 nodes on is the largest that was found at G = 1.8, 4.7 %
/// (docs/lattice_calibration.md).
[[nodiscard]] inline measurement measured(const pendular_result& r) noexcept {
  return at_rest(r.force, r.rest, r.radius < 16 ? quiet_nan<double> : 0.05);
}
static_assert(experiment_result<pendular_result>);

/// Lets a bridge come to rest at a suction: bridges of one suction, unlike those of one volume, films and adsorbed
/// liquid included, have one shape at every resolution.
///
/// Walls of 0 < θ < 90° repel the liquid, and unevenly where the gap widens outward: its pressure falls from the
/// middle to the meniscus by some 0.1 σ/R, at any resolution. So the suction is taken beside the meniscus. The force
/// is the momentum that passes the plane between the grains, by populations and by bonds: no integral of an
/// interface. The law is asked for the force at the suction that the fluids show; σ is that of their densities.
/// \par Domain  a bridge that the law knows; a volume for which its neck and its contact line are resolved. One that
///              rests beside the suction or the density asked for ends as `missed`; all values are those it has there
template <class Forcing = velocity_shift, std::floating_point T = float>
[[nodiscard]] pendular_result pendular_bridge(const pendular_set_up& o) {
  using fluids = mixture<d3q19, bgk, Forcing>;
  using stencil = d3q19;
  pendular_result b;
  b.radius = o.radius;
  const young_laplace<> law{
      .surface_tension = 1.0, .contact_angle1 = o.contact_angle, .contact_angle2 = o.contact_angle};
  const edge<double> pair{1, 1, o.gap, {0, 0, 1}};
  const auto start = law.bridge(pair, given_suction<double>{o.suction});
  b.law = start.reason;
  if (!start.ok()) {
    b.rest.end = hold_end::dissolved;
    return b;
  }
  // a film on a grain has the pressure of the gas less that of its own curvature, 2 σ/R, and of the suction
  const double film = film_shift(o.radius / (o.suction + 2));
  b.retraction = o.retraction.value_or(o.contact_angle > 0 ? wall_shift : film);
  const double half_gap = o.radius * o.gap / 2;
  const double contact = o.radius * std::sin(start.value.filling1);
  const double top = half_gap + o.radius * (1 - std::cos(start.value.filling1));
  const double neck = o.radius * start.value.neck;
  const int side = static_cast<int>(std::max(contact, neck)) + o.margin;
  const int height = static_cast<int>(top) + o.margin;
  const double centre = half_gap + o.radius;

  const auto model = repelling_pair<fluids>(o.mixture.attraction, o.mixture.tau);
  const coexistence phases{o.mixture.attraction, o.mixture.factor, (o.mixture.factor - 1) / 2, o.mixture.main};
  const auto rho = reservoirs(phases, start.value.suction * o.mixture.flat_tension / o.radius);
  if (!rho.ok()) {
    b.rest.end = hold_end::dissolved;
    return b;
  }
  constexpr face_kind mirror = face_kind::mirror;
  const auto solid = [&](int x, int y, int z) {
    const double r = o.radius - b.retraction;
    const double dz = z + 0.5 - centre;
    return (x + 0.5) * (x + 0.5) + (y + 0.5) * (y + 0.5) + dz * dz < r * r;
  };
  simulation<fluids, T> s(
      model, {{{side, side, height}, {mirror, mirror, mirror}, {mirror, mirror, mirror}}, [&](int x, int y, int z) {
                return site{solid(x, y, z) ? site_kind::solid : site_kind::fluid, 0};
              }});
  s.set_wall(0, wall_of_wettability(o.mixture.main, o.mixture.dissolved, wettability(o.mixture, o.contact_angle)));
  const auto& map = s.sites();
  const auto corner = static_cast<std::size_t>(map.node_at(side - 1, side - 1, 0));
  // where the gap is wide and the meniscus far
  const int inner = static_cast<int>(0.3 * neck);
  if (map.node_at(inner, inner, 0) < 0 || map.node_at(side - 1, side - 1, 0) < 0) {
    throw parameter_error("bridge", "a gap of " + short_number(2 * half_gap) + " nodes", "one with a node in it");
  }
  const auto middle = static_cast<std::size_t>(map.node_at(inner, inner, 0));
  struct plane_node {
    std::size_t node;
    double across;  // from the axis
  };
  std::vector<plane_node> plane;  // between the grains
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      if (const auto n = map.node_at(x, y, 0); n >= 0) {
        plane.push_back({static_cast<std::size_t>(n), std::hypot(x + 0.5, y + 0.5)});
      }
    }
  }
  double mean_main = o.mixture.main;
  const auto look = [&]() -> double {
    const auto gas = s.densities_at(corner);
    const auto liquid = s.densities_at(middle);
    if (!std::isfinite(gas[0] + gas[1] + liquid[0] + liquid[1])) {
      return quiet_nan<double>;
    }
    if (!(gas[0] > gas[1]) || !(liquid[1] > liquid[0])) {
      return 0;
    }
    double disc = 0;
    for (const auto& at : plane) {
      const auto here = s.densities_at(at.node);
      disc += (gas[0] - gas[1] - here[0] + here[1]) / (gas[0] - gas[1] - liquid[0] + liquid[1]);
    }
    b.neck = std::sqrt(4 * disc / pi<double>) / o.radius;
    const double clear = std::max(b.neck * o.radius - 2 * o.mixture.width, 1.0);
    const double outside = model.pressure(gas);
    double pull = 0;
    double beside = 0;  // pressure of the liquid next to the meniscus, clear of it by two widths
    int nodes = 0;
    for (const auto& at : plane) {
      const auto here = s.densities_at(at.node);
      if (at.across <= clear && at.across > clear - o.mixture.width) {
        beside += model.pressure(here);
        ++nodes;
      }
      double stress = 0;
      for (std::size_t i = 0; i < fluids::directions; ++i) {
        if (stencil::velocity[i][2] != 1) {
          continue;
        }
        for (std::size_t c = 0; c < 2; ++c) {  // what comes from the image, and as much goes there
          stress += 2 * (static_cast<double>(s.population(c, at.node, i)) + stencil::weight[i] * model.reference[c]);
        }
        const auto beyond = map.seen(at.node, opposite(static_cast<int>(i))).node;
        stress += detail::bond(model, i, here, s.densities_at(static_cast<std::size_t>(beyond)));
      }
      pull += outside - stress;
    }
    mean_main = (gas[0] + liquid[1]) / 2;
    b.tension = surface_tension(o.mixture, mean_main);
    b.suction = (outside - beside / nodes) * o.radius / b.tension;
    b.force = 4 * pull / (b.tension * o.radius);
    return b.force * b.neck;  // near its largest the force hardly moves with the bridge
  };
  // walls repel both components and films hold some of one: what is laid is shifted until the bulk has the densities
  // of the calibration and the suction is that asked for
  reservoir_pair laid = rho.value;
  bool met = false;
  double volume = start.value.volume;
  for (int turn = 0; turn < 8; ++turn) {
    const auto shape = law.bridge(pair, given_volume<double>{volume});
    if (!shape.ok()) {
      b.law = shape.reason;
      b.rest.end = hold_end::dissolved;
      return b;
    }
    const double rim = o.radius * std::sin(shape.value.filling1);
    const double waist = o.radius * shape.value.neck;
    const double rise = half_gap + o.radius * (1 - std::cos(shape.value.filling1));
    lay_interface(s, laid, [&](const std::array<int, 3>& p) {
      const double across = std::hypot(p[0] + 0.5, p[1] + 0.5);
      const double along = std::min((p[2] + 0.5) / rise, 1.5);
      const double outside = across - (waist + (rim - waist) * along * along);
      const double above = std::hypot(across, p[2] + 0.5 - centre) - o.radius + b.retraction;
      return o.contact_angle > 0 ? outside : std::min(outside, above - 0.8 * film);
    });
    const bool first = turn == 0;
    rest_options wait = o.rest;
    wait.still *= first ? 5 : 1;
    const rest_report r = rest(s, wait, look);
    b.rest = {r.change, b.rest.steps + r.steps, b.rest.updates + r.updates, r.end};
    const double miss = o.mixture.main - mean_main;
    const bool near = std::abs(b.suction - o.suction) < o.near && std::abs(miss) < 0.005 * o.mixture.main;
    met = near && !first;
    const auto found = law.bridge(pair, given_suction<double>{b.suction});
    if (r.end != hold_end::stable || met || !found.ok()) {
      break;
    }
    laid.gas[0] += miss;
    laid.liquid[1] += miss;
    volume = std::max(volume + start.value.volume - found.value.volume, start.value.volume / 3);
  }
  if (b.rest.end != hold_end::stable) {
    return b;
  }
  b.rest.end = met ? hold_end::stable : hold_end::missed;
  const auto gas = s.densities_at(corner);
  const auto liquid = s.densities_at(middle);
  for (std::size_t n = 0; n < map.size(); ++n) {
    const auto here = s.densities_at(n);
    b.volume += (gas[0] - gas[1] - here[0] + here[1]) / (gas[0] - gas[1] - liquid[0] + liquid[1]);
  }
  double outer = 0;
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      for (int z = 0; z < height; ++z) {
        bool beside = false;
        bool wet = false;
        for (std::size_t i = 1; i < fluids::directions && solid(x, y, z); ++i) {
          const std::array<int, 3> p{x + stencil::velocity[i][0], y + stencil::velocity[i][1],
                                     z + stencil::velocity[i][2]};
          const bool inside = p[0] >= 0 && p[0] < side && p[1] >= 0 && p[1] < side && p[2] >= 0 && p[2] < height;
          const auto n = inside ? map.node_at(p[0], p[1], p[2]) : site_map<stencil>::none;
          if (n != site_map<stencil>::none) {
            const auto here = s.densities_at(static_cast<std::size_t>(n));
            beside = true;
            wet = wet || here[1] > here[0];
          }
        }
        outer += beside ? 1 : 0;
        b.dry += beside && !wet ? 1 : 0;
      }
    }
  }
  b.dry /= outer;
  b.volume *= 8 / (o.radius * o.radius * o.radius);
  const auto same_suction = law.bridge(pair, given_suction<double>{b.suction});
  b.law = same_suction.reason;
  if (same_suction.ok()) {
    b.law_force = same_suction.value.force;
    b.law_volume = same_suction.value.volume;
    b.law_neck = same_suction.value.neck;
  }
  return b;
}

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
