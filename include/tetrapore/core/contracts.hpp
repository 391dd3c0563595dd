// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <cstdlib>

/// \file
/// Contracts: checks of what only a programming error can violate. Off by default; define TETRAPORE_CONTRACTS=1 to
/// print a message and abort at the first violation. Translation units with and without checks may be linked into one
/// program: the two modes live in different inline namespaces.

#ifndef TETRAPORE_CONTRACTS
#define TETRAPORE_CONTRACTS 0
#endif

#if TETRAPORE_CONTRACTS
#define TETRAPORE_ABI checked
#define TETRAPORE_EXPECTS(condition, message) \
  ((condition) ? static_cast<void>(0)         \
               : ::tetrapore::detail::contract_violation(__FILE__, __LINE__, #condition, message))
#else
#define TETRAPORE_ABI unchecked
#define TETRAPORE_EXPECTS(condition, message) static_cast<void>(0)
#endif

namespace tetrapore::inline TETRAPORE_ABI {
namespace detail {

[[noreturn]] inline void contract_violation(const char* file, int line, const char* condition, const char* message) {
  std::fprintf(stderr, "%s:%d: contract violated: %s (%s)\n", file, line, message, condition);
  std::abort();
}

}  // namespace detail
}  // namespace tetrapore::inline TETRAPORE_ABI
