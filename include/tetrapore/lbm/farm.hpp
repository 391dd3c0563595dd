// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/error.hpp"

#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

/// \file
/// Many experiments side by side: one per core, never one over several.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// Calls task(0), task(1), …, each once, on as many threads as asked: each takes the next task when it is done with its
/// last, so that the long ones do well at the front. Tasks must not share what they write. What a task makes inside
/// itself lies in the memory next to its core; so let it make its experiment there.
/// What the first task that failed has thrown is thrown when all threads have stopped; no task begins behind it.
/// \par Domain    any number of tasks, 0 to 4096 threads
/// \param threads  0: as many as the machine has cores
/// \throw parameter_error    more threads
/// \throw std::system_error  a thread that cannot be started: when the others have stopped
template <class Task>
  requires std::invocable<Task&, std::size_t>
void farm(std::size_t tasks, Task task, std::size_t threads = 0) {
  if (threads > 4096) {
    throw parameter_error("farm", std::to_string(threads) + " threads", "at most 4096");
  }
  const std::size_t cores = std::max<std::size_t>(1, std::thread::hardware_concurrency());
  const std::size_t workers = std::min(tasks, threads == 0 ? cores : threads);
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failing;
  const auto work = [&] {
    for (std::size_t k = next++; k < tasks; k = next++) {
      try {
        task(k);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(failing);
        failure = failure ? failure : std::current_exception();
        next = tasks;
      }
    }
  };
  {
    std::vector<std::jthread> others;  // joined at the end of the block
    others.reserve(workers);
    try {
      for (std::size_t k = 1; k < workers; ++k) {
        others.emplace_back(work);
      }
    } catch (...) {
      next = tasks;
      throw;
    }
    work();
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
}

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
