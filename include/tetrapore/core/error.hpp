// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/contracts.hpp"

#include <cstdio>
#include <stdexcept>
#include <string>

/// \file
/// Errors of set-up: thrown before anything is changed, and they name the place, the value and what was expected.

namespace tetrapore::inline TETRAPORE_ABI {

/// A number for a message: six digits, whatever its size. (std::to_string writes 1e-7 as 0.000000.)
[[nodiscard]] inline std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// Base of every exception of tetrapore.
class setup_error : public std::runtime_error {
 public:
  /// \param where     file and line, grain, throat, option …: "packing.txt:12", "grain 7"
  /// \param found     the offending value, as it was read
  /// \param expected  what would have been accepted
  setup_error(const std::string& where, const std::string& found, const std::string& expected)
      : std::runtime_error(where + ": found " + found + ", expected " + expected) {}
};

/// A file that cannot be read, or says what it may not. Names file and line (or byte).
class input_error : public setup_error {
 public:
  using setup_error::setup_error;
};

/// A set of spheres or a box that cannot be triangulated. Names the grain.
class packing_error : public setup_error {
 public:
  using setup_error::setup_error;
};

/// Arrays that do not form a network. Names the pore or throat.
class network_error : public setup_error {
 public:
  using setup_error::setup_error;
};

/// A parameter outside its domain. Names the parameter.
class parameter_error : public setup_error {
 public:
  using setup_error::setup_error;
};

}  // namespace tetrapore::inline TETRAPORE_ABI
