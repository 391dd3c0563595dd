// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/io/read_packing.hpp"
#include "tetrapore/io/write_packing.hpp"
#include "tetrapore/packing/random.hpp"

#include "support/errors.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <string>

using namespace tetrapore;

namespace {

packing any_packing(std::uint64_t seed) {
  random_sequence random(seed);
  const double unit = std::pow(10.0, 12.0 * random.uniform() - 9.0);
  packing p;
  const std::size_t n = 1 + random.below(50);
  for (std::size_t i = 0; i < n; ++i) {
    p.grains.push_back(
        {vec3<double>{random.uniform(), random.uniform(), random.uniform()} * unit, unit * (random.uniform() + 1e-9)});
  }
  if (random.below(3) > 0) {
    p.bounds = box{{0, 0, 0}, {unit, unit, unit * 1.5}};
    p.periodic = {random.below(2) == 1, random.below(2) == 1, random.below(2) == 1};
  }
  return p;
}

}  // namespace

TEST_CASE("a packing written with 17 digits is read back bit for bit, box and periodic axes included") {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const auto p = any_packing(seed);
    const auto r = io::read_packing_from_memory(io::packing_text(p, {.comment = "one\ntwo x y z r"}), "p.txt");
    REQUIRE(r.packing.grains == p.grains);
    REQUIRE(r.packing.periodic == p.periodic);
    REQUIRE(r.packing.bounds.has_value() == p.bounds.has_value());
    if (p.bounds) {
      REQUIRE(r.packing.bounds->lo == p.bounds->lo);
      REQUIRE(r.packing.bounds->hi == p.bounds->hi);
    }
  }
}

TEST_CASE("fewer digits are right to half a unit of the last one") {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const auto p = any_packing(seed);
    const auto r = io::read_packing_from_memory(io::packing_text(p, {.digits = 6}), "p.txt", {.wrap = false});
    for (std::size_t i = 0; i < p.grains.size(); ++i) {
      REQUIRE(std::abs(r.packing.grains[i].radius / p.grains[i].radius - 1.0) <= 5.0001e-6);
    }
  }
}

TEST_CASE("a file is written whole, or not at all") {
  const auto path = std::filesystem::temp_directory_path() / "tetrapore_write_test.txt";
  const auto p = any_packing(7);
  io::write_packing(p, path);
  CHECK(io::read_packing(path).packing.grains == p.grains);
  std::filesystem::remove(path);
  CHECK_FALSE(message_of<io::output_error>([&] {
                io::write_packing(p, "no/such/folder/p.txt");
                return 0;
              }).empty());
  CHECK_FALSE(message_of<parameter_error>([&] { return io::packing_text(p, {.digits = 18}); }).empty());
}

TEST_CASE("cutting a text of stated length anywhere is noticed, or leaves the same grains") {
  auto p = any_packing(3);
  p.bounds = box{{-1e9, -1e9, -1e9}, {1e9, 1e9, 1e9}};
  p.periodic = {};
  const auto text = io::packing_text(p);
  const auto first_line = text.find('\n');
  for (std::size_t n = first_line + 1; n < text.size() - 1; ++n) {
    packing read;
    const auto refused = message_of<input_error>([&] {
      read = io::read_packing_from_memory(std::string_view(text).substr(0, n), "p.txt").packing;
      return 0;
    });
    if (refused.empty()) {
      // Only digits of the last number are missing: no reader of text can tell.
      REQUIRE(read.grains.size() == p.grains.size());
      REQUIRE(n > text.find_last_of(' '));
    }
  }
}
