// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/error.hpp"
#include "tetrapore/core/ids.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <string>

/// \file
/// What an option on a command line says, or a refusal that names the option, what it was given and what it takes.

namespace support {

[[noreturn]] inline void refuse(const std::string& option, const std::string& found, const std::string& expected) {
  throw tetrapore::parameter_error(option, "\"" + found + "\"", expected);
}

/// The number that an option gives, inside a range; `expected` says which.
template <class Accepts>
[[nodiscard]] double number_of(const std::string& option, const std::string& text, const Accepts& accepts,
                               const std::string& expected) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value) || !accepts(value)) {
    refuse(option, text, expected);
  }
  return value;
}

[[nodiscard]] inline tetrapore::face face_of(const std::string& option, const std::string& text) {
  for (const auto f : tetrapore::all_faces) {
    if (text == describe(f)) {
      return f;
    }
  }
  refuse(option, text, "one of x_min, x_max, y_min, y_max, z_min, z_max");
}

[[nodiscard]] inline std::array<bool, 3> axes_of(const std::string& option, const std::string& text) {
  std::array<bool, 3> axes{};
  for (const char c : text) {
    if (c < 'x' || c > 'z' || axes[static_cast<std::size_t>(c - 'x')]) {
      refuse(option, text, "letters among x, y, z, each once");
    }
    axes[static_cast<std::size_t>(c - 'x')] = true;
  }
  return axes;
}

[[nodiscard]] inline std::string choice_of(const std::string& option, const std::string& text,
                                           std::initializer_list<const char*> choices) {
  std::string all;
  for (const char* c : choices) {
    if (text == c) {
      return text;
    }
    all += (all.empty() ? "" : ", ") + std::string(c);
  }
  refuse(option, text, "one of " + all);
}

[[nodiscard]] inline std::filesystem::path folder_of(const std::string& option, const std::string& text) {
  std::error_code ignored;
  if (text.empty() || (std::filesystem::exists(text, ignored) && !std::filesystem::is_directory(text, ignored))) {
    refuse(option, text, "a folder, or a name that is free for one");
  }
  return text;
}

}  // namespace support
