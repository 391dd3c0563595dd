// SPDX-License-Identifier: BSD-3-Clause
#include "support/graph_network.hpp"
#include "tetrapore/solver/eigen.hpp"

#include <Eigen/SparseCholesky>

#include <doctest/doctest.h>

#include <vector>

using namespace tetrapore;

TEST_CASE("a chain of resistors between two fixed levels carries the flux of its resistances in series") {
  const network net = graph_network({{}, {}, {}, {}}, {{0, 1}, {1, 2}, {2, 3}});
  const std::vector<double> weights{1.0, 2.0, 4.0};
  const std::vector<double> excess{1.0, 0.0, 0.0, 1.0};  // pore 0 is tied to 1, pore 3 to 0, each by a weight of 1
  const auto matrix = laplacian(net, weights, excess);
  CHECK(matrix.isApprox(Eigen::SparseMatrix<double>(matrix.transpose()), 0.0));
  Eigen::VectorXd source = Eigen::VectorXd::Zero(4);
  source[0] = 1.0;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  const Eigen::VectorXd x = solver.solve(source);
  const double flux = 1.0 / (1.0 + 1.0 + 0.5 + 0.25 + 1.0);
  CHECK(1.0 - x[0] == doctest::Approx(flux).epsilon(1e-14));
  CHECK(2.0 * (x[1] - x[2]) == doctest::Approx(flux).epsilon(1e-14));
  CHECK(x[3] == doctest::Approx(flux).epsilon(1e-14));
}

TEST_CASE("the rows of the matrix sum to the excess") {
  const network net = graph_network({{}, {}, {}}, {{0, 1}, {1, 2}, {2, 0}});
  const std::vector<double> weights{0.5, 3.0, 0.25};
  const std::vector<double> excess{0.0, 2.0, 0.0};
  const Eigen::VectorXd sums = laplacian(net, weights, excess) * Eigen::VectorXd::Ones(3);
  for (int i = 0; i < 3; ++i) {
    CHECK(sums[i] == excess[static_cast<std::size_t>(i)]);
  }
}
