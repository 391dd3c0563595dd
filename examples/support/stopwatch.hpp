// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

#include <sys/resource.h>

/// \file
/// Time and memory of a run.

namespace support {

/// Seconds since the last lap.
class stopwatch {
 public:
  [[nodiscard]] double lap() {
    const auto now = clock::now();
    const std::chrono::duration<double> passed = now - last_;
    last_ = now;
    return passed.count();
  }

 private:
  using clock = std::chrono::steady_clock;
  clock::time_point last_ = clock::now();
};

/// The most memory that this process held at once [MB of 2^20 bytes].
[[nodiscard]] inline double peak_rss_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace support
