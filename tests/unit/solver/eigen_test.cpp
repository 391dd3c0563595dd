// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/solver/eigen.hpp"

#include <Eigen/SparseCholesky>

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

using namespace tetrapore;

TEST_CASE("a chain of resistors between two fixed levels carries the flux of its resistances in series") {
  const network_graph chain(4, {{0, 1}, {1, 2}, {2, 3}});
  const std::vector<double> weights{1.0, 2.0, 4.0};
  const std::vector<double> excess{1.0, 0.0, 0.0, 1.0};  // pore 0 is tied to 1, pore 3 to 0, each by a weight of 1
  const auto matrix = laplacian(chain, weights, excess);
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
  const network_graph ring(3, {{0, 1}, {1, 2}, {2, 0}});
  const std::vector<double> weights{0.5, 3.0, 0.25};
  const std::vector<double> excess{0.0, 2.0, 0.0};
  const Eigen::VectorXd sums = laplacian(ring, weights, excess) * Eigen::VectorXd::Ones(3);
  for (int i = 0; i < 3; ++i) {
    CHECK(sums[i] == excess[static_cast<std::size_t>(i)]);
  }
}

TEST_CASE("edges between the same two nodes add up in the matrix, and a closed edge leaves a zero") {
  const network_graph pairs(3, {{0, 1}, {1, 0}, {2, 1}});
  const auto matrix = laplacian(pairs, std::vector<double>{1.0, 2.0, 0.0}, std::vector<double>{0.0, 0.0, 5.0});
  CHECK(matrix.coeff(0, 1) == -3.0);
  CHECK(matrix.coeff(1, 0) == -3.0);
  CHECK(matrix.coeff(1, 1) == 3.0);
  CHECK(matrix.coeff(1, 2) == 0.0);
  CHECK(matrix.coeff(2, 2) == 5.0);
}

namespace {

/// A grid of n × n nodes with conductances over twelve decades, tied along one side, with a source at the far corner.
struct grid {
  explicit grid(std::uint32_t n) {
    std::vector<network_graph::edge> edges;
    for (std::uint32_t i = 0; i < n * n; ++i) {
      if ((i + 1) % n != 0) {
        edges.push_back({i, i + 1});
      }
      if (i + n < n * n) {
        edges.push_back({i, i + n});
      }
    }
    for (std::size_t e = 0; e < edges.size(); ++e) {
      w.push_back(std::pow(10.0, static_cast<double>((7 * e) % 13)));
    }
    graph = network_graph(n * n, std::move(edges));
    s.assign(n * n, 0.0);
    std::fill_n(s.begin(), n, 1.0);
    b.assign(n * n, 0.0);
    b.back() = 1.0;
  }
  network_graph graph;
  std::vector<double> w, s, b;
};

}  // namespace

TEST_CASE("the V-cycle is a preconditioner of Eigen's conjugate gradients, from conductances or from a matrix alone") {
  const grid g(40);
  const auto matrix = laplacian(g.graph, g.w, g.s);
  const Eigen::Map<const Eigen::VectorXd> b(g.b.data(), matrix.rows());
  Eigen::Index plain = 0;
  {
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> cg(matrix);
    cg.setTolerance(1e-8);
    cg.setMaxIterations(100000);
    const Eigen::VectorXd x = cg.solve(b);
    plain = cg.iterations();
  }
  for (const bool from_conductances : {true, false}) {
    CAPTURE(from_conductances);
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper, vcycle_preconditioner<>> cg;
    if (from_conductances) {
      cg.preconditioner().assign(g.graph, g.w, g.s);
    }
    cg.compute(matrix);
    REQUIRE(cg.preconditioner().info() == Eigen::Success);
    cg.setTolerance(1e-8);
    const Eigen::VectorXd x = cg.solve(b);
    CHECK(cg.info() == Eigen::Success);
    CHECK(10 * cg.iterations() < plain);
    // the recurrence parts from the true residual by the rounding of the product with the matrix
    CHECK((matrix * x - b).norm() <= 2e-8 * b.norm() + 1e-14 * matrix.norm() * x.norm());
  }
}

TEST_CASE("the V-cycle is symmetric and positive definite") {
  const grid g(20);
  vcycle_preconditioner<double> cycle;
  cycle.assign(g.graph, g.w, g.s);
  Eigen::VectorXd u(400);
  Eigen::VectorXd v(400);
  for (Eigen::Index i = 0; i < 400; ++i) {
    u[i] = std::sin(static_cast<double>(3 * i));
    v[i] = std::cos(static_cast<double>(5 * i));
  }
  const double uv = u.dot(cycle.solve(v));
  CHECK(std::abs(uv - v.dot(cycle.solve(u))) <= 1e-13 * std::sqrt(u.dot(cycle.solve(u)) * v.dot(cycle.solve(v))));
  CHECK(u.dot(cycle.solve(u)) > 0);
}

TEST_CASE("the V-cycle of a matrix refuses what is no system of conductances") {
  Eigen::SparseMatrix<double> matrix(2, 2);
  matrix.insert(0, 0) = 1.0;
  matrix.insert(1, 1) = 1.0;
  vcycle_preconditioner<> cycle;
  CHECK(cycle.info() == Eigen::InvalidInput);
  CHECK(cycle.compute(matrix).info() == Eigen::Success);
  matrix.insert(1, 0) = 0.5;
  matrix.insert(0, 1) = 0.5;
  CHECK(cycle.compute(matrix).info() == Eigen::NumericalIssue);
  matrix.coeffRef(1, 0) = -2.0;
  matrix.coeffRef(0, 1) = -2.0;
  CHECK(cycle.compute(matrix).info() == Eigen::NumericalIssue);
}
