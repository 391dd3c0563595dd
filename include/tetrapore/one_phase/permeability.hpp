// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/one_phase/flow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

/// \file
/// Permeability of a packing: between two faces of its box, or the tensor of a periodic one.

namespace tetrapore::inline TETRAPORE_ABI {

namespace detail {
template <class Law>
concept has_viscosity = requires(const Law& law) { static_cast<double>(law.viscosity); };
}  // namespace detail

/// Permeability between two opposite faces that are held at different pressures: k = Q μ L / (A Δp), with the area and
/// length of the box, of the last solution.
/// The drop is that of the pressure that drives the flow: less what a fluid at rest has between the two faces.
/// \param viscosity  [Pa s], that of the conductance law
/// \return [m²]
/// \throw parameter_error  faces that are not opposite, or not held at two driving pressures; a fluid whose weight acts
///                         along the faces, so that none of them is held at one driving pressure, or whose weight acts
///                         between open faces, which are held at the nodes beside them
template <class Law, class Solver, class Cores>
[[nodiscard]] double box_permeability(const saturated_flow<Law, Solver, Cores>& flow, face inlet, face outlet,
                                      double viscosity) {
  const flow_conditions& c = flow.system().conditions();
  const auto held = [&](face f) { return c.at(f).kind == flow_condition::type::pressure; };
  const domain& region = flow.net().region();
  const box& b = region.bounds;
  const std::size_t axis = axis_of(inlet);
  const vec3<double> weight = flow.system().fluid().hydrostatic_gradient();
  vec3<double> across = weight;
  across[axis] = 0;
  if (across != vec3<double>{} ||
      (weight != vec3<double>{} && !(region.is_wall(inlet) && region.is_wall(opposite(inlet))))) {
    throw parameter_error("gravity", "a fluid whose weight acts along the faces or between open ones",
                          "gravity from wall to wall, or none");
  }
  const double drop =
      c.at(inlet).value - c.at(outlet).value - weight[axis] * (b.position(inlet) - b.position(opposite(inlet)));
  if (outlet != opposite(inlet) || !held(inlet) || !held(outlet) || drop == 0) {
    throw parameter_error(std::string("inlet ") + describe(inlet) + " and outlet " + describe(outlet),
                          "a drop of " + short_number(drop) + " Pa", "opposite faces held at two driving pressures");
  }
  const double length = b.size()[axis];
  return flow.flux(inlet) * viscosity * length * length / (b.volume() * drop);
}
/// The same, with the viscosity of the law.
template <class Law, class Solver, class Cores>
  requires detail::has_viscosity<Law>
[[nodiscard]] double box_permeability(const saturated_flow<Law, Solver, Cores>& flow, face inlet, face outlet) {
  return box_permeability(flow, inlet, outlet, static_cast<double>(flow.law().viscosity));
}

/// Permeability tensor [m²]: mean velocity = −k · (mean gradient) / μ. Entries of axes that are not periodic are 0:
/// nothing can flow along them on the mean.
struct permeability_tensor {
  std::array<vec3<double>, 3> rows{};
  std::array<solve_report, 3> reports{};  ///< of the flow along each periodic axis

  [[nodiscard]] double operator()(std::size_t i, std::size_t j) const noexcept { return rows[i][j]; }
};

/// Mean velocity of the fluid over the region along the periodic axes [m/s], of the last solution: the flow through
/// each cross-section over its area, grains included.
template <class Law, class Solver, class Cores>
[[nodiscard]] vec3<double> mean_velocity(const saturated_flow<Law, Solver, Cores>& flow) {
  const network& net = flow.net();
  vec3<double> sum;
  for (std::size_t i = 0; i < net.throat_count(); ++i) {
    const throat_id t(i);
    if (!net.is_boundary(t)) {
      sum += net.region().shift(flow.system().nodes().step(net, t)) * flow.flux(t);
    }
  }
  return sum / net.region().bounds.volume();
}

namespace detail {

/// Gives a flow its conditions back.
template <class Flow>
class restored_conditions {
 public:
  explicit restored_conditions(Flow& flow) : flow_(flow), before_(flow.system().conditions()) {}
  ~restored_conditions() { flow_.set_conditions(std::move(before_)); }
  restored_conditions(const restored_conditions&) = delete;
  restored_conditions& operator=(const restored_conditions&) = delete;

 private:
  Flow& flow_;
  flow_conditions before_;
};

}  // namespace detail

/// The permeability tensor by three flows under a mean gradient along each periodic axis, from the dissipation
/// k_ab = (μ/V) Σ w d_a d_b, with d_a the drops of pressure of flow a: symmetric, and an error of the pressures enters
/// squared.
/// The conditions of the flow are restored, also when a solution throws, and it has to be solved again. Where a report
/// says that there is no pressure, the entries of its axis are 0.
/// \throw parameter_error  a network without periodic axes, or a flow with held pressures or imposed fluxes; as `solve`
template <class Law, class Solver, class Cores>
[[nodiscard]] permeability_tensor tensor_of_permeability(saturated_flow<Law, Solver, Cores>& flow, double viscosity,
                                                         const solve_options& how = {}) {
  const network& net = flow.net();
  const flow_conditions before = flow.system().conditions();
  if (!net.region().any_periodic()) {
    throw parameter_error("permeability tensor", "no periodic axis", "a network that is periodic along some axes");
  }
  const auto drives = [](const flow_condition& x) { return x.kind != flow_condition::type::no_flow; };
  if (std::any_of(before.faces.begin(), before.faces.end(), drives) ||
      std::any_of(before.pores.begin(), before.pores.end(),
                  [&](const pore_condition& p) { return drives(p.condition); })) {
    throw parameter_error("permeability tensor", "a pressure or a flux at a face or in a pore",
                          "a flow that nothing but a mean gradient drives");
  }
  const detail::restored_conditions restored(flow);
  flow_conditions c = before;
  permeability_tensor out;
  std::array<std::vector<double>, 3> drops;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!net.region().is_periodic(axis)) {
      continue;
    }
    c.mean_gradient = {};
    c.mean_gradient[axis] = -1.0;
    flow.set_conditions(c);
    const solve_report& report = out.reports[axis] = flow.solve({}, how);
    if (report.kind() == verdict::failed && report.reason != solve_status::not_converged) {
      continue;
    }
    drops[axis].resize(net.throat_count());
    for (std::size_t i = 0; i < net.throat_count(); ++i) {
      drops[axis][i] = flow.pressure_drop(throat_id(i));
    }
  }
  const double scale = viscosity / net.region().bounds.volume();
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = a; b < 3; ++b) {
      if (drops[a].empty() || drops[b].empty()) {
        continue;
      }
      double sum = 0;
      for (std::size_t i = 0; i < net.throat_count(); ++i) {
        sum += flow.conductances().values[i] * drops[a][i] * drops[b][i];
      }
      out.rows[a][b] = out.rows[b][a] = scale * sum;
    }
  }
  return out;
}

/// The same, with the viscosity of the law.
template <class Law, class Solver, class Cores>
  requires detail::has_viscosity<Law>
[[nodiscard]] permeability_tensor tensor_of_permeability(saturated_flow<Law, Solver, Cores>& flow,
                                                         const solve_options& how = {}) {
  return tensor_of_permeability(flow, static_cast<double>(flow.law().viscosity), how);
}

}  // namespace tetrapore::inline TETRAPORE_ABI
