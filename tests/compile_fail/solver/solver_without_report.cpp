// SPDX-License-Identifier: BSD-3-Clause
// A solver says what became of a factorization, not only whether there is one.
// expect: does not satisfy return-type-requirement|same_as<_Bool, .*solve_report>
#include "tetrapore/solver/concept.hpp"

struct mine {
  void analyze(const tetrapore::network_graph&) {}
  bool factorize(std::span<const double>, std::span<const double>) { return {}; }
  tetrapore::solve_report solve(std::span<const double>, std::span<double>, tetrapore::solve_options = {}) {
    return {};
  }
};
static_assert(tetrapore::network_solver<mine>);
