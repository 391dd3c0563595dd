// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdio>

/// \file
/// What a program tells other programs.

namespace support {

/// Prints lines KEY=VALUE on stdout.
struct key_printer {
  int digits = 10;  ///< of a number that is no count

  void operator()(const char* key, double value) const { std::printf("%s=%.*g\n", key, digits, value); }
  void operator()(const char* key, std::size_t value) const { std::printf("%s=%zu\n", key, value); }
};

}  // namespace support
