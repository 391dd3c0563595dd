// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/real.hpp"

#include <concepts>

/// \file
/// What a law answers: a value with its reason.

namespace tetrapore::inline TETRAPORE_ABI {

/// What a driver branches on.
enum class verdict : unsigned char {
  ok,       ///< the value holds
  absent,   ///< the exact limit: K = 0, p = infinity, F = 0; the value holds that limit
  refused,  ///< outside what the law covers; the value is NaN
  failed    ///< the law should have answered and could not; the value is NaN
};

inline constexpr std::size_t verdict_count = 4;

[[nodiscard]] constexpr const char* describe(verdict v) noexcept {
  switch (v) {
    case verdict::ok: return "ok";
    case verdict::absent: return "absent";
    case verdict::refused: return "refused";
    case verdict::failed: return "failed";
  }
  return "not a verdict";
}

/// A family's reasons: an enumeration with `verdict verdict_of(S)` and `const char* describe(S)`, found by
/// argument-dependent lookup.
template <class S>
concept status = std::copyable<S> && requires(S s) {
  { verdict_of(s) } -> std::same_as<verdict>;
  { describe(s) } -> std::convertible_to<const char*>;
};

/// A value and why it is what it is.
template <class V, status S>
struct outcome {
  V value;
  S reason;

  [[nodiscard]] constexpr verdict kind() const noexcept { return verdict_of(reason); }
  [[nodiscard]] constexpr bool ok() const noexcept { return kind() == verdict::ok; }
};

}  // namespace tetrapore::inline TETRAPORE_ABI
