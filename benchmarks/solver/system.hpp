// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/compiled_triangulation.hpp"
#include "support/dense_packing.hpp"
#include "tetrapore/law/conductance/hydraulic_radius.hpp"
#include "tetrapore/one_phase/conductances.hpp"
#include "tetrapore/one_phase/flow_system.hpp"
#include "tetrapore/solver/hierarchy.hpp"
#include "tetrapore/solver/pressure_system.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <random>
#include <span>
#include <utility>
#include <vector>

/// \file
/// Pressure systems of dense packings, with references in long double, and what is told of their solutions.

namespace bench {

namespace tp = tetrapore;

/// What is done to the conductances of the packing.
enum class contrast {
  natural,    ///< nothing
  power_1_4,  ///< raised to the power 1.4
  power_2,    ///< raised to the power 2
  tenth,      ///< 10 % of the throats × 1e-10
  closed      ///< 40 % of the throats × 1e-18
};

[[nodiscard]] inline const char* describe(contrast c) {
  switch (c) {
    case contrast::natural: return "natural";
    case contrast::power_1_4: return "power 1.4";
    case contrast::power_2: return "power 2";
    case contrast::tenth: return "10 % x 1e-10";
    case contrast::closed: return "40 % x 1e-18";
  }
  return "none";
}

struct pressure_case {
  tp::network_graph graph;
  std::vector<double> weights, excess, sources;
  double ratio = 1;               ///< largest over smallest conductance
  std::vector<double> reference;  ///< solved in long double
};

/// Conjugate gradients in long double on fluxes, to stagnation: every number of the method but its preconditioner, a
/// V-cycle in double, has 64 bits. The best iterate in the norm ‖D^-½ r‖.
[[nodiscard]] inline std::vector<double> reference_solution(const pressure_case& c) {
  using real = long double;
  const std::size_t n = c.graph.node_count();
  tp::pressure_system checked;
  checked.analyze(c.graph);
  if (!checked.factorize(c.weights, c.excess).ok() || checked.floating_clusters() > 0) {
    return {};
  }
  tp::aggregation_hierarchy<double> hierarchy;
  hierarchy.analyze(c.graph);
  hierarchy.factorize(c.weights, c.excess);
  std::vector<double> narrow(n), cycled(n);
  const auto precondition = [&](const std::vector<real>& r, std::vector<real>& z) {
    real largest = 0;
    for (const real v : r) {
      largest = std::max(largest, std::abs(v));
    }
    const real up = largest > 0 ? std::ldexp(real(1), -std::ilogb(largest)) : real(1);
    for (std::size_t i = 0; i < n; ++i) {
      narrow[i] = static_cast<double>(r[i] * up);
    }
    hierarchy.apply(narrow, cycled);
    for (std::size_t i = 0; i < n; ++i) {
      z[i] = cycled[i] / up;
    }
  };
  const auto edges = c.graph.edges();
  const auto product = [&](const std::vector<real>& x, std::vector<real>& y) {
    for (std::size_t i = 0; i < n; ++i) {
      y[i] = c.excess[i] * x[i];
    }
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const real flux = c.weights[e] * (x[edges[e][0]] - x[edges[e][1]]);
      y[edges[e][0]] += flux;
      y[edges[e][1]] -= flux;
    }
  };
  const auto dot = [n](const std::vector<real>& a, const std::vector<real>& b) {
    real sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      sum += a[i] * b[i];
    }
    return sum;
  };
  std::vector<real> x(n, 0), r(c.sources.begin(), c.sources.end()), z(n), p(n), q(n), best(n, 0);
  real best_norm = -1;
  // Restarts from the true residual; within one, until the recurrence has fallen by 1e10.
  for (int restart = 0; restart < 8; ++restart) {
    if (restart > 0) {
      product(x, r);
      for (std::size_t i = 0; i < n; ++i) {
        r[i] = c.sources[i] - r[i];
      }
    }
    real norm = 0;
    for (std::size_t i = 0; i < n; ++i) {
      norm += checked.diagonal()[i] > 0 ? r[i] * r[i] / checked.diagonal()[i] : real(0);
    }
    if (best_norm >= 0 && !(norm < best_norm * real(0.25))) {
      best = norm < best_norm ? x : best;
      break;
    }
    best_norm = norm;
    best = x;
    precondition(r, z);
    p = z;
    real rz = dot(r, z);
    const real stop = rz * real(1e-20L);
    for (int k = 0; k < 2000 && rz > stop && rz > 0; ++k) {
      product(p, q);
      const real step = rz / dot(p, q);
      for (std::size_t i = 0; i < n; ++i) {
        x[i] += step * p[i];
        r[i] -= step * q[i];
      }
      precondition(r, z);
      const real next = dot(r, z);
      const real turn = next / rz;
      rz = next;
      for (std::size_t i = 0; i < n; ++i) {
        p[i] = z[i] + turn * p[i];
      }
    }
  }
  return {best.begin(), best.end()};
}

/// Flow from y_min (pressure 1) to y_max (0) through n dense grains (a multiple of 1,000; six pores per grain), with
/// the conductances of the hydraulic radius, changed as said; nodes that are tied to nothing are held at 0 by their own
/// conductance. Made once.
[[nodiscard]] inline const pressure_case& dense_case(std::size_t grains, contrast how) {
  static std::map<std::pair<std::size_t, contrast>, std::unique_ptr<pressure_case>> made;
  auto& c = made[{grains, how}];
  if (c) {
    return *c;
  }
  c = std::make_unique<pressure_case>();
  if (how == contrast::natural) {
    const tp::packing p = dense_packing(grains);
    const tp::network net = tp::tessellate(p.grains, tp::domain_of(p), compiled_triangulation{}).net;
    tp::flow_nodes nodes(net);
    const auto k = tp::conductances(net, nodes, tp::hydraulic_radius{.viscosity = 1.0}, tp::refused_throats::closed);
    tp::flow_conditions between;
    between.at(tp::face::y_min) = tp::held_pressure(1.0);
    between.at(tp::face::y_max) = tp::held_pressure(0.0);
    const tp::flow_system system(net, std::move(nodes), between, {});
    c->graph = system.graph();
    c->weights = system.edge_weights(k.values);
    c->excess = system.excess(k.values, 0.0);
    c->sources = system.sources(net, k.values, system.inflow({})).b;
  } else {
    const pressure_case& from = dense_case(grains, contrast::natural);
    c->graph = from.graph;
    c->weights = from.weights;
    c->excess = from.excess;
    c->sources = from.sources;
    std::mt19937_64 random(11);
    const auto fraction = [&] { return static_cast<double>(random() >> 11U) * 0x1p-53; };
    const double power = how == contrast::power_1_4 ? 1.4 : (how == contrast::power_2 ? 2.0 : 1.0);
    for (double& w : c->weights) {
      w = std::pow(w, power);
      w *= how == contrast::tenth && fraction() < 0.1 ? 1e-10 : 1.0;
      w *= how == contrast::closed && fraction() < 0.4 ? 1e-18 : 1.0;
    }
  }
  tp::pressure_system checked;
  checked.analyze(c->graph);
  if (checked.factorize(c->weights, c->excess).floating_clusters > 0) {
    c->excess = checked.grounded_excess();
  }
  double low = tp::infinity<double>;
  double high = 0;
  for (const double w : c->weights) {
    if (w > 0) {
      low = std::min(low, w);
      high = std::max(high, w);
    }
  }
  c->ratio = high / low;
  c->reference = reference_solution(*c);
  return *c;
}

/// Largest |x − reference| over the largest |reference|.
[[nodiscard]] inline double error_of(const pressure_case& c, std::span<const double> x) {
  double worst = c.reference.size() == x.size() ? 0.0 : tp::infinity<double>;
  double largest = 0;
  for (std::size_t i = 0; i < c.reference.size(); ++i) {
    const double off = std::abs(x[i] - c.reference[i]);
    worst = off <= worst ? worst : off;
    largest = std::max(largest, std::abs(c.reference[i]));
  }
  return worst / largest;
}

/// What every row tells of its last solution.
inline void tell_solution(benchmark::State& state, const pressure_case& c, std::span<const double> x, bool solved) {
  state.counters["error"] = error_of(c, x);
  state.counters["failed"] = solved ? 0 : 1;
  state.counters["pores"] = static_cast<double>(c.graph.node_count());
}

}  // namespace bench
