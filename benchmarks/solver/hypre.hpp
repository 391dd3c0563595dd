// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/solver/graph.hpp"
#include "tetrapore/solver/solve_report.hpp"

#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_parcsr_ls.h>
#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// \file
/// The peer hypre as a solver of pressure systems, on one process: conjugate gradients with BoomerAMG as its
/// preconditioner, on the assembled matrix.

namespace bench {

/// MPI and hypre for the life of the program.
class hypre_session {
 public:
  static void begin() { static const hypre_session one; }
  hypre_session(const hypre_session&) = delete;
  hypre_session& operator=(const hypre_session&) = delete;

 private:
  hypre_session() {
    MPI_Init(nullptr, nullptr);
    HYPRE_Init();
  }
  ~hypre_session() {
    HYPRE_Finalize();
    MPI_Finalize();
  }
};

class hypre_solver {
 public:
  hypre_solver() { hypre_session::begin(); }
  hypre_solver(const hypre_solver&) = delete;
  hypre_solver& operator=(const hypre_solver&) = delete;
  ~hypre_solver() {
    if (matrix_ != nullptr) {
      HYPRE_ParCSRPCGDestroy(gradients_);
      HYPRE_BoomerAMGDestroy(multigrid_);
      HYPRE_IJVectorDestroy(x_);
      HYPRE_IJVectorDestroy(b_);
      HYPRE_IJMatrixDestroy(matrix_);
    }
  }

  void analyze(const tetrapore::network_graph& graph) { graph_ = graph; }

  /// Once for each solver.
  [[nodiscard]] tetrapore::solve_report factorize(std::span<const double> weights, std::span<const double> excess) {
    const auto n = static_cast<int>(graph_.node_count());
    rows_.resize(graph_.node_count());
    std::vector<int> length(rows_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      rows_[i] = static_cast<int>(i);
      length[i] = static_cast<int>(graph_.degree(i)) + 1;
    }
    HYPRE_IJMatrixCreate(MPI_COMM_SELF, 0, n - 1, 0, n - 1, &matrix_);
    HYPRE_IJMatrixSetObjectType(matrix_, HYPRE_PARCSR);
    HYPRE_IJMatrixSetRowSizes(matrix_, length.data());
    HYPRE_IJMatrixInitialize(matrix_);
    std::vector<int> columns;
    std::vector<double> values;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      columns.assign(1, rows_[i]);
      values.assign(1, excess[i]);
      const auto near = graph_.neighbours(i);
      for (std::size_t k = 0; k < near.size(); ++k) {
        const double w = weights[graph_.incident_edges(i)[k]];
        columns.push_back(static_cast<int>(near[k]));
        values.push_back(-w);
        values[0] += w;
      }
      HYPRE_IJMatrixAddToValues(matrix_, 1, &length[i], &rows_[i], columns.data(), values.data());
    }
    HYPRE_IJMatrixAssemble(matrix_);
    b_ = vector();
    x_ = vector();

    HYPRE_BoomerAMGCreate(&multigrid_);
    HYPRE_BoomerAMGSetCoarsenType(multigrid_, 10);  // HMIS
    HYPRE_BoomerAMGSetInterpType(multigrid_, 6);    // extended+i
    HYPRE_BoomerAMGSetPMaxElmts(multigrid_, 4);
    HYPRE_BoomerAMGSetStrongThreshold(multigrid_, 0.5);
    HYPRE_BoomerAMGSetRelaxType(multigrid_, 6);  // symmetric Gauss-Seidel
    HYPRE_BoomerAMGSetTol(multigrid_, 0);
    HYPRE_BoomerAMGSetMaxIter(multigrid_, 1);
    HYPRE_ParCSRPCGCreate(MPI_COMM_SELF, &gradients_);
    HYPRE_PCGSetTol(gradients_, 1e-10);
    HYPRE_PCGSetMaxIter(gradients_, 500);
    HYPRE_PCGSetPrecond(gradients_, reinterpret_cast<HYPRE_PtrToSolverFcn>(HYPRE_BoomerAMGSolve),
                        reinterpret_cast<HYPRE_PtrToSolverFcn>(HYPRE_BoomerAMGSetup), multigrid_);
    HYPRE_ParCSRPCGSetup(gradients_, matrix(), values_of(b_), values_of(x_));
    return status(HYPRE_GetError() == 0);
  }

  [[nodiscard]] tetrapore::solve_report solve(std::span<const double> b, std::span<double> x) {
    const auto n = static_cast<int>(rows_.size());
    HYPRE_IJVectorSetValues(b_, n, rows_.data(), b.data());
    HYPRE_ParVectorSetConstantValues(values_of(x_), 0.0);
    HYPRE_ParCSRPCGSolve(gradients_, matrix(), values_of(b_), values_of(x_));
    HYPRE_IJVectorGetValues(x_, n, rows_.data(), x.data());
    int steps = 0;
    HYPRE_PCGGetNumIterations(gradients_, &steps);
    tetrapore::solve_report report = status(HYPRE_GetError() == 0);
    report.iterations = static_cast<std::size_t>(steps);
    HYPRE_ClearAllErrors();
    return report;
  }

 private:
  [[nodiscard]] static tetrapore::solve_report status(bool well) {
    tetrapore::solve_report report;
    report.reason = well ? tetrapore::solve_status::ok : tetrapore::solve_status::not_converged;
    return report;
  }
  [[nodiscard]] HYPRE_IJVector vector() const {
    HYPRE_IJVector v = nullptr;
    HYPRE_IJVectorCreate(MPI_COMM_SELF, 0, static_cast<int>(rows_.size()) - 1, &v);
    HYPRE_IJVectorSetObjectType(v, HYPRE_PARCSR);
    HYPRE_IJVectorInitialize(v);
    HYPRE_IJVectorAssemble(v);
    return v;
  }
  [[nodiscard]] HYPRE_ParCSRMatrix matrix() const {
    void* object = nullptr;
    HYPRE_IJMatrixGetObject(matrix_, &object);
    return static_cast<HYPRE_ParCSRMatrix>(object);
  }
  [[nodiscard]] static HYPRE_ParVector values_of(HYPRE_IJVector v) {
    void* object = nullptr;
    HYPRE_IJVectorGetObject(v, &object);
    return static_cast<HYPRE_ParVector>(object);
  }

  tetrapore::network_graph graph_;
  std::vector<int> rows_;
  HYPRE_IJMatrix matrix_ = nullptr;
  HYPRE_IJVector b_ = nullptr;
  HYPRE_IJVector x_ = nullptr;
  HYPRE_Solver gradients_ = nullptr;
  HYPRE_Solver multigrid_ = nullptr;
};

}  // namespace bench
