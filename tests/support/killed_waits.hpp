// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/rest.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

/// \file
/// Experiments that are killed and go on, with their states in memory. An experiment is a function of the waits that it
/// keeps, none or some, to the numbers of its result.

namespace killed_waits {

using namespace tetrapore::lbm;

using states = std::map<std::size_t, std::vector<std::byte>>;
struct killed {};

/// Keeps states in memory and throws `killed` in place of the save behind so many.
class memory final : public kept_waits {
 public:
  explicit memory(states& all, std::size_t lives = 1000000) : all_(&all), lives_(lives) {}
  [[nodiscard]] std::optional<std::vector<std::byte>> load(std::size_t wait) override {
    const auto found = all_->find(wait);
    return found == all_->end() ? std::nullopt : std::optional(found->second);
  }
  void save(std::size_t wait, const std::vector<std::byte>& state) override {
    if (saves_ == lives_) {
      throw killed{};
    }
    (*all_)[wait] = state;
    ++saves_;
  }
  [[nodiscard]] std::size_t saves() const noexcept { return saves_; }

 private:
  states* all_;
  std::size_t lives_;
  std::size_t saves_ = 0;
};

/// The numbers of a result, its report among them.
inline std::vector<double> with_rest(std::vector<double> own, const rest_report& r) {
  own.insert(own.end(),
             {r.change, static_cast<double>(r.steps), static_cast<double>(r.updates), static_cast<double>(r.end)});
  return own;
}

/// An experiment that is killed at its first save, its last or between goes on to what it would have been, and runs
/// nothing twice.
/// \param waits  that it has at least
/// \return the states of the whole one
template <class Experiment>
states goes_on_to_the_bit(Experiment experiment, std::size_t waits) {
  const std::vector<double> whole = experiment(nullptr);
  states all;
  memory watched(all);
  CHECK(experiment(&watched) == whole);
  CHECK(all.size() >= waits);
  CHECK(watched.saves() > waits);
  const std::size_t last = watched.saves() - 1;
  for (const std::size_t lives : {std::size_t{0}, last / 4, last / 2, last * 3 / 4, last}) {
    states some;
    memory first(some, lives);
    CHECK_THROWS_AS(static_cast<void>(experiment(&first)), killed);
    memory second(some);
    CHECK(experiment(&second) == whole);
    CHECK(lives + second.saves() == watched.saves());
  }
  memory finished(all);
  CHECK(experiment(&finished) == whole);
  CHECK(finished.saves() == 0);
  states without_first = all;
  without_first.erase(0);
  memory lost(without_first);
  CHECK(experiment(&lost) == whole);
  CHECK(lost.saves() > 0);
  return all;
}

template <class Experiment>
void refuses(states all, Experiment experiment) {
  const states before = all;
  memory kept(all);
  CHECK_THROWS_AS(static_cast<void>(experiment(&kept)), tetrapore::input_error);
  CHECK(all == before);
}

}  // namespace killed_waits
