// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/contracts.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

/// \file
/// Random numbers whose sequence depends on the seed alone: the same on every platform, unlike std distributions.

namespace tetrapore::inline TETRAPORE_ABI {

/// xoshiro256**, seeded by splitmix64.
/// \par Source  Blackman & Vigna, Scrambled linear pseudorandom number generators, ACM TOMS 47 (2021)
class random_sequence {
 public:
  explicit constexpr random_sequence(std::uint64_t seed) noexcept {
    for (auto& word : state_) {
      seed += 0x9e3779b97f4a7c15ULL;
      std::uint64_t z = seed;
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
      word = z ^ (z >> 31);
    }
  }

  [[nodiscard]] constexpr std::uint64_t bits() noexcept {
    const std::uint64_t result = rotate(state_[1] * 5, 7) * 9;
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = rotate(state_[3], 45);
    return result;
  }
  /// Uniform in [0, 1), a multiple of 2⁻⁵³.
  [[nodiscard]] constexpr double uniform() noexcept { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  /// Uniform among 0 … n-1, n > 0 (bias below n / 2⁵³).
  [[nodiscard]] constexpr std::size_t below(std::size_t n) noexcept {
    const auto k = static_cast<std::size_t>(uniform() * static_cast<double>(n));
    return k < n ? k : n - 1;
  }
  template <class T>
  constexpr void shuffle(std::vector<T>& values) noexcept {
    for (std::size_t i = values.size(); i > 1; --i) {
      std::swap(values[i - 1], values[below(i)]);
    }
  }

 private:
  [[nodiscard]] static constexpr std::uint64_t rotate(std::uint64_t x, int k) noexcept {
    return (x << k) | (x >> (64 - k));
  }
  std::array<std::uint64_t, 4> state_{};
};

}  // namespace tetrapore::inline TETRAPORE_ABI
