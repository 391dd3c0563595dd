// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/one_phase/flow.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

/// \file
/// Permeability of a packing: between two faces of its box, or the tensor of a periodic one.

namespace tetrapore::inline TETRAPORE_ABI {

/// Permeability between two opposite faces that are held at different pressures: k = Q μ L / (A Δp), with the area and
/// length of the box, of the last solution.
/// \param viscosity  [Pa s], that of the conductance law
/// \return [m²]
/// \throw parameter_error  faces that are not opposite, or not held at two pressures
template <class Law, class Solver>
[[nodiscard]] double box_permeability(const saturated_flow<Law, Solver>& flow, face inlet, face outlet,
                                      double viscosity) {
  const flow_conditions& c = flow.system().conditions();
  const auto held = [&](face f) { return c.at(f).kind == flow_condition::type::pressure; };
  const double drop = c.at(inlet).value - c.at(outlet).value;
  if (outlet != opposite(inlet) || !held(inlet) || !held(outlet) || drop == 0) {
    throw parameter_error(std::string("inlet ") + describe(inlet) + " and outlet " + describe(outlet),
                          "a drop of " + std::to_string(drop) + " Pa", "opposite faces held at two pressures");
  }
  const box& b = flow.net().region().bounds;
  const double length = b.size()[axis_of(inlet)];
  return flow.flux(inlet) * viscosity * length * length / (b.volume() * drop);
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
template <class Law, class Solver>
[[nodiscard]] vec3<double> mean_velocity(const saturated_flow<Law, Solver>& flow) {
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

/// The permeability tensor by three flows under a mean gradient along each periodic axis, from the dissipation
/// k_ab = (μ/V) Σ w d_a d_b, with d_a the drops of pressure of flow a: symmetric, and an error of the pressures enters
/// squared.
/// The other conditions of the flow stay; its mean gradient is restored, and it has to be solved again.
/// \throw parameter_error  a network without periodic axes, or with held pressures
template <class Law, class Solver>
[[nodiscard]] permeability_tensor tensor_of_permeability(saturated_flow<Law, Solver>& flow, double viscosity,
                                                         const solve_options& how = {}) {
  const network& net = flow.net();
  const flow_conditions before = flow.system().conditions();
  if (!net.region().any_periodic()) {
    throw parameter_error("permeability tensor", "no periodic axis", "a network that is periodic along some axes");
  }
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
    out.reports[axis] = flow.solve({}, how);
    drops[axis].resize(net.throat_count());
    for (std::size_t i = 0; i < net.throat_count(); ++i) {
      drops[axis][i] = flow.pressure_drop(throat_id(i));
    }
  }
  flow.set_conditions(before);
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

}  // namespace tetrapore::inline TETRAPORE_ABI
