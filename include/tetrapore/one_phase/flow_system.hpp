// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/field.hpp"
#include "tetrapore/one_phase/conditions.hpp"
#include "tetrapore/one_phase/nodes.hpp"
#include "tetrapore/solver/graph.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// \file
/// The pressure system of a network: conductances and excess, never a matrix.

namespace tetrapore::inline TETRAPORE_ABI {

/// The system Σ_j w_ij (x_i − x_j) + s_i x_i = b_i of a flow.
///
/// The unknown of a node is its pressure less a reference level, the mean gradient's part and the weight of the fluid:
/// p = x + level + (G + ρ g)·r, with r the place of the node counted from the lower corner of the box (without a box,
/// from the first grain). A mean gradient acts on each throat by the step between its nodes, so nothing depends on
/// where a periodic box is cut. Held nodes are no unknowns: a throat to one adds its w to s, and w times the held x to
/// b.
/// \par Accuracy  the level is the mean of the held values, so that a pressure common to all costs no digits
class flow_system {
 public:
  flow_system() = default;

  /// \throw parameter_error  conditions that contradict each other or do not fit the network
  flow_system(const network& net, flow_nodes nodes, flow_conditions conditions, pore_fluid fluid)
      : flow_system(unnumbered{}, net, std::move(nodes), std::move(conditions), fluid) {
    number(net);
  }

  /// Other conditions on the same network. True when the same nodes are held as before: graph and excess then stay.
  /// \throw parameter_error  as the constructor; nothing has changed then
  bool set_conditions(const network& net, flow_conditions conditions) {
    detail::check(net, conditions, fluid_);
    flow_system next = *this;
    next.conditions_ = std::move(conditions);
    next.hold(net);
    const bool same = next.free_set_is(label_);
    if (!same) {
      next.number(net);
    }
    *this = std::move(next);
    return same;
  }

  /// The network has followed its grains, or is a new one: of another epoch. True when the graph has stayed.
  /// \throw parameter_error  as the constructor; nothing has changed then
  bool follow(const network& net, flow_nodes nodes, flow_conditions conditions) {
    flow_system next(unnumbered{}, net, std::move(nodes), std::move(conditions), fluid_);
    const bool same = next.epoch_ == epoch_ && next.nodes_.same_groups(nodes_) && next.free_set_is(label_);
    if (same) {
      next.unknown_of_ = std::move(unknown_of_);
      next.unknown_node_ = std::move(unknown_node_);
      next.edge_throat_ = std::move(edge_throat_);
      next.held_links_ = std::move(held_links_);
      next.graph_ = graph_;
    } else {
      next.number(net);
    }
    *this = std::move(next);
    return same;
  }

  /// Of the network that the system was made of, or followed last.
  [[nodiscard]] std::uint64_t epoch() const noexcept { return epoch_; }

  [[nodiscard]] const flow_nodes& nodes() const noexcept { return nodes_; }
  [[nodiscard]] const flow_conditions& conditions() const noexcept { return conditions_; }
  [[nodiscard]] const pore_fluid& fluid() const noexcept { return fluid_; }
  /// One node per unknown, one edge per throat between two of them.
  [[nodiscard]] const network_graph& graph() const noexcept { return graph_; }
  [[nodiscard]] std::size_t unknowns() const noexcept { return unknown_node_.size(); }
  /// A pore of an unknown, to name it by.
  [[nodiscard]] pore_id pore_of(std::size_t unknown) const noexcept { return nodes_.pore(unknown_node_[unknown]); }
  [[nodiscard]] throat_id throat_of(std::size_t edge) const noexcept { return edge_throat_[edge]; }
  [[nodiscard]] bool is_held(pore_id p) const noexcept { return label_[nodes_[p]] != free_node; }
  [[nodiscard]] bool compressible() const noexcept { return fluid_.bulk_modulus < infinity<double>; }

  /// The weights of the graph's edges, from those of the throats.
  [[nodiscard]] std::vector<double> edge_weights(std::span<const double> throat_weights) const {
    std::vector<double> w(edge_throat_.size());
    for (std::size_t e = 0; e < w.size(); ++e) {
      w[e] = throat_weights[edge_throat_[e].index()];
    }
    return w;
  }

  /// The excess of the unknowns: throats to held nodes, and what the fluid's compression takes up in a step.
  /// \param per_time  1/Δt [1/s]; 0 without compression
  [[nodiscard]] std::vector<double> excess(std::span<const double> throat_weights, double per_time) const {
    std::vector<double> s(unknowns(), 0.0);
    for (const held_link& l : held_links_) {
      s[l.unknown] += throat_weights[l.throat.index()];
    }
    if (compressible() && per_time > 0) {
      for (std::size_t i = 0; i < s.size(); ++i) {
        s[i] += void_volume_[unknown_node_[i]] * (per_time / fluid_.bulk_modulus);
      }
    }
    return s;
  }

  /// What enters each node from outside [m³/s]: imposed fluxes less volume rates.
  [[nodiscard]] std::vector<double> inflow(std::span<const double> rates) const {
    std::vector<double> q = imposed_;
    for (std::size_t i = 0; i < rates.size(); ++i) {
      q[nodes_[pore_id(i)]] -= rates[i];
    }
    return q;
  }

  /// What compression gave each node in the last step: the excess times the old x, per node.
  [[nodiscard]] std::vector<double> stored(const network& net, std::span<const double> old_pressure,
                                           double per_time) const {
    std::vector<double> out(nodes_.size(), 0.0);
    for (std::size_t i = 0; i < old_pressure.size(); ++i) {
      const pore_id p(i);
      out[nodes_[p]] += usable_void(net, p) * (per_time / fluid_.bulk_modulus) * (old_pressure[i] - part_of(net, p));
    }
    return out;
  }

  /// Takes off what compression takes up at the new x, so that the inflow is what a node gives to its throats.
  void take_up(std::span<const double> x, double per_time, std::span<double> node_inflow) const noexcept {
    for (std::size_t n = 0; n < node_inflow.size(); ++n) {
      node_inflow[n] -= void_volume_[n] * (per_time / fluid_.bulk_modulus) * x[n];
    }
  }

  struct right_hand_side {
    std::vector<double> b;
    double rounding = 0;  ///< of Σ b over any cluster [m³/s]
  };

  /// The right-hand side, from what enters each node (and what compression gave).
  [[nodiscard]] right_hand_side sources(const network& net, std::span<const double> throat_weights,
                                        std::span<const double> node_inflow) const {
    right_hand_side out;
    out.b.resize(unknowns());
    for (std::size_t i = 0; i < out.b.size(); ++i) {
      out.b[i] = node_inflow[unknown_node_[i]];
    }
    const bool tilted = conditions_.mean_gradient != vec3<double>{};
    double pushed = 0;
    for (const held_link& l : held_links_) {
      out.b[l.unknown] += throat_weights[l.throat.index()] * x_held_[l.held];
    }
    if (tilted) {
      std::vector<double> sum(unknowns(), 0.0);
      std::vector<double> size(unknowns(), 0.0);  // of the terms of each sum
      const auto push = [&](std::uint32_t i, double q) {
        sum[i] += q;
        size[i] += std::abs(q);
      };
      for (std::size_t e = 0; e < edge_throat_.size(); ++e) {
        const double q = throat_weights[edge_throat_[e].index()] * tilt(net, edge_throat_[e]);
        push(graph_.edges()[e][0], q);
        push(graph_.edges()[e][1], -q);
        pushed += std::abs(q);
      }
      for (const held_link& l : held_links_) {
        const double q = throat_weights[l.throat.index()] * tilt(net, l.throat);
        push(l.unknown, l.unknown_first ? q : -q);
      }
      for (std::size_t i = 0; i < sum.size(); ++i) {  // in a lattice, a mean gradient leaves nothing but rounding
        out.b[i] += std::abs(sum[i]) > 16 * epsilon<double> * size[i] ? sum[i] : 0.0;
      }
    }
    out.rounding = 16 * epsilon<double> * pushed;
    return out;
  }

  /// x of every node, from those of the unknowns.
  [[nodiscard]] std::vector<double> with_held(std::span<const double> x) const {
    std::vector<double> all = x_held_;
    for (std::size_t i = 0; i < x.size(); ++i) {
      all[unknown_node_[i]] = x[i];
    }
    return all;
  }

  /// The unknowns from a pressure field: the start of a solution.
  /// \param gradient  the mean gradient that the pressure contains
  [[nodiscard]] std::vector<double> start_from(const network& net, std::span<const double> pressure,
                                               const vec3<double>& gradient) const {
    std::vector<double> x(unknowns());
    for (std::size_t i = 0; i < x.size(); ++i) {
      const pore_id p = pore_of(i);
      x[i] = pressure[p.index()] - part_of(net, p, gradient);
    }
    return x;
  }

  /// Pressure in a pore [Pa], from x of all nodes.
  [[nodiscard]] double pressure(const network& net, std::span<const double> x, pore_id p) const noexcept {
    return x[nodes_[p]] + part_of(net, p);
  }
  /// The pressure that drives the flow [Pa]: without the weight of the fluid.
  [[nodiscard]] double driving_pressure(const network& net, std::span<const double> x, pore_id p) const noexcept {
    return x[nodes_[p]] + (level_ + dot(conditions_.mean_gradient, place(net, p)));
  }

  /// The pressure of the fluid at rest in a pore [Pa], nothing at the origin of places.
  [[nodiscard]] double pressure_at_rest(const network& net, pore_id p) const noexcept {
    return dot(fluid_.hydrostatic_gradient(), place(net, p));
  }

  /// Fall of the driving pressure from pore 0 to pore 1 of a throat [Pa].
  [[nodiscard]] double drop(const network& net, std::span<const double> x, throat_id t) const noexcept {
    const auto& [a, b] = net.pores(t);
    const double fall = x[nodes_[a]] - x[nodes_[b]];
    return conditions_.mean_gradient == vec3<double>{} ? fall : fall - tilt(net, t);
  }

  /// Flow from outside into the pores that a face holds at a pressure [m³/s].
  /// \par Accuracy  counted not at the face but at the cut around it of least conductance, where differences of
  ///                pressure keep their digits, less what enters between the two
  [[nodiscard]] double flux(const network& net, std::span<const double> throat_weights, std::span<const double> x,
                            std::span<const double> node_inflow, face f) const {
    return flux_of_label(net, throat_weights, x, node_inflow, static_cast<std::uint8_t>(f));
  }
  /// The same, for all pores that are held one by one.
  [[nodiscard]] double flux_of_held_pores(const network& net, std::span<const double> throat_weights,
                                          std::span<const double> x, std::span<const double> node_inflow) const {
    return flux_of_label(net, throat_weights, x, node_inflow, held_pore);
  }

 private:
  struct unnumbered {};
  flow_system(unnumbered, const network& net, flow_nodes nodes, flow_conditions conditions, const pore_fluid& fluid)
      : nodes_(std::move(nodes)), conditions_(std::move(conditions)), fluid_(fluid), epoch_(net.epoch()) {
    detail::check(net, conditions_, fluid_);
    locate(net);
    hold(net);
  }

  enum : std::uint8_t { held_pore = 6, free_node = 7 };  ///< labels of nodes; 0 to 5 are faces that hold them
  static constexpr std::uint32_t no_unknown = 0xffffffffU;

  /// A throat between an unknown and a held node.
  struct held_link {
    throat_id throat;
    std::uint32_t unknown;
    std::uint32_t held;  ///< node
    bool unknown_first;
  };

  [[nodiscard]] vec3<double> place(const network& net, pore_id p) const noexcept {
    return nodes_.position(net, p) - origin_;
  }
  /// What is added to x to make the pressure of a pore.
  [[nodiscard]] double part_of(const network& net, pore_id p) const noexcept {
    return part_of(net, p, conditions_.mean_gradient);
  }
  [[nodiscard]] double part_of(const network& net, pore_id p, const vec3<double>& gradient) const noexcept {
    const vec3<double> slope = gradient + fluid_.hydrostatic_gradient();
    return slope == vec3<double>{} ? level_ : level_ + dot(slope, place(net, p));
  }
  /// Rise of the mean pressure from the node of pore 0 to that of pore 1.
  [[nodiscard]] double tilt(const network& net, throat_id t) const noexcept {
    const auto& [a, b] = net.pores(t);
    const vec3<double> step = (net.power_centre(nodes_.pore(nodes_[b])) - net.power_centre(nodes_.pore(nodes_[a]))) +
                              net.region().shift(nodes_.step(net, t));
    return dot(conditions_.mean_gradient, step);
  }

  /// The void of a cell; below the rounding of its parts an empty cell has none.
  [[nodiscard]] double usable_void(const network& net, pore_id p) const noexcept {
    const double v = net.void_volume(p);
    return v < 0 && v > -void_rounding_ ? 0.0 : v;
  }

  void locate(const network& net) {
    const bool boxed = net.region().bounds.size() != vec3<double>{};
    origin_ = boxed || net.grain_count() == 0 ? net.region().bounds.lo : net.grains()[0].centre;
    double total = 0;
    for (std::size_t i = 0; i < net.pore_count(); ++i) {
      total += std::abs(net.volume(pore_id(i)));
    }
    void_rounding_ = net.pore_count() > 0 ? 1e-12 * total / static_cast<double>(net.pore_count()) : 0.0;
    void_volume_.assign(nodes_.size(), 0.0);
    for (std::size_t i = 0; i < net.pore_count(); ++i) {
      void_volume_[nodes_[pore_id(i)]] += usable_void(net, pore_id(i));
    }
  }

  /// Labels the nodes that are held, their x, the level, and the imposed fluxes.
  void hold(const network& net) {
    using kind = flow_condition::type;
    label_.assign(nodes_.size(), free_node);
    x_held_.assign(nodes_.size(), 0.0);
    imposed_.assign(nodes_.size(), 0.0);
    std::vector<bool> own(conditions_.pores.empty() ? 0 : nodes_.size(), false);
    const auto has_own = [&](pore_id p) { return !own.empty() && own[nodes_[p]]; };
    const auto hold_node = [&](pore_id p, double value, std::uint8_t label) {
      const std::size_t n = nodes_[p];
      if (label_[n] != free_node && x_held_[n] != value) {
        throw parameter_error("pore " + std::to_string(p.index()),
                              "pressures " + short_number(x_held_[n]) + " and " + short_number(value),
                              "one pressure, or a condition of its own");
      }
      if (label_[n] == free_node) {
        label_[n] = label;
        x_held_[n] = value;
      }
    };
    for (const pore_condition& c : conditions_.pores) {
      own[nodes_[c.pore]] = true;
      if (c.condition.kind == kind::pressure) {
        const vec3<double> slope = fluid_.hydrostatic_gradient() + conditions_.mean_gradient;
        hold_node(c.pore, c.condition.value - dot(slope, place(net, c.pore)), held_pore);
      } else if (c.condition.kind == kind::flux) {
        imposed_[nodes_[c.pore]] += c.condition.value;
      }
    }
    for (const face f : all_faces) {
      if (conditions_.at(f).kind == kind::no_flow) {
        continue;
      }
      bool touched = false;
      double area = 0;
      std::vector<std::pair<std::size_t, double>> shares;
      for (std::size_t i = 0; i < net.pore_count(); ++i) {
        const pore_id p(i);
        if (!net.touches(p, f)) {
          continue;
        }
        touched = true;
        if (has_own(p)) {
          continue;
        }
        if (conditions_.at(f).kind == kind::flux) {
          const double a = covered_area(net, p, f);
          shares.emplace_back(nodes_[p], a);
          area += a;
        } else {
          hold_on_face(net, p, f, hold_node);
        }
      }
      if (!touched) {
        throw parameter_error(std::string("condition at ") + describe(f), "a face that no pore touches",
                              "a face of the network");
      }
      if (conditions_.at(f).kind == kind::flux && !(area > 0)) {
        throw parameter_error(std::string("condition at ") + describe(f), "a flux without pores that could take it",
                              "pores at the face that have no condition of their own");
      }
      for (const auto& [node, a] : shares) {
        imposed_[node] += conditions_.at(f).value * (a / area);
      }
    }
    level_ = 0;
    std::size_t held = 0;
    for (std::size_t n = 0; n < label_.size(); ++n) {
      if (label_[n] != free_node) {
        ++held;
        level_ += (x_held_[n] - level_) / static_cast<double>(held);
      }
    }
    for (std::size_t n = 0; n < label_.size(); ++n) {
      x_held_[n] = label_[n] == free_node ? 0.0 : x_held_[n] - level_;
    }
  }

  /// A pressure on a wall holds there, on the wall; beside it the fluid's weight is added. On an open face it holds at
  /// the node.
  template <class Hold>
  void hold_on_face(const network& net, pore_id p, face f, const Hold& hold_node) const {
    vec3<double> at = place(net, p);
    if (net.region().is_wall(f)) {
      at[axis_of(f)] = net.region().bounds.position(f) - origin_[axis_of(f)];
    }
    hold_node(p, conditions_.at(f).value - dot(fluid_.hydrostatic_gradient(), at), static_cast<std::uint8_t>(f));
  }

  [[nodiscard]] bool free_set_is(const std::vector<std::uint8_t>& labels) const noexcept {
    bool same = labels.size() == label_.size();
    for (std::size_t n = 0; n < label_.size() && same; ++n) {
      same = (labels[n] == free_node) == (label_[n] == free_node);
    }
    return same;
  }

  void number(const network& net) {
    unknown_of_.assign(nodes_.size(), no_unknown);
    unknown_node_.clear();
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      if (label_[n] == free_node) {
        unknown_of_[n] = static_cast<std::uint32_t>(unknown_node_.size());
        unknown_node_.push_back(static_cast<std::uint32_t>(n));
      }
    }
    std::vector<network_graph::edge> edges;
    edges.reserve(net.throat_count());
    edge_throat_.clear();
    edge_throat_.reserve(net.throat_count());
    held_links_.clear();
    for (std::size_t i = 0; i < net.throat_count(); ++i) {
      const throat_id t(i);
      const auto& [a, b] = net.pores(t);
      if (!b.valid() || nodes_[a] == nodes_[b]) {
        continue;
      }
      const std::uint32_t u = unknown_of_[nodes_[a]];
      const std::uint32_t v = unknown_of_[nodes_[b]];
      if (u != no_unknown && v != no_unknown) {
        edges.push_back({u, v});
        edge_throat_.push_back(t);
      } else if (u != no_unknown || v != no_unknown) {
        const bool first = u != no_unknown;
        held_links_.push_back({t, first ? u : v, static_cast<std::uint32_t>(nodes_[first ? b : a]), first});
      }
    }
    graph_ = network_graph(unknowns(), std::move(edges));
  }

  [[nodiscard]] double flux_of_label(const network& net, std::span<const double> throat_weights,
                                     std::span<const double> x, std::span<const double> node_inflow,
                                     std::uint8_t label) const {
    // Grow the set of held nodes by every unknown that is tied closer to it than to the rest.
    std::vector<double> inner(unknowns(), 0.0);
    std::vector<double> all(unknowns(), 0.0);
    for (std::size_t e = 0; e < edge_throat_.size(); ++e) {
      for (const std::uint32_t u : graph_.edges()[e]) {
        all[u] += throat_weights[edge_throat_[e].index()];
      }
    }
    std::vector<std::uint32_t> front;
    for (const held_link& l : held_links_) {
      const double w = throat_weights[l.throat.index()];
      all[l.unknown] += w;
      if (label_[l.held] == label) {
        inner[l.unknown] += w;
        front.push_back(l.unknown);
      }
    }
    std::vector<bool> taken(unknowns(), false);
    while (!front.empty()) {
      const std::uint32_t u = front.back();
      front.pop_back();
      if (taken[u] || !(inner[u] > 0.5 * all[u])) {
        continue;
      }
      taken[u] = true;
      for (std::size_t k = 0; k < graph_.degree(u); ++k) {
        const std::uint32_t v = graph_.neighbours(u)[k];
        inner[v] += throat_weights[edge_throat_[graph_.incident_edges(u)[k]].index()];
        front.push_back(v);
      }
    }
    const auto in_set = [&](std::size_t node) {
      return unknown_of_[node] == no_unknown ? label_[node] == label : static_cast<bool>(taken[unknown_of_[node]]);
    };
    double sum = 0;
    for (std::size_t i = 0; i < net.throat_count(); ++i) {
      const throat_id t(i);
      const auto& [a, b] = net.pores(t);
      if (!b.valid() || in_set(nodes_[a]) == in_set(nodes_[b])) {
        continue;
      }
      const double q = throat_weights[i] * drop(net, x, t);
      sum += in_set(nodes_[a]) ? q : -q;
    }
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      sum -= in_set(n) ? node_inflow[n] : 0.0;
    }
    return sum;
  }

  flow_nodes nodes_;
  flow_conditions conditions_;
  pore_fluid fluid_;
  std::uint64_t epoch_ = 0;
  vec3<double> origin_;
  double level_ = 0;
  double void_rounding_ = 0;
  // per node
  std::vector<std::uint8_t> label_;
  std::vector<double> x_held_;
  std::vector<double> imposed_;
  std::vector<double> void_volume_;
  std::vector<std::uint32_t> unknown_of_;
  // per unknown, per edge
  std::vector<std::uint32_t> unknown_node_;
  std::vector<throat_id> edge_throat_;
  std::vector<held_link> held_links_;
  network_graph graph_;
};

}  // namespace tetrapore::inline TETRAPORE_ABI
