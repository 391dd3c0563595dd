// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/solver/concept.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <span>
#include <utility>
#include <vector>

/// \file
/// Pressure systems with their solutions in extended precision.

struct pressure_case {
  tetrapore::network_graph graph;
  std::vector<double> w, s, b;
};

/// The solution by dense elimination without subtraction in long double, node by node in the order given: nothing is
/// shared with the solvers under test. For at most some 1,000 nodes. Floating clusters get zero mean.
[[nodiscard]] inline std::vector<long double> dense_truth(const pressure_case& c) {
  const std::size_t n = c.graph.node_count();
  std::vector<long double> w(n * n, 0.0L);
  std::vector<long double> s(c.s.begin(), c.s.end());
  std::vector<long double> b(c.b.begin(), c.b.end());
  std::vector<long double> x(n, 0.0L);
  std::vector<long double> pivots(n);
  std::vector<std::size_t> root(n);
  for (std::size_t e = 0; e < c.graph.edge_count(); ++e) {
    const auto [i, j] = c.graph.edges()[e];
    w[i * n + j] += static_cast<long double>(c.w[e]);
    w[j * n + i] += static_cast<long double>(c.w[e]);
  }
  for (std::size_t k = 0; k < n; ++k) {
    long double d = s[k];
    for (std::size_t j = k + 1; j < n; ++j) {
      d += w[k * n + j];
    }
    pivots[k] = d;
    if (!(d > 0)) {
      continue;
    }
    for (std::size_t i = k + 1; i < n; ++i) {
      const long double share = w[k * n + i] / d;
      if (!(share > 0)) {
        continue;
      }
      s[i] += share * s[k];
      b[i] += share * b[k];
      for (std::size_t j = k + 1; j < n; ++j) {
        w[i * n + j] += i == j ? 0.0L : share * w[k * n + j];
      }
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    root[k] = k;
    if (!(pivots[k] > 0)) {
      continue;
    }
    x[k] = b[k] / pivots[k];
    for (std::size_t j = k + 1; j < n; ++j) {
      if (w[k * n + j] > 0) {
        x[k] += w[k * n + j] / pivots[k] * x[j];
        root[k] = root[j];
      }
    }
  }
  std::vector<long double> sum(n, 0.0L);
  std::vector<long double> count(n, 0.0L);
  for (std::size_t k = 0; k < n; ++k) {
    sum[root[k]] += x[k];
    count[root[k]] += 1;
  }
  for (std::size_t k = 0; k < n; ++k) {
    x[k] -= pivots[root[k]] > 0 ? 0.0L : sum[root[k]] / count[root[k]];
  }
  return x;
}

/// The solution of a large system with a definite matrix: x in long double, residuals in flux form in long double, and
/// corrections by any solver, until they are below 1e-15 of x. Only the residual decides what x converges to.
template <tetrapore::network_solver Solver>
[[nodiscard]] std::vector<long double> refined_truth(const pressure_case& c) {
  const std::size_t n = c.graph.node_count();
  std::vector<long double> x(n, 0.0L);
  std::vector<double> r(n);
  std::vector<double> d(n);
  Solver solver;
  solver.analyze(c.graph);
  static_cast<void>(solver.factorize(c.w, c.s));
  long double before = 2;
  for (int step = 0; step < 20; ++step) {
    std::vector<long double> exact(n);
    for (std::size_t i = 0; i < n; ++i) {
      exact[i] = static_cast<long double>(c.b[i]) - static_cast<long double>(c.s[i]) * x[i];
    }
    for (std::size_t e = 0; e < c.graph.edge_count(); ++e) {
      const auto [i, j] = c.graph.edges()[e];
      const long double flux = static_cast<long double>(c.w[e]) * (x[i] - x[j]);
      exact[i] -= flux;
      exact[j] += flux;
    }
    std::transform(exact.begin(), exact.end(), r.begin(), [](long double v) { return static_cast<double>(v); });
    static_cast<void>(solver.solve(r, d));
    long double change = 0;
    long double size = 0;
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += static_cast<long double>(d[i]);
      change = std::max(change, std::abs(static_cast<long double>(d[i])));
      size = std::max(size, std::abs(x[i]));
    }
    const long double relative = change / size;
    if (relative < 1e-15L || !(relative < before)) {
      break;
    }
    before = relative;
  }
  return x;
}

/// Largest error over the largest value.
[[nodiscard]] inline double relative_error(std::span<const double> x, std::span<const long double> truth) {
  long double error = 0;
  long double size = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const long double e = std::abs(static_cast<long double>(x[i]) - truth[i]);
    error = e <= error ? error : e;  // a NaN is an error
    size = std::max(size, std::abs(truth[i]));
  }
  return static_cast<double>(size > 0 ? error / size : error);
}

/// A graph like that of a packing: a cubic lattice of side³ nodes, of which two edges in three are kept, so that a node
/// has four neighbours, with conductances spread log-normally and one in a hundred up to 1e7 times larger, as between
/// nearly coincident centres. Pressures 1 and 0 are imposed on two faces; `power` stretches the contrast.
[[nodiscard]] inline pressure_case packing_like(std::size_t side, double power, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11U) * 0x1p-53; };
  pressure_case c;
  const std::size_t n = side * side * side;
  const auto at = [&](std::size_t x, std::size_t y, std::size_t z) {
    return static_cast<std::uint32_t>((z * side + y) * side + x);
  };
  std::vector<tetrapore::network_graph::edge> edges;
  for (std::size_t z = 0; z < side; ++z) {
    for (std::size_t y = 0; y < side; ++y) {
      for (std::size_t x = 0; x < side; ++x) {
        for (const auto& [dx, dy, dz] : {std::array<std::size_t, 3>{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
          if (x + dx < side && y + dy < side && z + dz < side && uniform() < 0.67) {
            edges.push_back({at(x, y, z), at(x + dx, y + dy, z + dz)});
            const double normal = std::sqrt(-2 * std::log(1 - uniform())) * std::cos(6.283185307179586 * uniform());
            const double rare = uniform() < 0.01 ? std::pow(10.0, 7 * uniform()) : 1.0;
            c.w.push_back(std::pow(std::exp(0.7 * normal) * rare, power));
          }
        }
      }
    }
  }
  c.graph = tetrapore::network_graph(n, std::move(edges));
  c.s.assign(n, 0.0);
  c.b.assign(n, 0.0);
  for (std::size_t z = 0; z < side; ++z) {
    for (std::size_t x = 0; x < side; ++x) {
      c.s[at(x, 0, z)] = c.b[at(x, 0, z)] = 1.0;
      c.s[at(x, side - 1, z)] = 1.0;
    }
  }
  return c;
}

/// Multiplies a share of the conductances, chosen by a seed.
inline void scale_some(pressure_case& c, double share, double factor, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (double& w : c.w) {
    w *= static_cast<double>(random() >> 11U) * 0x1p-53 < share ? factor : 1.0;
  }
}
