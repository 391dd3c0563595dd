// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/solver/direct.hpp"
#include "tetrapore/solver/hierarchy.hpp"
#include "tetrapore/solver/lower_triangle.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

/// \file
/// Eigen's solvers of pressure systems, our V-cycle as a preconditioner of Eigen, and a system as a matrix of Eigen for
/// any solver that takes one. The only header that sees Eigen (MPL-2.0).

namespace tetrapore::inline TETRAPORE_ABI {
namespace detail {
class flux_operator;
}
}  // namespace tetrapore::inline TETRAPORE_ABI

/// \cond
template <>
struct Eigen::internal::traits<tetrapore::detail::flux_operator>
    : Eigen::internal::traits<Eigen::SparseMatrix<double>> {};
/// \endcond

namespace tetrapore::inline TETRAPORE_ABI {

namespace detail {

/// D^-½ A D^-½ as an operator of Eigen, A x = Σ_j w_ij (x_i − x_j) + s_i x_i by a sum of fluxes, D the diagonal of A:
/// with it Eigen's ‖r‖ is the norm in which a sealed pore counts as much as a wide one.
class flux_operator : public Eigen::EigenBase<flux_operator> {
 public:
  using Scalar = double;
  using RealScalar = double;
  using StorageIndex = int;
  enum {
    ColsAtCompileTime = Eigen::Dynamic,
    MaxColsAtCompileTime = Eigen::Dynamic,
    RowsAtCompileTime = Eigen::Dynamic,
    IsRowMajor = false
  };

  void assign(const network_graph& graph, std::span<const double> weights, std::span<const double> excess) {
    graph_ = graph;
    excess_.assign(excess.begin(), excess.end());
    const auto edges = graph.all_incident_edges();
    weights_.resize(edges.size());
    for (std::size_t k = 0; k < edges.size(); ++k) {
      weights_[k] = weights[edges[k]];
    }
    const auto offsets = graph.offsets();
    root_.resize(rows());
    for (Eigen::Index i = 0; i < rows(); ++i) {
      const auto row = static_cast<std::size_t>(i);
      root_[i] = excess[row];
      for (std::uint32_t k = offsets[row]; k < offsets[row + 1]; ++k) {
        root_[i] += weights_[k];
      }
      root_[i] = std::sqrt(root_[i]);
    }
  }

  /// D^½, above 0 everywhere.
  [[nodiscard]] const Eigen::VectorXd& root() const noexcept { return root_; }
  [[nodiscard]] Eigen::Index rows() const noexcept { return static_cast<Eigen::Index>(graph_.node_count()); }
  [[nodiscard]] Eigen::Index cols() const noexcept { return rows(); }

  template <class Rhs>
  [[nodiscard]] Eigen::Product<flux_operator, Rhs, Eigen::AliasFreeProduct> operator*(
      const Eigen::MatrixBase<Rhs>& x) const {
    return {*this, x.derived()};
  }

  /// y += scale · D^-½ A D^-½ v
  template <class Destination, class Rhs>
  void add_product(Destination& y, const Rhs& v, double scale) const {
    const Eigen::VectorXd x = v.cwiseQuotient(root_);
    const auto offsets = graph_.offsets();
    const auto next = graph_.all_neighbours();
    for (Eigen::Index i = 0; i < rows(); ++i) {
      const auto row = static_cast<std::size_t>(i);
      const double own = x[i];
      double sum = excess_[row] * own;
      for (std::uint32_t k = offsets[row]; k < offsets[row + 1]; ++k) {
        sum += weights_[k] * (own - x[static_cast<Eigen::Index>(next[k])]);
      }
      y[i] += scale * (sum / root_[i]);
    }
  }

 private:
  network_graph graph_;
  std::vector<double> weights_;  // of each entry of the rows
  std::vector<double> excess_;
  Eigen::VectorXd root_;
};

/// A preconditioner of A that was made beforehand, for the scaled system of a flux_operator.
template <class Preconditioner>
class ready_made : public Preconditioner {
 public:
  ready_made& compute(const flux_operator& system) {
    root_ = &system.root();
    return *this;
  }
  template <class Rhs>
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::MatrixBase<Rhs>& b) const {
    const Eigen::VectorXd scaled = b.cwiseProduct(*root_);
    const Eigen::VectorXd x = Preconditioner::solve(scaled);
    return x.cwiseProduct(*root_);
  }

 private:
  const Eigen::VectorXd* root_ = nullptr;
};

/// An Eigen matrix with the pattern of a lower triangle.
[[nodiscard]] inline Eigen::SparseMatrix<double> matrix_with(const lower_triangle<int>& pattern) {
  const auto n = static_cast<Eigen::Index>(pattern.size());
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.resizeNonZeros(static_cast<Eigen::Index>(pattern.rows().size()));
  std::copy(pattern.offsets().begin(), pattern.offsets().end(), matrix.outerIndexPtr());
  std::copy(pattern.rows().begin(), pattern.rows().end(), matrix.innerIndexPtr());
  return matrix;
}

[[nodiscard]] inline std::span<double> values_of(Eigen::SparseMatrix<double>& matrix) noexcept {
  return {matrix.valuePtr(), static_cast<std::size_t>(matrix.nonZeros())};
}

[[nodiscard]] inline Eigen::Map<const Eigen::VectorXd> as_eigen(std::span<const double> v) noexcept {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}
[[nodiscard]] inline Eigen::Map<Eigen::VectorXd> as_eigen(std::span<double> v) noexcept {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}

}  // namespace detail
}  // namespace tetrapore::inline TETRAPORE_ABI

/// \cond
template <class Rhs>
struct Eigen::internal::generic_product_impl<tetrapore::detail::flux_operator, Rhs, Eigen::SparseShape,
                                             Eigen::DenseShape, Eigen::GemvProduct>
    : generic_product_impl_base<tetrapore::detail::flux_operator, Rhs,
                                generic_product_impl<tetrapore::detail::flux_operator, Rhs>> {
  template <class Destination>
  static void scaleAndAddTo(Destination& y, const tetrapore::detail::flux_operator& a, const Rhs& x, double scale) {
    a.add_product(y, x, scale);
  }
};
/// \endcond

namespace tetrapore::inline TETRAPORE_ABI {

/// The matrix of Σ_j w_ij (x_i − x_j) + s_i x_i on a graph, both triangles.
/// \param weights  one per edge, at least 0
/// \param excess   one per node, at least 0: what ties a node to a fixed level
/// \par Accuracy  each diagonal is a sum that rounds: where weights differ by a factor c within a row, the small ones
/// lose their digits beyond 1/(c ε)
/// \par Source  Chareyre et al. 2017, Eq. (1)
[[nodiscard]] inline Eigen::SparseMatrix<double> laplacian(const network_graph& graph, std::span<const double> weights,
                                                           std::span<const double> excess) {
  TETRAPORE_EXPECTS(weights.size() == graph.edge_count() && excess.size() == graph.node_count(),
                    "a weight for each edge, an excess for each node");
  const lower_triangle<int> triangle(graph);
  Eigen::SparseMatrix<double> lower = detail::matrix_with(triangle);
  triangle.fill(graph, weights, excess, detail::values_of(lower));
  return lower.selfadjointView<Eigen::Lower>();
}

/// Eigen's SimplicialLDLT as a pressure_factor; order and pattern are kept from analyze on.
/// \par Accuracy  the matrix is assembled: see lower_triangle. direct_solver refines on w and s
class eigen_ldlt_factorization {
 public:
  void analyze(const network_graph& graph) {
    triangle_ = lower_triangle<int>(graph);
    matrix_ = detail::matrix_with(triangle_);
    std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 1.0);
    if (matrix_.rows() > 0) {
      ldlt_->analyzePattern(matrix_);
    }
  }
  /// False where a pivot is not positive.
  [[nodiscard]] bool factorize(const network_graph& graph, std::span<const double> weights,
                               std::span<const double> excess) {
    triangle_.fill(graph, weights, excess, detail::values_of(matrix_));
    if (matrix_.rows() == 0) {
      return true;
    }
    ldlt_->factorize(matrix_);
    return ldlt_->info() == Eigen::Success && (ldlt_->vectorD().array() > 0).all();
  }
  bool apply(std::span<const double> b, std::span<double> x) const {
    if (matrix_.rows() > 0) {
      detail::as_eigen(x) = ldlt_->solve(detail::as_eigen(b));
    }
    return true;
  }
  /// One refinement mends what assembling the matrix has lost.
  [[nodiscard]] static constexpr std::size_t refinements() noexcept { return 1; }

 private:
  using ldlt = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

  lower_triangle<int> triangle_;
  Eigen::SparseMatrix<double> matrix_;
  std::unique_ptr<ldlt> ldlt_ = std::make_unique<ldlt>();  // Eigen's solvers do not move
};
static_assert(pressure_factor<eigen_ldlt_factorization>);

using eigen_ldlt_solver = direct_solver<eigen_ldlt_factorization>;
static_assert(network_solver<eigen_ldlt_solver>);

/// One V-cycle of the aggregation hierarchy, symmetric and positive definite, as a preconditioner of Eigen:
/// \code
/// Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper, vcycle_preconditioner<>> cg;
/// cg.preconditioner().assign(graph, w, s);  // from conductances; without this line, from the matrix
/// cg.compute(laplacian(graph, w, s));
/// \endcode
/// \tparam Real  what the conductances of the hierarchy are held in
template <std::floating_point Real = double>
class vcycle_preconditioner {
 public:
  using StorageIndex = int;
  enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic };

  explicit vcycle_preconditioner(const hierarchy_options& options = {}) : hierarchy_(options) {}

  /// Makes the hierarchy of a graph with conductances and excess; `compute` then keeps it, until `forget`.
  vcycle_preconditioner& assign(const network_graph& graph, std::span<const double> weights,
                                std::span<const double> excess) {
    if (!graph.same_as(graph_)) {
      hierarchy_.analyze(graph);
      graph_ = graph;
    }
    hierarchy_.factorize(weights, excess);
    size_ = static_cast<Eigen::Index>(graph.node_count());
    assigned_ = true;
    info_ = Eigen::Success;
    return *this;
  }
  void forget() noexcept { assigned_ = false; }

  template <class Matrix>
  vcycle_preconditioner& analyzePattern(const Matrix&) {
    return *this;
  }
  template <class Matrix>
  vcycle_preconditioner& factorize(const Matrix& matrix) {
    return compute(matrix);
  }

  /// The hierarchy of a symmetric matrix with non-positive entries off a dominant diagonal, unless one was assigned.
  /// Its excess is what the diagonal exceeds the sum of its row by, and is taken as zero where rounding hides it;
  /// info() is NumericalIssue where an entry off the diagonal is positive or a diagonal too small.
  template <class Matrix>
  vcycle_preconditioner& compute(const Matrix& matrix) {
    if (assigned_) {
      if (matrix.rows() != size_) {
        info_ = Eigen::InvalidInput;
      }
      return *this;
    }
    const auto n = static_cast<std::size_t>(matrix.rows());
    std::vector<network_graph::edge> edges;
    std::vector<double> weights;
    std::vector<double> diagonal(n, 0.0);
    std::vector<double> sums(n, 0.0);
    info_ = Eigen::Success;
    for (Eigen::Index k = 0; k < matrix.outerSize(); ++k) {
      for (typename Matrix::InnerIterator entry(matrix, k); entry; ++entry) {
        const auto i = static_cast<std::uint32_t>(entry.row());
        const auto j = static_cast<std::uint32_t>(entry.col());
        if (i == j) {
          diagonal[i] += entry.value();
        } else if (i > j) {
          edges.push_back({i, j});
          weights.push_back(-entry.value());
          sums[i] -= entry.value();
          sums[j] -= entry.value();
          info_ = entry.value() > 0 ? Eigen::NumericalIssue : info_;
        }
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      const double rest = diagonal[i] - sums[i];
      const double rounding = 1e-12 * diagonal[i];
      info_ = rest < -rounding ? Eigen::NumericalIssue : info_;
      sums[i] = rest > rounding ? rest : 0.0;
    }
    if (info_ == Eigen::Success) {
      assign(network_graph(n, std::move(edges)), weights, sums);
      assigned_ = false;
    }
    return *this;
  }

  template <class Rhs>
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::MatrixBase<Rhs>& b) const {
    in_ = b;
    Eigen::VectorXd x(b.rows());
    const auto n = static_cast<std::size_t>(b.rows());
    hierarchy_.apply(std::span<const double>(in_.data(), n), std::span<double>(x.data(), n));
    return x;
  }

  [[nodiscard]] Eigen::ComputationInfo info() const noexcept { return info_; }
  [[nodiscard]] Eigen::Index rows() const noexcept { return size_; }
  [[nodiscard]] Eigen::Index cols() const noexcept { return size_; }

 private:
  mutable aggregation_hierarchy<Real> hierarchy_;  // works in itself
  mutable Eigen::VectorXd in_;
  network_graph graph_;
  Eigen::Index size_ = 0;
  bool assigned_ = false;
  Eigen::ComputationInfo info_ = Eigen::InvalidInput;
};

/// Eigen's conjugate gradients on w and s (only the preconditioner may see an assembled matrix), restarted from the
/// residual evaluated anew. Ends as multigrid_solver does: on the scaled residual, the backward error, and an estimate
/// of the error of x by a V-cycle of the residual, whatever the preconditioner; or when the estimate falls no more.
/// \tparam Preconditioner  any of Eigen's: DiagonalPreconditioner<double>, IncompleteCholesky<double>, or our V-cycle.
///         With the first two a large system needs thousands of iterations: raise options.max_iterations. They do not
///         converge at any contrast; the V-cycle made beside them for the estimate then says so
template <class Preconditioner = vcycle_preconditioner<>>
class eigen_cg_solver {
 public:
  void analyze(const network_graph& graph) {
    system_.analyze(graph);
    ready_ = false;
  }

  [[nodiscard]] solve_report factorize(std::span<const double> weights, std::span<const double> excess) {
    ready_ = false;
    solve_report report = system_.factorize(weights, excess);
    if (!report.ok() || system_.size() == 0) {
      ready_ = report.ok();
      return report;
    }
    const std::vector<double> grounded = system_.grounded_excess();
    if constexpr (!own_estimate) {
      preconditioner().compute(laplacian(system_.graph(), system_.weights(), grounded));
    }
    estimator().assign(system_.graph(), system_.weights(), grounded);
    operator_->assign(system_.graph(), system_.weights(), grounded);
    cg_->compute(*operator_);
    ready_ = preconditioner().info() == Eigen::Success;
    report.reason = ready_ ? solve_status::ok : solve_status::factorization_failed;
    return report;
  }

  [[nodiscard]] solve_report solve(std::span<const double> b, std::span<double> x, const solve_options& options = {}) {
    if (!ready_) {
      return {};
    }
    solve_report report = system_.begin(b, x, options);
    if (!report.ok()) {
      return report;
    }
    if (!options.warm) {
      std::fill(x.begin(), x.end(), 0.0);
    }
    residual_.resize(x.size());
    if (system_.size() > 0) {
      iterate(x, options, report);
    } else {
      report.stop = solve_stop::converged;
    }
    system_.finish(x, options, report);
    return report;
  }

  [[nodiscard]] const pressure_system& system() const noexcept { return system_; }
  [[nodiscard]] Preconditioner& preconditioner() noexcept { return cg_->preconditioner(); }

 private:
  static constexpr bool own_estimate =
      requires(Preconditioner& p, const network_graph& graph, std::span<const double> in) { p.assign(graph, in, in); };
  struct no_estimator {};
  using cg =
      Eigen::ConjugateGradient<detail::flux_operator, Eigen::Lower | Eigen::Upper, detail::ready_made<Preconditioner>>;

  [[nodiscard]] auto& estimator() noexcept {
    if constexpr (own_estimate) {
      return preconditioner();
    } else {
      return estimator_;
    }
  }

  /// What x leaves: its scaled residual, its backward error, and its estimated error.
  struct measure {
    double scaled, backward, error;
  };
  [[nodiscard]] measure measured(std::span<double> x) {
    system_.center(x);
    system_.residual(system_.sources(), x, residual_);
    Eigen::VectorXd z = estimator().estimator_type::solve(detail::as_eigen(std::span<const double>(residual_)));
    system_.center(std::span<double>(z.data(), x.size()));
    const auto size = [](std::span<const double> v) { return detail::as_eigen(v).template lpNorm<Eigen::Infinity>(); };
    const double x_norm = size(x);
    const double r_norm = size(residual_);
    const double z_norm = z.lpNorm<Eigen::Infinity>();
    return {system_.scaled_norm(residual_),
            r_norm > 0 ? r_norm / (size(system_.sources()) + system_.norm() * x_norm) : 0.0,
            x_norm > 0 || !(z_norm <= 0) ? z_norm / x_norm : 0.0};
  }

  /// Runs of conjugate gradients, each from the residual of x, until that and its V-cycle are small; the x of the least
  /// estimated error.
  void iterate(std::span<double> x, const solve_options& options, solve_report& report) {
    const double target = options.tolerance * system_.scaled_norm(system_.sources());
    measure now = measured(x);
    double least = now.error;
    best_.assign(x.begin(), x.end());
    report.stop = solve_stop::converged;
    int fruitless = 0;
    for (bool first = true; !(now.error <= options.error_target() && now.backward <= options.tolerance &&
                              (now.scaled <= target || !first));
         first = false) {
      if (report.iterations >= options.max_iterations || fruitless > 2) {
        report.stop = fruitless > 2 ? solve_stop::stagnated : solve_stop::max_iterations;
        std::copy(best_.begin(), best_.end(), x.begin());
        now.error = least;
        break;
      }
      // a later run has only the rest of the way to go, and aims lower, for its residual lags behind the error
      const double rest = std::min(now.scaled > target ? target / now.scaled : 1.0, options.error_target() / now.error);
      cg_->setTolerance(first && !options.warm ? options.tolerance : std::clamp(1e-5 * rest, options.tolerance, 1e-5));
      cg_->setMaxIterations(static_cast<Eigen::Index>(options.max_iterations - report.iterations));
      detail::as_eigen(std::span<double>(residual_)).array() /= operator_->root().array();
      const Eigen::VectorXd step = cg_->solve(detail::as_eigen(std::span<const double>(residual_)));
      report.iterations += static_cast<std::size_t>(cg_->iterations()) + (cg_->info() == Eigen::Success ? 1U : 0U);
      detail::as_eigen(x).array() += step.array() / operator_->root().array();
      now = measured(x);
      fruitless = now.error < 0.5 * least ? 0 : fruitless + 1;
      if (!(now.error >= least)) {
        least = now.error;
        best_.assign(x.begin(), x.end());
      }
    }
    report.error_estimate = now.error;
  }

  using estimator_type = std::conditional_t<own_estimate, Preconditioner, vcycle_preconditioner<float>>;

  pressure_system system_;
  [[no_unique_address]] std::conditional_t<own_estimate, no_estimator, estimator_type> estimator_;
  // at fixed addresses: Eigen's solvers do not move, and keep a reference to the operator
  std::unique_ptr<detail::flux_operator> operator_ = std::make_unique<detail::flux_operator>();
  std::unique_ptr<cg> cg_ = std::make_unique<cg>();
  bool ready_ = false;
  std::vector<double> residual_;
  std::vector<double> best_;  // x of the least estimated error
};
static_assert(network_solver<eigen_cg_solver<>>);

}  // namespace tetrapore::inline TETRAPORE_ABI
