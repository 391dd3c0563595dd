// SPDX-License-Identifier: BSD-3-Clause
//
// Campaign: a million time steps of bridges that are stretched, compressed, filled, drained, ruptured and made again at
// random (docs/campaigns/bridge_steps.json). A campaign that has its file is not run again; one that was cut off goes
// on from the lives that it has kept beside it.
#include "support/bridge_steps.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>

TEST_CASE("a million time steps: never a wrong branch, work balances energy, what ruptures dissipate is booked") {
  const std::filesystem::path folder = TETRAPORE_CAMPAIGN_DIR;
  std::filesystem::create_directories(folder);
  const auto path = folder / "bridge_steps.json";
  const auto kept = folder / "bridge_steps.progress";
  if (std::filesystem::exists(path)) {
    MESSAGE("there already: " << path.filename().string());
    return;
  }
  constexpr int steps_of_life = 200;
  constexpr std::uint64_t lives = 5000;
  bridges::tally t;
  double seconds = 0;
  if (std::ifstream in(kept); in) {
    std::string word;
    REQUIRE(t.load(in));
    in >> word;
    seconds = std::strtod(word.c_str(), nullptr);
  }
  auto start = std::chrono::steady_clock::now();
  while (t.lives < lives) {
    bridges::life(1 + t.lives, t).run(steps_of_life);
    if (t.lives % 500 == 0) {
      const auto now = std::chrono::steady_clock::now();
      seconds += std::chrono::duration<double>(now - start).count();
      start = now;
      const auto part = kept.string() + ".part";
      std::ofstream out(part);
      t.save(out);
      out << seconds << '\n';
      out.close();
      std::filesystem::rename(part, kept);
      MESSAGE(t.steps << " steps");
    }
  }
  CHECK(t.steps >= lives * steps_of_life);
  bridges::check(t);
  const auto part = path.string() + ".part";
  std::ofstream out(part);
  out << "{\n  \"command\": \"tests/run.sh --long long_law\",\n  \"steps_of_a_life\": " << steps_of_life;
  bridges::tally::each(t, [&](const char* name, const auto& x) { out << ",\n  \"" << name << "\": " << x; });
  out << ",\n  \"seconds\": " << seconds << "\n}\n";
  out.close();
  std::filesystem::rename(part, path);
  std::filesystem::remove(kept);
}
