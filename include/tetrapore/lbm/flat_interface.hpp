// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/rest.hpp"

#include <algorithm>
#include <vector>

/// \file
/// A flat interface on a row of nodes: coexistence densities and, from the stress across and along it, the exact
/// surface tension of a mixture on its lattice.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// A row of nodes, gas on its lower half. \par Units  lattice units
struct flat_set_up {
  double attraction = 1.8;  ///< G
  double tau = 1;
  double main = 1;          ///< density of each component in its own phase that is sought
  double tolerance = 1e-6;  ///< of `main`
  int nodes = 64;
  rest_options rest{1000, 1e-9, 2, 400000};
};

/// What a flat interface shows. \par Units  lattice units
struct flat_interface {
  double tension = 0;    ///< σ = Σ (P_normal − P_tangential)
  double main = 0;       ///< density of a component in its own phase
  double dissolved = 0;  ///< and in the other's
  double factor = 0;     ///< c: ln(main/dissolved) = c G (main − dissolved)
  double width = 0;      ///< from 10 to 90 % of a component's step [nodes]
  double pressure = 0;   ///< of both phases
  double residual = 0;   ///< how much the normal stress differs along the row, relative to the pressure
  rest_report rest;      ///< of all turns; `change` and `end` of the last
};

/// σ, of the lattice itself: no error of discretisation, by definition.
[[nodiscard]] inline measurement measured(const flat_interface& f) noexcept { return at_rest(f.tension, f.rest, 0); }
static_assert(experiment_result<flat_interface>);

namespace detail {

/// Where a falling profile passes a level, between the middles of nodes; −1 where it does not.
[[nodiscard]] inline double falls_below(const std::vector<double>& profile, double level) noexcept {
  for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
    if (profile[k] >= level && profile[k + 1] < level) {
      return static_cast<double>(k) + (profile[k] - level) / (profile[k] - profile[k + 1]);
    }
  }
  return -1;
}

/// 10-90 % width of a falling profile.
[[nodiscard]] inline double width_of(const std::vector<double>& profile) noexcept {
  const double low = profile.back();
  const double step = profile.front() - low;
  return falls_below(profile, low + 0.1 * step) - falls_below(profile, low + 0.9 * step);
}

/// What a bond in direction i between nodes of potentials psi and beyond carries: Σ G_ab w ψ_a ψ_b.
template <class Model>
[[nodiscard]] double bond(const Model& m, std::size_t i, const std::array<double, Model::components>& psi,
                          const std::array<double, Model::components>& beyond) noexcept {
  double sum = 0;
  for (std::size_t a = 0; a < Model::components; ++a) {
    for (std::size_t b = 0; b < Model::components; ++b) {
      sum += m.attraction[a][b] * psi[a] * beyond[b];
    }
  }
  return Model::lattice_type::weight[i] * sum;
}

}  // namespace detail

/// Lets a flat interface come to rest and measures it.
///
/// A step moves momentum in two ways, with populations between nodes and with the force along bonds. Both are counted,
/// plane by plane, so that at rest the normal stress is one number along the row and σ is that of the lattice, no
/// integral of a continuous profile. Where the main density is not within `tolerance` after being laid eight times the
/// end is `missed`.
/// \par Units     lattice units
/// \par Domain    mixtures of two components that part; collisions with one relaxation time for momentum
/// \par Accuracy  the normal stress is constant to 2e-12 of the pressure; σ agrees with bubbles in the limit of large R
/// \par Source    momentum balance of a step, derived here; bonds as in Shan, Phys. Rev. E 77, 066702 (2008)
template <class Model = mixture<d2q9, bgk>>
[[nodiscard]] flat_interface measure_flat_interface(const flat_set_up& o) {
  using stencil = typename Model::lattice_type;
  if (o.nodes < 16 || !(o.main > 0) || !(o.tolerance > 0)) {
    throw parameter_error("flat interface", std::to_string(o.nodes) + " nodes, main density " + short_number(o.main),
                          "16 nodes or more, a density and a tolerance above 0");
  }
  const auto model = repelling_pair<Model>(o.attraction, o.tau);
  const lattice_box box{{1, o.nodes, 1},
                        {face_kind::periodic, face_kind::mirror, face_kind::periodic},
                        {face_kind::periodic, face_kind::mirror, face_kind::periodic}};
  simulation<Model, double> s(model, {box, [](int, int, int) { return site{}; }});
  const auto size = static_cast<std::size_t>(o.nodes);
  const auto normal_stress = [&](std::size_t y) {  // between y and y + 1
    double p = 0;
    for (std::size_t i = 0; i < Model::directions; ++i) {
      const int across = stencil::velocity[i][1];
      for (std::size_t c = 0; across != 0 && c < 2; ++c) {
        p += static_cast<double>(s.population(c, across > 0 ? y + 1 : y, i)) + stencil::weight[i] * model.reference[c];
      }
    }
    return p;
  };
  const auto potentials = [&](std::size_t y) {
    auto psi = s.densities_at(y);
    for (double& x : psi) {
      x = model.potential(x);
    }
    return psi;
  };

  flat_interface f;
  double start = o.main;
  double factor = weak_force_factor(model);
  double slope = 1;  // of the main density found, by the one laid, with one c for what is dissolved
  double last_start = 0;
  double last_main = 0;
  for (int turn = 0; turn < 8; ++turn) {
    const auto dissolved = dissolved_density({o.attraction, factor, 0, start});
    if (!dissolved.ok()) {
      f.rest.end = hold_end::dissolved;
      return f;
    }
    const double other = dissolved.value;
    lay_interface(s, {{start, other}, {other, start}},
                  [&](const std::array<int, 3>& p) { return (o.nodes - 1) / 2.0 - p[1]; });
    const rest_report r = rest(s, o.rest, [&] {
      const auto at = s.densities_at(0);
      return at[0] > 1.001 * at[1] ? at[0] : at[0] - at[0];
    });
    f.rest = {r.change, f.rest.steps + r.steps, f.rest.updates + r.updates, r.end};
    if (r.end != hold_end::stable) {
      return f;
    }
    const auto gas = s.densities_at(0);
    f.main = gas[0];
    f.dissolved = gas[1];
    f.factor = std::log(gas[0] / gas[1]) / (o.attraction * (gas[0] - gas[1]));
    f.rest.end = std::abs(f.main - o.main) < o.tolerance ? hold_end::stable : hold_end::missed;
    if (f.rest.end == hold_end::stable) {
      break;
    }
    if (turn > 1) {
      slope = std::clamp((f.main - last_main) / (start - last_start), 0.2, 5.0);
    }
    last_start = start;
    last_main = f.main;
    factor = turn == 0 ? f.factor : factor;
    start += (o.main - f.main) / slope;
  }

  f.pressure = model.pressure({f.main, f.dissolved});
  double lowest = f.pressure;
  double highest = f.pressure;
  double along = 0;
  std::vector<double> profile(size);
  for (std::size_t y = 0; y < size; ++y) {
    profile[y] = s.density(0, y);
    const auto here = potentials(y);
    for (std::size_t i = 0; i < Model::directions; ++i) {
      const auto& v = stencil::velocity[i];
      for (std::size_t c = 0; v[0] != 0 && c < 2; ++c) {
        along += static_cast<double>(s.population(c, y, i)) + stencil::weight[i] * model.reference[c];
      }
      if (v[0] > 0) {
        along += detail::bond(model, i, here,
                              potentials(static_cast<std::size_t>(s.sites().seen(y, static_cast<int>(i)).node)));
      }
    }
    if (y + 1 < size) {
      double p = normal_stress(y);
      for (std::size_t i = 0; i < Model::directions; ++i) {
        p += stencil::velocity[i][1] > 0 ? detail::bond(model, i, here, potentials(y + 1)) : 0;
      }
      lowest = std::min(lowest, p);
      highest = std::max(highest, p);
    }
  }
  f.tension = f.pressure * o.nodes - along;
  f.residual = (highest - lowest) / f.pressure;
  f.width = detail::width_of(profile);
  return f;
}

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
