// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/ids.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

/// \file
/// The throats that gas could pass next, lowest threshold first.

namespace tetrapore::inline TETRAPORE_ABI {
namespace detail {

/// A throat of the front and the wet pore behind it.
struct front_entry {
  double key;  ///< lower end of the threshold's bracket [Pa]
  throat_id throat;
  pore_id target;

  /// Lower threshold first; among equals the lower id, so that the order is one and the same everywhere.
  [[nodiscard]] constexpr bool before(const front_entry& b) const noexcept {
    return key < b.key || (key == b.key && throat < b.throat);
  }
};

/// A heap of four children per node: half the levels of a binary one, and siblings share a cache line.
/// A key is revised by pushing the throat again; whoever pops drops what no longer holds.
class front_heap {
 public:
  [[nodiscard]] bool empty() const noexcept { return entries_.empty(); }
  [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }
  [[nodiscard]] const front_entry& top() const noexcept { return entries_.front(); }
  void clear() noexcept { entries_.clear(); }

  void push(const front_entry& e) {
    std::size_t hole = entries_.size();
    entries_.push_back(e);
    while (hole > 0) {
      const std::size_t parent = (hole - 1) / arity;
      if (!e.before(entries_[parent])) {
        break;
      }
      entries_[hole] = entries_[parent];
      hole = parent;
    }
    entries_[hole] = e;
  }

  void pop() noexcept {
    const front_entry last = entries_.back();
    entries_.pop_back();
    const std::size_t n = entries_.size();
    if (n == 0) {
      return;
    }
    std::size_t hole = 0;
    for (;;) {
      const std::size_t first = arity * hole + 1;
      if (first >= n) {
        break;
      }
      std::size_t best = first;
      for (std::size_t k = first + 1; k < std::min(first + arity, n); ++k) {
        best = entries_[k].before(entries_[best]) ? k : best;
      }
      if (!entries_[best].before(last)) {
        break;
      }
      entries_[hole] = entries_[best];
      hole = best;
    }
    entries_[hole] = last;
  }

 private:
  static constexpr std::size_t arity = 4;
  std::vector<front_entry> entries_;
};

}  // namespace detail
}  // namespace tetrapore::inline TETRAPORE_ABI
