// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/one_phase/flow_system.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

/// \file
/// How strongly the fluid can brake each grain.

namespace tetrapore::inline TETRAPORE_ABI {

/// Bounds on the drag that grains feel by their own motion.
struct drag_bounds {
  /// Per grain [N s/m]: with Γ the diagonal of these, no motion v is damped by more than v·Γ v.
  std::vector<double> values;
  /// Grains, in ascending order, with a facet between two pores that no way joins through open throats. These facets
  /// are left out of the values, for no finite bound holds: an incompressible fluid in a sealed pore lets none of its
  /// grains press it (`unbalanced_cluster`), a compressible one is a spring there, not a damper.
  std::vector<grain_id> sealed;
};

namespace detail {

/// Weights by which the velocities of the vertices of a facet sweep it: the mean of what is linear between them. A wall
/// takes none, for a facet that stands on a wall contains its normal.
[[nodiscard]] inline std::array<double, 3> sweeping_weights(const throat<double>& t) noexcept {
  if (t.grain_count == 3) {
    return {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};
  }
  if (t.grain_count == 2) {
    const double a = t.walls[0].distance(t.grains[0].centre);
    const double b = t.walls[0].distance(t.grains[1].centre);
    return {(2 * a + b) / (3 * (a + b)), (a + 2 * b) / (3 * (a + b)), 0};
  }
  return {1, 0, 0};
}

/// Ways of least resistance through a graph.
class easiest_ways {
 public:
  /// \param resistance  per edge, above 0
  easiest_ways(const network_graph& graph, std::span<const double> resistance)
      : graph_(graph), resistance_(resistance), reach_(graph.node_count(), infinity<double>), by_(graph.node_count()) {
    number_components();
  }

  [[nodiscard]] bool joined(std::size_t a, std::size_t b) const noexcept { return component_[a] == component_[b]; }

  /// The edges from a to b, which must be joined. Looks no farther than b is.
  void find(std::size_t a, std::size_t b, std::vector<std::uint32_t>& edges) {
    edges.clear();
    touched_.clear();
    front_.clear();
    const auto visit = [&](std::size_t node, double at, std::uint32_t by) {
      if (at < reach_[node]) {
        reach_[node] = at;
        by_[node] = by;
        touched_.push_back(node);
        front_.emplace_back(-at, node);
        std::push_heap(front_.begin(), front_.end());
      }
    };
    visit(a, 0.0, 0);
    while (!front_.empty()) {
      std::pop_heap(front_.begin(), front_.end());
      const auto [minus_at, node] = front_.back();
      front_.pop_back();
      if (node == b) {
        break;
      }
      if (-minus_at > reach_[node]) {
        continue;  // reached by an easier way since
      }
      for (std::size_t k = 0; k < graph_.degree(node); ++k) {
        const std::uint32_t e = graph_.incident_edges(node)[k];
        visit(graph_.neighbours(node)[k], reach_[node] + resistance_[e], e);
      }
    }
    for (std::size_t node = b; node != a;) {
      edges.push_back(by_[node]);
      const auto& [u, v] = graph_.edges()[by_[node]];
      node = u == node ? v : u;
    }
    for (const std::size_t node : touched_) {
      reach_[node] = infinity<double>;
    }
  }

 private:
  void number_components() {
    constexpr std::uint32_t unset = 0xffffffffU;
    component_.assign(graph_.node_count(), unset);
    std::vector<std::size_t> members;
    for (std::size_t first = 0; first < component_.size(); ++first) {
      if (component_[first] != unset) {
        continue;
      }
      component_[first] = static_cast<std::uint32_t>(first);
      members.assign(1, first);
      while (!members.empty()) {
        const std::size_t node = members.back();
        members.pop_back();
        for (const std::uint32_t next : graph_.neighbours(node)) {
          if (component_[next] == unset) {
            component_[next] = static_cast<std::uint32_t>(first);
            members.push_back(next);
          }
        }
      }
    }
  }

  const network_graph& graph_;
  std::span<const double> resistance_;
  std::vector<double> reach_;
  std::vector<std::uint32_t> by_;  ///< edge by which a node was reached
  std::vector<std::uint32_t> component_;
  std::vector<std::size_t> touched_;
  std::vector<std::pair<double, std::size_t>> front_;  ///< heap by the least resistance
};

}  // namespace detail

/// Bounds on the drag, from the conductances.
///
/// Fluxes Q v sweep the facets, w is the diagonal of the open conductances. Each facet gets a way from pore to pore
/// through open throats: its own throat, or, where that is closed or below a thousandth of the mean, the way of least
/// resistance (held pores count as one, for the fluid between them is not pressed). To send the flux of a facet along
/// its way changes the balance of no pore, and the fall of the pressure across the facet is the sum of the falls along
/// it. So with C from facets to ways the falls are w^-½ Π w^-½ C Q v, with Π a projection; a row of the product is at
/// most Σ_facets of the grain S share Σ_way (Σ S of all facets that go this way)/w, and the larger of a row with the
/// shares of the load and one with those of sweeping bounds the drag.
/// \param shares  per throat: the part of its load that each vertex takes, grains first
[[nodiscard]] inline drag_bounds bounds_of_drag(const network& net, const flow_system& system,
                                                std::span<const double> conductances,
                                                std::span<const std::array<double, 3>> shares) {
  struct facet {
    throat_id throat;
    std::uint32_t a;
    std::uint32_t b;
  };
  constexpr double least = std::numeric_limits<double>::min();  // below it 1/w has no number
  const flow_nodes& nodes = system.nodes();
  const auto end = [&](pore_id p) { return static_cast<std::uint32_t>(system.is_held(p) ? nodes.size() : nodes[p]); };
  std::vector<facet> facets;
  std::vector<network_graph::edge> open;
  std::vector<double> resistance;
  std::vector<std::uint32_t> edge_of;  // per facet; meaningless where it is closed
  double total = 0;
  for (std::size_t i = 0; i < net.throat_count(); ++i) {
    const throat_id t(i);
    if (net.is_boundary(t) || nodes.inside(net, t)) {
      continue;
    }
    const facet f{t, end(net.pores(t)[0]), end(net.pores(t)[1])};
    if (f.a == f.b) {
      continue;  // no motion presses the fluid across it
    }
    facets.push_back(f);
    edge_of.push_back(static_cast<std::uint32_t>(open.size()));
    if (conductances[i] >= least) {
      open.push_back({f.a, f.b});
      resistance.push_back(1 / conductances[i]);
      total += conductances[i];
    }
  }
  const double own_way = open.empty() ? 0.0 : std::max(1e-3 * total / static_cast<double>(open.size()), least);
  const network_graph graph(nodes.size() + 1, std::move(open));
  detail::easiest_ways ways(graph, resistance);

  std::vector<std::size_t> first_step{0};  // per facet: its way
  std::vector<std::uint32_t> steps;
  std::vector<std::uint32_t> way;
  std::vector<double> swept(resistance.size(), 0.0);    // per edge: area whose sweeping goes this way
  std::vector<double> loading(resistance.size(), 0.0);  // and area whose load comes from it
  std::vector<bool> sealed(net.grain_count(), false);
  const auto for_grains = [&](throat_id t, const auto& f) {
    const throat<double> seen = detail::facet_at(net, t);
    const double area = norm(seen.area_vector);
    if (!(area > 0)) {
      return;
    }
    const pore_id a = net.pores(t)[0];
    const auto slots = facet_slots(net, a, net.slot(t, 0));
    const std::array<double, 3> weights = detail::sweeping_weights(seen);
    for (std::size_t k = 0; k < seen.grain_count; ++k) {
      f(net.vertices(a)[slots[k]].grain(), area * std::abs(shares[t.index()][k]), area * weights[k]);
    }
  };
  for (std::size_t i = 0; i < facets.size(); ++i) {
    const facet& f = facets[i];
    if (conductances[f.throat.index()] >= own_way && own_way > 0) {
      steps.push_back(edge_of[i]);
    } else if (ways.joined(f.a, f.b)) {
      ways.find(f.a, f.b, way);
      steps.insert(steps.end(), way.begin(), way.end());
    }
    first_step.push_back(steps.size());
    for_grains(f.throat, [&](grain_id g, double load, double sweep) {
      if (first_step[i] == steps.size()) {
        sealed[g.index()] = true;
      }
      for (std::size_t s = first_step[i]; s < steps.size(); ++s) {
        loading[steps[s]] += load;
        swept[steps[s]] += sweep;
      }
    });
  }
  drag_bounds out;
  out.values.assign(net.grain_count(), 0.0);
  std::vector<double> by_sweeping(net.grain_count(), 0.0);
  for (std::size_t i = 0; i < facets.size(); ++i) {
    double falls = 0;
    double pushes = 0;
    for (std::size_t s = first_step[i]; s < first_step[i + 1]; ++s) {
      falls += swept[steps[s]] * resistance[steps[s]];
      pushes += loading[steps[s]] * resistance[steps[s]];
    }
    for_grains(facets[i].throat, [&](grain_id g, double load, double sweep) {
      out.values[g.index()] += load * falls;
      by_sweeping[g.index()] += sweep * pushes;
    });
  }
  for (std::size_t g = 0; g < out.values.size(); ++g) {
    out.values[g] = std::max(out.values[g], by_sweeping[g]);
    if (sealed[g]) {
      out.sealed.emplace_back(g);
    }
  }
  return out;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
