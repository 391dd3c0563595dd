// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/network/network.hpp"

#include <Eigen/SparseCore>

#include <span>
#include <vector>

/// \file
/// A network as a sparse matrix of Eigen, for any solver that takes one. The only header that sees Eigen (MPL-2.0).

namespace tetrapore::inline TETRAPORE_ABI {

/// The matrix of Σ_j w_ij (x_i − x_j) + s_i x_i over the pores of a network.
/// \param weights  one per throat, at least 0; those of boundary throats are left out
/// \param excess   one per pore, at least 0: what ties a pore to a fixed level
/// \par Accuracy  each diagonal is a sum that rounds: where weights differ by a factor c within a row, the small ones
/// lose their digits beyond 1/(c ε). An oracle for moderate contrast
/// \par Source  Chareyre et al. 2017, Eq. (1)
[[nodiscard]] inline Eigen::SparseMatrix<double> laplacian(const network& net, std::span<const double> weights,
                                                           std::span<const double> excess) {
  TETRAPORE_EXPECTS(weights.size() == net.throat_count() && excess.size() == net.pore_count(),
                    "a weight for each throat, an excess for each pore");
  using entry = Eigen::Triplet<double, int>;
  std::vector<entry> entries;
  entries.reserve(net.pore_count() + 4 * net.throat_count());
  for (std::size_t i = 0; i < excess.size(); ++i) {
    entries.emplace_back(static_cast<int>(i), static_cast<int>(i), excess[i]);
  }
  for (std::size_t t = 0; t < weights.size(); ++t) {
    if (net.is_boundary(throat_id(t))) {
      continue;
    }
    const auto i = static_cast<int>(net.pores(throat_id(t))[0].index());
    const auto j = static_cast<int>(net.pores(throat_id(t))[1].index());
    entries.emplace_back(i, i, weights[t]);
    entries.emplace_back(j, j, weights[t]);
    entries.emplace_back(i, j, -weights[t]);
    entries.emplace_back(j, i, -weights[t]);
  }
  const auto n = static_cast<Eigen::Index>(net.pore_count());
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
