// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

/// \file
/// Where the tests find their data. TETRAPORE_TEST_DATA is the folder tests/ of this project; TETRAPORE_SHARED_DIR
/// holds the packings and tables that do not ship with it.

/// A file under TETRAPORE_SHARED_DIR. Where it is absent the test says so and gets nothing, so that it can return;
/// with TETRAPORE_REQUIRE_SHARED=1 in the environment the absence is a failure.
[[nodiscard]] inline std::optional<std::filesystem::path> shared_file(std::string_view name) {
  const std::filesystem::path path = std::filesystem::path(TETRAPORE_SHARED_DIR) / name;
  if (std::filesystem::exists(path)) {
    return path;
  }
  const char* required = std::getenv("TETRAPORE_REQUIRE_SHARED");
  if (required != nullptr && std::string_view(required) == "1") {
    FAIL_CHECK("required data is absent: " << path.string());
  } else {
    MESSAGE("skipped, data is absent: " << path.string());
  }
  return std::nullopt;
}

/// A file under tests/, which ships with the project and is always there.
[[nodiscard]] inline std::filesystem::path test_file(std::string_view name) {
  return std::filesystem::path(TETRAPORE_TEST_DATA) / name;
}
