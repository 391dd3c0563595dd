// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/flat_interface.hpp"

#include <algorithm>
#include <numbers>

/// \file
/// A ball of one component in the other, one eighth of it between mirrors: surface tension by Laplace's law.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// Whose main density is asked for: pressure inside a ball is higher, and with it the density.
enum class main_of : std::uint8_t { inside, outside, mean };

/// A ball of component 0. \par Units  lattice units
struct laplace_set_up {
  double attraction = 1.8;  ///< G
  double tau = 1;
  double radius = 18;  ///< to start from; the ball settles half a node or so beside it
  int half_box = 36;   ///< nodes from the ball's middle to the mirror between it and its image
  double main = 1;     ///< main density that is sought
  main_of where = main_of::mean;
  double tension = 0;       ///< a guess of σ: the densities to start from balance it
  double tolerance = 5e-4;  ///< of `main`
  rest_options rest{500, 2e-4, 2, 40000};
};

/// What a ball shows. The two radii differ by half the gap between the components' surfaces, about .45 nodes at
/// G = 1.8: σ by one differs from σ by the other by that over R, and both end at the flat interface.
/// \par Units  lattice units
struct laplace_result {
  double tension = 0;               ///< by the radius of the volume in which component 0 outweighs the other
  double radius = 0;                ///< as between: of Σ (ρ0 − ρ1), which treats both components alike
  double tension_of_one = 0;        ///< by the radius of component 0 alone
  double radius_of_one = 0;         ///< of Σ ρ0
  std::array<double, 2> inside{};   ///< densities in the middle
  std::array<double, 2> outside{};  ///< and in the corner
  double width = 0;                 ///< from 10 to 90 %
  double spurious = 0;              ///< highest velocity of a node
  double out_of_round = 0;          ///< how the radius differs along axis and diagonal, relative: what the lattice does
  rest_report rest;
};

/// σ; the error of the lattice is taken to be that of the roundest place.
[[nodiscard]] inline measurement measured(const laplace_result& r) noexcept {
  return at_rest(r.tension, r.rest, std::abs(r.out_of_round));
}
static_assert(experiment_result<laplace_result>);

namespace detail {

/// Half-level radius of component 0 on the ray from the middle along (1, 1, 1) or an axis.
template <class Simulation>
[[nodiscard]] double ray_radius(const Simulation& s, bool diagonal, double level) {
  constexpr int axes = Simulation::lattice_type::dimensions;
  const int n = s.sites().box().size[0];
  std::vector<double> profile(static_cast<std::size_t>(n));
  for (int k = 0; k < n; ++k) {
    const int other = diagonal ? k : 0;
    profile[static_cast<std::size_t>(k)] =
        s.density(0, static_cast<std::size_t>(s.sites().node_at(k, other, axes == 3 ? other : 0)));
  }
  const double along = falls_below(profile, level) + 0.5;
  return diagonal ? std::sqrt(static_cast<double>(axes)) * along : std::hypot(along, 0.5, axes == 3 ? 0.5 : 0.0);
}

}  // namespace detail

/// Lets a ball come to rest and measures it; two-dimensional lattices take a disc.
///
/// σ follows the densities (about as the 2.5th power of the main one at G = 1.8), and Laplace's pressure moves them, so
/// σ(R) depends on whose density is kept. With the mean of both main densities kept, and the radius that treats the
/// components alike, σ hardly depends on R. Where the main density is not within `tolerance` after being laid eight
/// times the end is `missed`.
/// \par Units     lattice units
/// \par Domain    a radius of 4 nodes or more, a box of 4 nodes more than it
/// \tparam T      float or double
template <class Model = mixture<d3q19, bgk>, std::floating_point T = float>
[[nodiscard]] laplace_result laplace(const laplace_set_up& o) {
  constexpr int axes = Model::lattice_type::dimensions;
  if (!(o.radius >= 4) || !(o.half_box >= o.radius + 4) || !(o.tolerance > 0)) {
    throw parameter_error("ball", "radius " + short_number(o.radius) + " in " + std::to_string(o.half_box) + " nodes",
                          "4 nodes or more, and 4 beyond");
  }
  const auto model = repelling_pair<Model>(o.attraction, o.tau);
  const int n = o.half_box;
  constexpr face_kind mirror = face_kind::mirror;
  constexpr face_kind third = axes == 3 ? mirror : face_kind::periodic;
  simulation<Model, T> s(model, {{{n, n, axes == 3 ? n : 1}, {mirror, mirror, third}, {mirror, mirror, third}},
                                 [](int, int, int) { return site{}; }});
  const auto middle = static_cast<std::size_t>(s.sites().node_at(0, 0, 0));
  const auto corner = static_cast<std::size_t>(s.sites().node_at(n - 1, n - 1, axes == 3 ? n - 1 : 0));
  const double factor = weak_force_factor(model);
  const double gas_share = o.where == main_of::inside ? 0.0 : o.where == main_of::outside ? 1.0 : 0.5;
  const auto first =
      reservoirs({o.attraction, factor, (factor - 1) / 2, o.main}, (axes - 1) * o.tension / o.radius, gas_share);
  laplace_result b;
  if (!first.ok()) {
    b.rest.end = hold_end::dissolved;
    return b;
  }
  reservoir_pair start = first.value;

  const auto look = [&] {
    b.inside = s.densities_at(middle);
    b.outside = s.densities_at(corner);
    const double inside = b.inside[0] - b.inside[1];
    const double outside = b.outside[0] - b.outside[1];
    if (!(inside > 0.01) || !(outside < -0.01)) {
      return std::isfinite(inside + outside) ? 0 : quiet_nan<double>;
    }
    double both = 0;
    double one = 0;
    for (std::size_t k = 0; k < s.sites().size(); ++k) {
      const auto rho = s.densities_at(k);
      both += (rho[0] - rho[1] - outside) / (inside - outside);
      one += (rho[0] - b.outside[0]) / (b.inside[0] - b.outside[0]);
    }
    const auto radius_of = [&](double volume) {
      return axes == 3 ? std::cbrt(6 * volume / std::numbers::pi) : std::sqrt(4 * volume / std::numbers::pi);
    };
    b.radius = radius_of(both);
    b.radius_of_one = radius_of(one);
    const double jump = model.pressure(b.inside) - model.pressure(b.outside);
    b.tension = b.radius * jump / (axes - 1);
    b.tension_of_one = b.radius_of_one * jump / (axes - 1);
    return b.tension;
  };
  const auto main_density = [&] {
    return o.where == main_of::inside    ? b.inside[0]
           : o.where == main_of::outside ? b.outside[1]
                                         : (b.inside[0] + b.outside[1]) / 2;
  };
  double more = 0;   // main density laid beyond that of the first turn
  double slope = 1;  // of the main density found, by it, with the same dissolved densities
  double last_more = 0;
  double last_miss = 0;
  for (int turn = 0; turn < 8; ++turn) {
    lay_interface(s, start, [&](const std::array<int, 3>& p) {
      return o.radius - std::hypot(p[0] + 0.5, p[1] + 0.5, axes == 3 ? p[2] + 0.5 : 0);
    });
    const rest_report r = rest(s, o.rest, look);
    b.rest = {r.change, b.rest.steps + r.steps, b.rest.updates + r.updates, r.end};
    const double miss = o.main - main_density();
    if (r.end != hold_end::stable || std::abs(miss) < o.tolerance) {
      break;
    }
    b.rest.end = hold_end::missed;
    if (turn == 0) {
      start = {{start.gas[0], b.inside[1]}, {b.outside[0], start.liquid[1]}};
    } else if (turn > 1) {
      slope = std::clamp((last_miss - miss) / (more - last_more), 0.2, 5.0);
    }
    last_more = more;
    last_miss = miss;
    more += miss / slope;
    start.gas[0] += more - last_more;
    start.liquid[1] += more - last_more;
  }
  if (b.rest.end != hold_end::stable && b.rest.end != hold_end::missed) {
    return b;
  }
  std::vector<double> profile;
  for (int k = 0; k < n; ++k) {
    profile.push_back(s.density(0, static_cast<std::size_t>(s.sites().node_at(k, 0, 0))));
  }
  b.width = detail::width_of(profile);
  const double level = (b.inside[0] + b.outside[0]) / 2;
  b.out_of_round = (detail::ray_radius(s, true, level) - detail::ray_radius(s, false, level)) / b.radius;
  for (std::size_t k = 0; k < s.sites().size(); ++k) {
    const auto u = s.velocity(k);
    b.spurious = std::max(b.spurious, std::hypot(u[0], u[1], u[2]));
  }
  return b;
}

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
