// SPDX-License-Identifier: BSD-3-Clause
// A solver says what became of a factorization, not only whether there is one.
#include "tetrapore/solver/concept.hpp"

struct mine {
  void analyze(const tetrapore::network_graph&) {}
  tetrapore::solve_report factorize(std::span<const double>, std::span<const double>) { return {}; }
  tetrapore::solve_report solve(std::span<const double>, std::span<double>, tetrapore::solve_options = {}) {
    return {};
  }
};
static_assert(tetrapore::network_solver<mine>);
