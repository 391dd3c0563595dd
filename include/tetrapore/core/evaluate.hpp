// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/executor.hpp"
#include "tetrapore/core/outcome.hpp"

#include <array>
#include <cstddef>
#include <mutex>

/// \file
/// A law applied to many simplices.

namespace tetrapore::inline TETRAPORE_ABI {

/// How often a law gave each verdict, and the first index that did.
struct tally {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  std::array<std::size_t, verdict_count> count{};
  std::array<std::size_t, verdict_count> first{none, none, none, none};

  constexpr void add(verdict v, std::size_t index) noexcept {
    const auto k = static_cast<std::size_t>(v);
    ++count[k];
    if (index < first[k]) {
      first[k] = index;
    }
  }
  constexpr void add(const tally& other) noexcept {
    for (std::size_t k = 0; k < verdict_count; ++k) {
      count[k] += other.count[k];
      if (other.first[k] < first[k]) {
        first[k] = other.first[k];
      }
    }
  }
  [[nodiscard]] constexpr std::size_t operator[](verdict v) const noexcept {
    return count[static_cast<std::size_t>(v)];
  }
};

/// Applies a law to the simplices 0 … n-1.
/// \param law     law(simplex) -> outcome
/// \param gather  gather(index) -> simplex
/// \param sink    sink(index, outcome) writes the caller's columns; called from the executor's threads, once per index
template <executor E, class Law, class Gather, class Sink>
tally evaluate(const E& cores, std::size_t n, const Law& law, const Gather& gather, Sink&& sink) {
  tally total;
  std::mutex merge;
  cores.blocks(n, [&](std::size_t begin, std::size_t end) {
    tally mine;
    for (std::size_t i = begin; i < end; ++i) {
      const auto answer = law(gather(i));
      mine.add(answer.kind(), i);
      sink(i, answer);
    }
    const std::lock_guard lock(merge);
    total.add(mine);
  });
  return total;
}

}  // namespace tetrapore::inline TETRAPORE_ABI
