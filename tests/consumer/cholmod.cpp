// SPDX-License-Identifier: BSD-3-Clause
#include <tetrapore/solver/cholmod.hpp>

#include <array>
#include <cmath>

bool halves_the_drop();

/// Three pores in a row, the ends tied to 1 and 0: the middle lies half way.
bool halves_the_drop() {
  tetrapore::cholmod_solver solver;
  solver.analyze(tetrapore::network_graph(3, {{0, 1}, {1, 2}}));
  const std::array<double, 2> weights{1.0, 1.0};
  const std::array<double, 3> excess{1.0, 0.0, 1.0};
  const std::array<double, 3> sources{1.0, 0.0, 0.0};
  std::array<double, 3> x{};
  return solver.factorize(weights, excess).ok() && solver.solve(sources, x).ok() && std::abs(x[1] - 0.5) < 1e-15;
}
