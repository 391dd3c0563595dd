// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/contracts.hpp"

#include <concepts>
#include <cstddef>

/// \file
/// Who runs a loop over simplices.

namespace tetrapore::inline TETRAPORE_ABI {

namespace detail {
struct block_probe {
  void operator()(std::size_t, std::size_t) const {}
};
}  // namespace detail

/// Runs a loop in blocks of shared memory.
/// Syntax: `e.blocks(n, f)` calls f(begin, end) for blocks that partition [0, n).
/// Semantics: the blocks depend on n alone, never on the number of threads, so a loop that gathers (and does not
/// scatter) gives the same bits on any number of threads; blocks returns when all are done.
/// Models: serial; the OpenMP executor of parallel/.
template <class E>
concept executor = requires(const E e, std::size_t n, detail::block_probe f) { e.blocks(n, f); };

/// Runs everything in the calling thread.
struct serial {
  template <std::invocable<std::size_t, std::size_t> F>
  void blocks(std::size_t n, F&& f) const {
    if (n > 0) {
      f(std::size_t{0}, n);
    }
  }
};
static_assert(executor<serial>);

}  // namespace tetrapore::inline TETRAPORE_ABI
