// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/lbm/farm.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <vector>

using namespace tetrapore;

TEST_CASE("every task is done once, on any number of threads") {
  for (const std::size_t threads : {0U, 1U, 2U, 7U}) {
    for (const std::size_t tasks : {0U, 1U, 3U, 100U}) {
      std::vector<int> done(tasks, 0);
      lbm::farm(
          tasks, [&](std::size_t k) { ++done[k]; }, threads);
      CHECK(done == std::vector<int>(tasks, 1));
    }
  }
}

TEST_CASE("a task that fails ends the farm with what it has thrown") {
  std::vector<int> begun(1000, 0);
  const auto work = [&](std::size_t k) {
    begun[k] = 1;
    if (k == 3) {
      throw std::runtime_error("the third");
    }
  };
  CHECK_THROWS_WITH_AS(lbm::farm(1000, work, 1), "the third", std::runtime_error);
  CHECK(begun[3] == 1);
  CHECK(begun[4] == 0);
  CHECK_THROWS_AS(lbm::farm(1000, work, 2), std::runtime_error);
  CHECK_THROWS_AS(lbm::farm(1, work, 5000), parameter_error);
}
