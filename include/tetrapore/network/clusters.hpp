// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/contracts.hpp"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

/// \file
/// Clusters of pores by union-find.

namespace tetrapore::inline TETRAPORE_ABI {

/// Disjoint sets of 0 … n-1, by union by size with path halving: near-constant time per operation.
class disjoint_sets {
 public:
  explicit disjoint_sets(std::size_t n) : parent_(n), size_(n, 1) { std::iota(parent_.begin(), parent_.end(), 0U); }

  [[nodiscard]] std::size_t find(std::size_t i) noexcept {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  /// Unites the sets of a and b; returns the representative.
  std::size_t unite(std::size_t a, std::size_t b) noexcept {
    a = find(a);
    b = find(b);
    if (a == b) {
      return a;
    }
    if (size_[a] < size_[b]) {
      std::swap(a, b);
    }
    parent_[b] = static_cast<std::uint32_t>(a);
    size_[a] += size_[b];
    return a;
  }
  [[nodiscard]] bool same(std::size_t a, std::size_t b) noexcept { return find(a) == find(b); }
  /// Number of members of the set of i.
  [[nodiscard]] std::size_t size_of(std::size_t i) noexcept { return size_[find(i)]; }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint32_t> size_;
};

}  // namespace tetrapore::inline TETRAPORE_ABI
