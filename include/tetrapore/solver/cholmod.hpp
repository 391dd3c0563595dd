// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/solver/direct.hpp"
#include "tetrapore/solver/lower_triangle.hpp"

#include <cholmod.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <span>
#include <utility>
#include <vector>

/// \file
/// CHOLMOD as a solver of pressure systems. The only header that sees CHOLMOD; its Supernodal and Modify modules are
/// GPL-2.0-or-later, and so is a program that includes this header.

namespace tetrapore::inline TETRAPORE_ABI {

namespace detail {

/// CHOLMOD's state: settings, workspace, the status of the last call.
class cholmod_session {
 public:
  cholmod_session() : common_(std::make_unique<cholmod_common>()) {
    if (cholmod_l_start(common_.get()) == 0) {
      throw std::bad_alloc();
    }
    common_->print = 0;  // it says what is wrong by its status alone
  }
  cholmod_session(const cholmod_session&) = delete;
  cholmod_session& operator=(const cholmod_session&) = delete;
  ~cholmod_session() { cholmod_l_finish(common_.get()); }

  [[nodiscard]] cholmod_common* get() const noexcept { return common_.get(); }
  [[nodiscard]] int status() const noexcept { return common_->status; }

 private:
  std::unique_ptr<cholmod_common> common_;
};

/// An object of CHOLMOD, freed in its session.
template <class T, int (*Free)(T**, cholmod_common*)>
class cholmod_owned {
 public:
  explicit cholmod_owned(cholmod_session& session) : session_(&session) {}
  cholmod_owned(const cholmod_owned&) = delete;
  cholmod_owned& operator=(const cholmod_owned&) = delete;
  ~cholmod_owned() { reset(nullptr); }

  void reset(T* object) noexcept {
    if (object_ != nullptr) {
      Free(&object_, session_->get());
    }
    object_ = object;
  }
  [[nodiscard]] T* get() const noexcept { return object_; }
  [[nodiscard]] T** address() noexcept { return &object_; }
  [[nodiscard]] T* operator->() const noexcept { return object_; }
  explicit operator bool() const noexcept { return object_ != nullptr; }

 private:
  cholmod_session* session_;
  T* object_ = nullptr;
};

}  // namespace detail

/// What a cholmod_factorization is asked for.
struct cholmod_settings {
  /// Refinements on w and s that every solution gets, each for the price of a solution: one mends what assembling the
  /// matrix has lost (error 2e-8 to 3e-15 at a contrast of 5e19). 0 where only speed counts.
  std::size_t refinements = 1;
  /// Up to so many conductances and excesses that differ from those of the factor at hand are taken into it by rank-1
  /// updates and downdates; with more, or with 0, factorize starts anew. An updated factor differs from a new one in
  /// its last bits, and is kept by columns, without the speed of blocks.
  std::size_t update_limit = 0;
  /// After so many updates the factor is made anew, and also where the diagonal of a node falls below 1e-7 of the
  /// largest that the factor has held: rounding stays behind.
  std::size_t wear_limit = 1000;
};

/// Sparse Cholesky factor of SuiteSparse: fill-reducing order and pattern once per graph, blocks handed to the BLAS.
/// Every index has 64 bits, so that a factor may have more than 2^31 entries.
/// \par Accuracy  the matrix is assembled: see lower_triangle. direct_solver refines on w and s
/// \par Source  Chen, Davis, Hager & Rajamanickam, ACM Trans. Math. Softw. 35, 22 (2008)
class cholmod_factorization {
 public:
  cholmod_factorization() : cholmod_factorization(cholmod_settings{}) {}
  explicit cholmod_factorization(const cholmod_settings& settings)
      : settings_(settings), s_(std::make_unique<state>()) {}

  /// \throw std::bad_alloc  no memory for order and pattern
  void analyze(const network_graph& graph) {
    s_->factor.reset(nullptr);
    s_->symbolic.reset(nullptr);
    s_->solution.reset(nullptr);
    s_->work.reset(nullptr);
    s_->more_work.reset(nullptr);
    triangle_ = lower_triangle<SuiteSparse_long>(graph);
    values_.assign(triangle_.rows().size(), 1.0);
    place_.resize(triangle_.size());
    if (place_.empty()) {
      return;
    }
    cholmod_sparse matrix = view();
    s_->symbolic.reset(cholmod_l_analyze(&matrix, s_->session.get()));
    if (!s_->symbolic) {
      throw std::bad_alloc();
    }
    const auto* order = static_cast<const SuiteSparse_long*>(s_->symbolic->Perm);
    for (std::size_t k = 0; k < place_.size(); ++k) {
      place_[static_cast<std::size_t>(order[k])] = static_cast<SuiteSparse_long>(k);
    }
  }

  /// False where the matrix is not positive definite in double precision, or memory runs out.
  [[nodiscard]] bool factorize(const network_graph& graph, std::span<const double> weights,
                               std::span<const double> excess) {
    if (s_->factor && update(graph, weights, excess)) {
      return true;
    }
    updates_ = 0;
    s_->factor.reset(nullptr);
    if (triangle_.size() == 0) {
      return true;
    }
    s_->factor.reset(cholmod_l_copy_factor(s_->symbolic.get(), s_->session.get()));
    if (!s_->factor) {
      return false;
    }
    triangle_.fill(graph, weights, excess, values_);
    cholmod_sparse matrix = view();
    cholmod_l_factorize(&matrix, s_->factor.get(), s_->session.get());
    if (!sound()) {
      s_->factor.reset(nullptr);
      return false;
    }
    if (settings_.update_limit > 0) {
      weights_.assign(weights.begin(), weights.end());
      excess_.assign(excess.begin(), excess.end());
      diagonal_.resize(triangle_.size());
      for (std::size_t i = 0; i < diagonal_.size(); ++i) {
        diagonal_[i] = values_[static_cast<std::size_t>(triangle_.offsets()[i])];
      }
      largest_ = diagonal_;
    }
    return true;
  }

  /// x = A⁻¹ b for one b or for several one after the other. False where memory runs out; x is then unchanged.
  [[nodiscard]] bool apply(std::span<const double> b, std::span<double> x) {
    const std::size_t n = triangle_.size();
    if (n == 0) {
      return true;
    }
    cholmod_dense rhs{};
    rhs.nrow = n;
    rhs.ncol = b.size() / n;
    rhs.nzmax = b.size();
    rhs.d = n;
    rhs.x = const_cast<double*>(b.data());  // read only; the interface is C's
    rhs.xtype = CHOLMOD_REAL;
    rhs.dtype = CHOLMOD_DOUBLE;
    const int done = cholmod_l_solve2(CHOLMOD_A, s_->factor.get(), &rhs, nullptr, s_->solution.address(), nullptr,
                                      s_->work.address(), s_->more_work.address(), s_->session.get());
    if (done == 0) {
      return false;
    }
    const auto* solution = static_cast<const double*>(s_->solution->x);
    std::copy(solution, solution + b.size(), x.begin());
    return true;
  }

  [[nodiscard]] std::size_t refinements() const noexcept { return settings_.refinements; }
  /// Rank-1 changes since the factor was last made anew.
  [[nodiscard]] std::size_t updates() const noexcept { return updates_; }
  [[nodiscard]] const cholmod_settings& settings() const noexcept { return settings_; }
  /// Entries of the factor, as the analysis counts them.
  [[nodiscard]] double entries() const noexcept { return s_->session.get()->lnz; }

 private:
  struct state {  // at a fixed address, since its members know the session
    detail::cholmod_session session;
    detail::cholmod_owned<cholmod_factor, cholmod_l_free_factor> symbolic{session};
    detail::cholmod_owned<cholmod_factor, cholmod_l_free_factor> factor{session};
    detail::cholmod_owned<cholmod_dense, cholmod_l_free_dense> solution{session};
    detail::cholmod_owned<cholmod_dense, cholmod_l_free_dense> work{session};
    detail::cholmod_owned<cholmod_dense, cholmod_l_free_dense> more_work{session};
  };

  /// A column of the matrix C of a change A ± C Cᵀ: ± v (e_i − e_j)(e_i − e_j)ᵀ, or ± v e_i e_iᵀ where i = j.
  struct change {
    std::size_t i;
    std::size_t j;
    double by;
  };

  /// Takes the changes since the last factor into it, or says that a new one is due.
  [[nodiscard]] bool update(const network_graph& graph, std::span<const double> weights,
                            std::span<const double> excess) {
    if (weights_.size() != weights.size() || excess_.size() != excess.size() || settings_.update_limit == 0) {
      return false;
    }
    changes_.clear();
    const auto admit = [&](std::size_t i, std::size_t j, double by) {
      changes_.push_back({i, j, by});
      return changes_.size() <= settings_.update_limit;
    };
    for (std::size_t e = 0; e < weights.size(); ++e) {
      if (weights[e] != weights_[e] && !admit(graph.edges()[e][0], graph.edges()[e][1], weights[e] - weights_[e])) {
        return false;
      }
    }
    for (std::size_t i = 0; i < excess.size(); ++i) {
      if (excess[i] != excess_[i] && !admit(i, i, excess[i] - excess_[i])) {
        return false;
      }
    }
    if (updates_ + changes_.size() > settings_.wear_limit || !keeps_digits()) {
      return false;
    }
    updates_ += changes_.size();
    if (!apply_changes(true) || !apply_changes(false)) {  // rising first: the matrix stays definite all along
      return false;
    }
    weights_.assign(weights.begin(), weights.end());
    excess_.assign(excess.begin(), excess.end());
    return true;
  }

  [[nodiscard]] bool keeps_digits() {
    for (const bool rising : {true, false}) {
      for (const change& c : changes_) {
        if ((c.by > 0) == rising) {
          for (const std::size_t node : {c.i, c.j}) {
            diagonal_[node] += c.i == c.j ? 0.5 * c.by : c.by;
            largest_[node] = std::max(largest_[node], diagonal_[node]);
          }
        }
      }
    }
    return std::all_of(changes_.begin(), changes_.end(), [&](const change& c) {
      return diagonal_[c.i] > 1e-7 * largest_[c.i] && diagonal_[c.j] > 1e-7 * largest_[c.j];
    });
  }

  [[nodiscard]] bool apply_changes(bool rising) {
    columns_.assign(1, 0);
    entries_.clear();
    entry_rows_.clear();
    for (const change& c : changes_) {
      if ((c.by > 0) != rising) {
        continue;
      }
      const double root = std::sqrt(std::abs(c.by));
      const std::array<SuiteSparse_long, 2> rows{place_[c.i], place_[c.j]};
      entry_rows_.push_back(std::min(rows[0], rows[1]));
      entries_.push_back(root);
      if (c.i != c.j) {
        entry_rows_.push_back(std::max(rows[0], rows[1]));
        entries_.push_back(-root);
      }
      columns_.push_back(static_cast<SuiteSparse_long>(entries_.size()));
    }
    if (entries_.empty()) {
      return true;
    }
    cholmod_sparse matrix = matrix_of(triangle_.size(), columns_, entry_rows_, entries_, 0);
    return cholmod_l_updown(rising ? 1 : 0, &matrix, s_->factor.get(), s_->session.get()) != 0 && sound();
  }

  /// Whether the factor is one of a positive definite matrix.
  [[nodiscard]] bool sound() const noexcept {
    const cholmod_factor& f = *s_->factor.get();
    if (s_->session.status() != CHOLMOD_OK || f.minor != f.n) {
      return false;
    }
    if (f.is_ll != 0) {
      return true;
    }
    const auto* begins = static_cast<const SuiteSparse_long*>(f.p);
    const auto* values = static_cast<const double*>(f.x);
    for (std::size_t j = 0; j < f.n; ++j) {
      if (!(values[begins[j]] > 0)) {
        return false;
      }
    }
    return true;
  }

  /// CHOLMOD's view of arrays, which it reads only.
  [[nodiscard]] static cholmod_sparse matrix_of(std::size_t rows, std::span<const SuiteSparse_long> offsets,
                                                std::span<const SuiteSparse_long> indices,
                                                std::span<const double> values, int triangle) noexcept {
    cholmod_sparse m{};
    m.nrow = rows;
    m.ncol = offsets.size() - 1;
    m.nzmax = indices.size();
    m.p = const_cast<SuiteSparse_long*>(offsets.data());
    m.i = const_cast<SuiteSparse_long*>(indices.data());
    m.x = const_cast<double*>(values.data());
    m.stype = triangle;
    m.itype = CHOLMOD_LONG;
    m.xtype = CHOLMOD_REAL;
    m.dtype = CHOLMOD_DOUBLE;
    m.sorted = 1;
    m.packed = 1;
    return m;
  }
  [[nodiscard]] cholmod_sparse view() const noexcept {
    return matrix_of(triangle_.size(), triangle_.offsets(), triangle_.rows(), values_, -1);
  }

  cholmod_settings settings_;
  std::unique_ptr<state> s_;
  lower_triangle<SuiteSparse_long> triangle_;
  std::vector<double> values_;
  std::vector<SuiteSparse_long> place_;  ///< of each node in the order of elimination
  std::size_t updates_ = 0;
  // what the factor holds, where it may be updated
  std::vector<double> weights_;
  std::vector<double> excess_;
  std::vector<double> diagonal_;
  std::vector<double> largest_;
  std::vector<change> changes_;
  std::vector<SuiteSparse_long> columns_;
  std::vector<SuiteSparse_long> entry_rows_;
  std::vector<double> entries_;
};
static_assert(pressure_factor<cholmod_factorization>);

/// A cached Cholesky factor behind network_solver: the choice for many right-hand sides on one matrix, and for one that
/// changes in a few conductances at a time.
///
/// Several right-hand sides at once:
/// \code
/// cholmod_solver solver;
/// solver.analyze(graph);
/// solver.factorize(w, s);
/// solver.solve_many(b, x);  // b and x hold one system after the other
/// \endcode
class cholmod_solver : public direct_solver<cholmod_factorization> {
 public:
  using direct_solver::direct_solver;
  explicit cholmod_solver(const cholmod_settings& settings) : direct_solver(cholmod_factorization(settings)) {}

  /// Solves for several right-hand sides at once: b and x hold one system after the other. A report for each; a system
  /// that is refused leaves its part of x as it was. One report alone where nothing could be solved: no factor, arrays
  /// that do not fit, no memory.
  [[nodiscard]] std::vector<solve_report> solve_many(std::span<const double> b, std::span<double> x,
                                                     solve_options options = {}) {
    const std::size_t n = system().size();
    if (!ready() || n == 0 || b.size() % n != 0 || b.size() != x.size()) {
      solve_report report;
      report.reason = ready() ? solve_status::wrong_size : solve_status::not_factorized;
      return {report};
    }
    block_.resize(b.size());
    if (!factor().apply(b, block_)) {
      solve_report report;
      report.reason = solve_status::no_memory;
      return {report};
    }
    std::vector<solve_report> reports;
    for (std::size_t begin = 0; begin < b.size(); begin += n) {
      const auto of = [&](auto whole) { return whole.subspan(begin, n); };
      const std::span<double> start = of(std::span<double>(block_));
      options.warm = false;  // what has overflowed is no invalid start, but out of range
      reports.push_back(refined(of(b), start, options, origin::factor));
      if (reports.back().kind() != verdict::refused) {
        std::copy(start.begin(), start.end(), of(x).begin());
      }
    }
    return reports;
  }

 private:
  std::vector<double> block_;
};
static_assert(network_solver<cholmod_solver>);

}  // namespace tetrapore::inline TETRAPORE_ABI
