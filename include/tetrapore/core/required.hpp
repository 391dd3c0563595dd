// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/contracts.hpp"

#include <utility>

/// \file
/// A member of a parameter aggregate that has no sane default.

namespace tetrapore::inline TETRAPORE_ABI {

/// Holds a T and cannot be made without one: an aggregate that leaves such a member out does not compile.
template <class T>
class required {
 public:
  required() = delete;
  constexpr required(T value) noexcept : value_(std::move(value)) {}             // NOLINT(google-explicit-constructor)
  [[nodiscard]] constexpr operator const T&() const noexcept { return value_; }  // NOLINT(google-explicit-constructor)
  [[nodiscard]] constexpr const T& get() const noexcept { return value_; }

 private:
  T value_;
};

}  // namespace tetrapore::inline TETRAPORE_ABI
