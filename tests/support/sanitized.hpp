// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \file
/// Whether this is a sanitized build, in which a test that computes for long takes a smaller case.

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif
#elif defined(__SANITIZE_ADDRESS__)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif
