// SPDX-License-Identifier: BSD-3-Clause
#include "support/solver_conformance.hpp"
#include "tetrapore/solver/cholmod.hpp"
#include "tetrapore/solver/eigen.hpp"

#include <doctest/doctest.h>

using namespace tetrapore;

namespace {
constexpr solve_options patient{.max_iterations = 20000};
}

TEST_CASE("Eigen's LDLT is a network_solver") { conformance::check<eigen_ldlt_solver>(); }
TEST_CASE("CHOLMOD is a network_solver") { conformance::check<cholmod_solver>(); }
TEST_CASE("Eigen's conjugate gradients with our V-cycle are a network_solver") {
  conformance::check<eigen_cg_solver<>>();
}
TEST_CASE("Eigen's conjugate gradients with our V-cycle in float are a network_solver") {
  conformance::check<eigen_cg_solver<vcycle_preconditioner<float>>>();
}
TEST_CASE("Eigen's conjugate gradients with the diagonal are a network_solver") {
  conformance::check<eigen_cg_solver<Eigen::DiagonalPreconditioner<double>>>(patient);
}
TEST_CASE("Eigen's conjugate gradients with an incomplete factor are a network_solver") {
  conformance::check<eigen_cg_solver<Eigen::IncompleteCholesky<double>>>(patient);
}
