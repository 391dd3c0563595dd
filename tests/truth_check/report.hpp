// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// \file
/// What truth_check says of a law: one line.

namespace truth_check {

/// What one row says about one law.
struct row_result {
  bool solved = false;
  bool wrong = false;
  std::optional<double> error;             ///< relative, of the main results, where the table has a value
  double per_condition = 0;                ///< that error beyond the table's digits, over the condition
  double digits = 0;                       ///< relative half unit of the table's last digit; 0: finer than a double
  std::optional<double> derivative_error;  ///< relative, of the derivatives, where they are measured
  std::string name{};                      ///< of the row in the table, for who looks for what is wrong
};

struct law_report {
  std::string law;
  double stated_accuracy = 0;
  std::vector<row_result> rows;
  double nanoseconds = 0;
  std::vector<std::pair<std::string, double>> more;  ///< further numbers of a family of laws, printed at the end
};

inline double percentile_99(std::vector<double> x) {
  if (x.empty()) {
    return 0;
  }
  std::sort(x.begin(), x.end());
  const auto rank = (99 * x.size() + 99) / 100;
  return x[rank - 1];
}

/// Prints the line of a law, and on stderr the names of its wrong rows; returns how many these are.
inline std::size_t print(const law_report& r) {
  std::size_t solved = 0;
  std::size_t wrong = 0;
  double per_condition = 0;
  double digits = 0;
  std::vector<double> errors;
  std::vector<double> slopes;
  for (const auto& row : r.rows) {
    solved += row.solved ? 1U : 0U;
    if (row.wrong) {
      std::fprintf(stderr, "%s %s %s", wrong++ == 0 ? (r.law + " is wrong in").c_str() : ",", row.name.c_str(),
                   row.solved ? "" : "(no answer)");
    }
    per_condition = std::max(per_condition, row.per_condition);
    digits = std::max(digits, row.digits);
    if (row.error) {
      errors.push_back(*row.error);
    }
    if (row.derivative_error) {
      slopes.push_back(*row.derivative_error);
    }
  }
  if (wrong > 0) {
    std::fprintf(stderr, "\n");
  }
  const double worst = errors.empty() ? 0 : *std::max_element(errors.begin(), errors.end());
  std::printf(
      "law=%s rows=%zu solved=%zu refused=%zu wrong=%zu max_rel_err=%.3g p99_rel_err=%.3g ns_per_call=%.1f "
      "max_rel_err_per_condition=%.3g stated_accuracy=%.3g",
      r.law.c_str(), r.rows.size(), solved, r.rows.size() - solved, wrong, worst, percentile_99(errors), r.nanoseconds,
      per_condition, r.stated_accuracy);
  if (digits > 0) {
    std::printf(" table_digits=%.3g", digits);
  }
  if (!slopes.empty()) {
    std::printf(" max_rel_err_derivative=%.3g", *std::max_element(slopes.begin(), slopes.end()));
  }
  for (const auto& [name, value] : r.more) {
    std::printf(" %s=%.3g", name.c_str(), value);
  }
  std::printf("\n");
  return wrong;
}

/// Nanoseconds of call(i) for i < n, the best of several passes.
template <class Call>
double time_of(std::size_t n, const Call& call) {
  double best = 1e300;
  for (int pass = 0; pass < 25; ++pass) {
    const auto start = std::chrono::steady_clock::now();
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      sum += call(i);
    }
    const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - start;
    volatile double keep = sum;
    static_cast<void>(keep);
    best = std::min(best, spent.count() / static_cast<double>(n));
  }
  return best;
}

}  // namespace truth_check
