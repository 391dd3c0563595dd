// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/executor.hpp"
#include "tetrapore/one_phase/conductances.hpp"
#include "tetrapore/one_phase/flow_system.hpp"
#include "tetrapore/one_phase/volume_rates.hpp"
#include "tetrapore/solver/concept.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// \file
/// Flow of one fluid through a network.
///
/// In short:
/// \code
///   flow_conditions between;
///   between.at(face::y_min) = held_pressure(1.0);
///   between.at(face::y_max) = held_pressure(0.0);
///   saturated_flow flow(net, hydraulic_radius{.viscosity = 1e-3}, ldlt_solver<>{}, {.conditions = between});
///   solve_report report = flow.solve();
///   double q = flow.flux(face::y_min);            // [m³/s] into the network
///   const pressure_field& p = flow.pressure();    // [Pa]
///   fluid_forces f = forces_on_grains(flow);      // one_phase/forces.hpp
///   // the grains have moved
///   follow(net, grains);                          // or: carry(rebuild(net, engine, grains), flow.pressure());
///   flow.update();
///   flow.step(dt, rates_of_volume(net, {.velocities = v}));
/// \endcode

namespace tetrapore::inline TETRAPORE_ABI {

struct flow_options {
  flow_conditions conditions{};
  pore_fluid fluid{};
  refused_throats refused = refused_throats::error;
  node_rule nodes{};
  keep_hydraulics hydraulics = keep_hydraulics::no;  ///< yes where forces follow each solution
};

/// Σ_j K_ij (p_i − p_j) + V_void/(K_f Δt) (p_i − p_i,old) = −dV_i/dt on the pores of a network.
///
/// Analyses the graph once per epoch (again where pores merge or part, or other pores are held), factorizes once per
/// geometry and length of step, solves once per right-hand side. The solver starts from `pressure()` where the options
/// of a solution say warm = true; without options, where that is the pressure of a solution, also one that was carried
/// across a rebuild.
/// \tparam Cores  runs the loop over the throats that asks the law
/// \par Thread safety  one thread at a time; the network must outlive it
template <conductance_law Law, network_solver Solver, executor Cores = serial>
class saturated_flow {
 public:
  /// \throw parameter_error  conditions that contradict each other or do not fit the network
  /// \throw network_error    a throat that the law refuses (see refused_throats)
  saturated_flow(const network& net, Law law, Solver solver, flow_options options = {}, Cores cores = {})
      : net_(&net),
        law_(std::move(law)),
        solver_(std::move(solver)),
        options_(std::move(options)),
        cores_(std::move(cores)) {
    flow_nodes nodes(net, options_.nodes);
    conductances_ = conductances_between(nodes);
    system_ = flow_system(net, std::move(nodes), options_.conditions, options_.fluid);
    pressure_ = pressure_field(net);
    driving_ = pressure_field(net);
    solver_.analyze(system_.graph());
  }
  /// A network that nobody keeps.
  saturated_flow(const network&&, Law, Solver, flow_options = {}, Cores = {}) = delete;

  /// To be called when the network has followed its grains or was rebuilt. After a rebuild the pressure starts from 0
  /// unless it was carried.
  /// \throw as the constructor; parameter_error where conditions name single pores, which a rebuild has renumbered
  void update() {
    if (net_->epoch() != system_.epoch() && !system_.conditions().pores.empty()) {
      throw parameter_error("conditions of single pores", "pores of epoch " + std::to_string(system_.epoch()),
                            "update(conditions) with those of epoch " + std::to_string(net_->epoch()));
    }
    update(system_.conditions());
  }
  /// The same, with other conditions.
  void update(flow_conditions conditions) {
    flow_nodes nodes(*net_, options_.nodes);
    throat_conductances values = conductances_between(nodes);
    if (!system_.follow(*net_, std::move(nodes), std::move(conditions))) {
      solver_.analyze(system_.graph());
    }
    conductances_ = std::move(values);
    if (!pressure_.belongs_to(*net_)) {
      pressure_ = pressure_field(*net_);
      near_ = false;
    }
    driving_ = pressure_field(*net_);
    x_.clear();
    factorized_ = false;
  }

  /// \throw parameter_error  as the constructor
  void set_conditions(flow_conditions conditions) {
    if (!system_.set_conditions(*net_, std::move(conditions))) {
      solver_.analyze(system_.graph());
      factorized_ = false;
    }
    x_.clear();
  }

  /// Conductances of the caller's own, until the next update: one per throat, at least 0 [m³/(Pa s)]. Those on the
  /// boundary and inside nodes play no part.
  /// \throw parameter_error  another number of them, or one that is negative or not finite; names the throat
  void set_conductances(std::vector<double> values) {
    if (values.size() != net_->throat_count()) {
      throw parameter_error("conductances", std::to_string(values.size()),
                            std::to_string(net_->throat_count()) + ", one per throat");
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!is_conductance(values[i]) && joins_nodes(throat_id(i))) {
        throw parameter_error("throat " + std::to_string(i), "a conductance of " + short_number(values[i]),
                              "a finite number of at least 0");
      }
    }
    conductances_.values = std::move(values);
    conductances_.counts = {};
    x_.clear();
    factorized_ = false;
  }

  /// The steady flow that balances the volume rates.
  /// \throw network_error  naming the cluster of pores that nothing ties to a level and whose sources do not sum to
  ///                       zero, or the pore or throat with a number that is not finite. The pressure is unchanged then
  solve_report solve(const volume_rates& rates = {}) { return solve(rates, {.warm = near_}); }
  solve_report solve(const volume_rates& rates, const solve_options& how) { return advance(0.0, rates, how); }

  /// One implicit step of a compressible fluid, from the present pressure; of an incompressible fluid the same as
  /// `solve`.
  /// \param dt  [s]
  /// \throw parameter_error  a step that is not above 0; else as `solve`
  solve_report step(double dt, const volume_rates& rates = {}) { return step(dt, rates, {.warm = near_}); }
  solve_report step(double dt, const volume_rates& rates, const solve_options& how) {
    if (!(dt > 0) || !std::isfinite(dt)) {
      throw parameter_error("time step", short_number(dt), "a finite number above 0");
    }
    return advance(system_.compressible() ? 1.0 / dt : 0.0, rates, how);
  }

  /// Pressure per pore [Pa]; may be set before a step or as a guess, and carried across a rebuild.
  [[nodiscard]] const pressure_field& pressure() const noexcept { return pressure_; }
  [[nodiscard]] pressure_field& pressure() noexcept { return pressure_; }
  /// The pressure less that of the fluid at rest [Pa]: what drives the flow. Of the last solution.
  [[nodiscard]] const pressure_field& driving_pressure() const noexcept { return driving_; }
  [[nodiscard]] const solve_report& report() const noexcept { return report_; }
  [[nodiscard]] const network& net() const noexcept { return *net_; }
  [[nodiscard]] const flow_system& system() const noexcept { return system_; }
  [[nodiscard]] const throat_conductances& conductances() const noexcept { return conductances_; }
  [[nodiscard]] const Law& law() const noexcept { return law_; }
  [[nodiscard]] Solver& solver() noexcept { return solver_; }

  /// Flow that enters the network at a face in the last solution [m³/s]; negative where it leaves.
  [[nodiscard]] double flux(face f) const {
    const flow_condition& c = system_.conditions().at(f);
    if (c.kind == flow_condition::type::pressure) {
      expect_solution();
      return system_.flux(*net_, conductances_.values, x_, inflow_, f);
    }
    return c.kind == flow_condition::type::flux ? c.value : 0.0;
  }
  /// Flow that enters at the pores that are held one by one [m³/s].
  [[nodiscard]] double flux_of_held_pores() const {
    expect_solution();
    return system_.flux_of_held_pores(*net_, conductances_.values, x_, inflow_);
  }
  /// Flow from pore 0 to pore 1 of a throat [m³/s].
  [[nodiscard]] double flux(throat_id t) const {
    return net_->is_boundary(t) ? 0.0 : conductances_.values[t.index()] * pressure_drop(t);
  }
  /// Fall of the driving pressure from pore 0 to pore 1 of a throat [Pa]; 0 on a boundary.
  [[nodiscard]] double pressure_drop(throat_id t) const {
    expect_solution();
    return net_->is_boundary(t) ? 0.0 : system_.drop(*net_, x_, t);
  }
  /// Largest over smallest conductance of the throats that are open.
  /// \throw parameter_error  there is none
  [[nodiscard]] double contrast() const {
    double largest = 0;
    double smallest = infinity<double>;
    for (std::size_t i = 0; i < conductances_.values.size(); ++i) {
      if (const double k = conductances_.values[i]; k > 0 && joins_nodes(throat_id(i))) {
        largest = std::max(largest, k);
        smallest = std::min(smallest, k);
      }
    }
    if (!(largest > 0)) {
      throw parameter_error("contrast", "no open throat between two nodes", "at least one");
    }
    return largest / smallest;
  }

 private:
  [[nodiscard]] throat_conductances conductances_between(const flow_nodes& nodes) const {
    return tetrapore::conductances(*net_, nodes, law_, options_.refused, cores_, options_.hydraulics);
  }
  [[nodiscard]] bool joins_nodes(throat_id t) const noexcept {
    return !net_->is_boundary(t) && !system_.nodes().inside(*net_, t);
  }

  void expect_solution() const {
    if (x_.empty() && net_->pore_count() > 0) {
      throw parameter_error("flow", "no solution", "solve or step first");
    }
  }

  solve_report advance(double per_time, const volume_rates& rates, solve_options how) {
    if (!rates.values.empty() && rates.values.size() != net_->pore_count()) {
      throw parameter_error("volume rates", std::to_string(rates.values.size()),
                            std::to_string(net_->pore_count()) + ", one per pore");
    }
    TETRAPORE_EXPECTS(system_.epoch() == net_->epoch() && pressure_.belongs_to(*net_), "update() follows a rebuild");
    const std::vector<double>& k = conductances_.values;
    if (!factorized_ || per_time != per_time_) {
      factorized_ = false;
      const std::vector<double> w = system_.edge_weights(k);
      report_ = solver_.factorize(w, system_.excess(k, per_time));
      expect_answer(report_);
      if (!report_.ok()) {
        return report_;  // there is no factor: the pressure stays
      }
      factorized_ = true;
      per_time_ = per_time;
    }
    std::vector<double> inflow = system_.inflow(rates.values);
    std::vector<double> stored(per_time > 0 ? system_.stored(*net_, pressure_.values(), per_time)
                                            : std::vector<double>{});
    for (std::size_t n = 0; n < stored.size(); ++n) {
      inflow[n] += stored[n];
    }
    const flow_system::right_hand_side right = system_.sources(*net_, k, inflow);
    std::vector<double> x =
        how.warm ? system_.start_from(*net_, pressure_.values(), near_ ? gradient_ : system_.conditions().mean_gradient)
                 : std::vector<double>(system_.unknowns(), 0.0);
    how.balance_floor += right.rounding + rates.rounding;
    const solve_report report = solver_.solve(right.b, x, how);
    expect_answer(report);
    report_ = report;
    if (report.kind() == verdict::failed && report.reason != solve_status::not_converged) {
      return report_;  // there is no x: the pressure stays
    }
    near_ = report.ok();
    gradient_ = system_.conditions().mean_gradient;
    x_ = system_.with_held(x);
    if (per_time > 0) {
      system_.take_up(x_, per_time, inflow);
    }
    inflow_ = std::move(inflow);
    for (std::size_t i = 0; i < net_->pore_count(); ++i) {
      pressure_[pore_id(i)] = system_.pressure(*net_, x_, pore_id(i));
      driving_[pore_id(i)] = system_.driving_pressure(*net_, x_, pore_id(i));
    }
    return report_;
  }

  void expect_answer(const solve_report& r) const {
    if (r.kind() != verdict::refused) {
      return;
    }
    switch (r.reason) {
      case solve_status::invalid_weight:
        throw network_error("throat " + std::to_string(system_.throat_of(r.index).index()), describe(r.reason),
                            "a finite conductance of at least 0");
      case solve_status::unbalanced_cluster:
        throw network_error(
            "a cluster of " + std::to_string(r.cluster_size) + " nodes, at pores " + cluster_of(r.index),
            "sources with the sum " + short_number(r.imbalance) + " m³/s",
            "a pressure held in it, a compressible fluid, or sources that sum to zero");
      case solve_status::invalid_excess:
      case solve_status::invalid_source:
      case solve_status::invalid_start:
        throw network_error("pore " + std::to_string(system_.pore_of(r.index).index()), describe(r.reason),
                            "finite pressures, rates and volumes");
      default: throw network_error("the pressure system", describe(r.reason), "a system that fits its network");
    }
  }

  /// A pore of each of the first nodes in the cluster of an unknown.
  [[nodiscard]] std::string cluster_of(std::size_t unknown) const {
    constexpr std::size_t most = 8;
    const network_graph& g = system_.graph();
    std::vector<std::size_t> members{unknown};
    std::vector<bool> seen(g.node_count(), false);
    seen[unknown] = true;
    std::string names;
    for (std::size_t m = 0; m < members.size(); ++m) {
      const std::size_t u = members[m];
      if (m == most) {
        return names + ", …";
      }
      names += (m > 0 ? ", " : "") + std::to_string(system_.pore_of(u).index());
      for (std::size_t k = 0; k < g.degree(u); ++k) {
        const std::size_t v = g.neighbours(u)[k];
        if (!seen[v] && conductances_.values[system_.throat_of(g.incident_edges(u)[k]).index()] > 0) {
          seen[v] = true;
          members.push_back(v);
        }
      }
    }
    return names;
  }

  const network* net_;
  Law law_;
  Solver solver_;
  flow_options options_;
  [[no_unique_address]] Cores cores_;
  throat_conductances conductances_;
  flow_system system_;
  pressure_field pressure_;
  pressure_field driving_;
  std::vector<double> x_;       ///< per node, of the last solution
  std::vector<double> inflow_;  ///< per node: what it gave to its throats, if it is no held one [m³/s]
  solve_report report_;
  double per_time_ = 0;
  bool factorized_ = false;
  bool near_ = false;      ///< the pressure is that of a solution
  vec3<double> gradient_;  ///< of that solution
};

}  // namespace tetrapore::inline TETRAPORE_ABI
