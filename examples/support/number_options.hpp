// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "options.hpp"

#include <CLI/CLI.hpp>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <deque>
#include <string>

/// \file
/// Options that are numbers: taken as text, so that all refusals name the option, the value and what it takes.

namespace support {

/// Parses a command line; false where only help was asked for, which is then printed.
/// \throw tetrapore::parameter_error  what the app does not take
[[nodiscard]] inline bool parsed(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::fputs(app.help().c_str(), stdout);
    return false;
  } catch (const CLI::ParseError& e) {
    throw tetrapore::parameter_error("command line", e.what(), "options as --help lists them");
  }
  return true;
}

/// What a number may be, in words and as a test.
struct number_range {
  const char* expected;
  bool (*accepts)(double);
};
inline constexpr number_range above_zero{"a number above 0", [](double x) { return x > 0; }};
inline constexpr number_range zero_or_more{"a number from 0 on", [](double x) { return x >= 0; }};
inline constexpr number_range acute_angle{"a number from 0 to below 90 [degrees]",
                                          [](double x) { return x >= 0 && x < 90; }};

/// Collects options of an app; `read` puts their numbers where they belong.
class number_options {
 public:
  explicit number_options(CLI::App& app) : app_(app) {}

  void add(const char* name, double& value, const number_range& range, const std::string& help) {
    entry& e = entries_.emplace_back(entry{name, tetrapore::short_number(value), &value, nullptr, range});
    app_.add_option(name, e.text, help)->capture_default_str();
  }
  void add(const char* name, std::size_t& value, const number_range& range, const std::string& help) {
    entry& e = entries_.emplace_back(entry{name, std::to_string(value), nullptr, &value, range});
    app_.add_option(name, e.text, help)->capture_default_str();
  }

  /// \throw tetrapore::parameter_error  the first option that is out of its range
  void read() const {
    for (const entry& e : entries_) {
      const double x = number_of(e.name, e.text, e.range.accepts, e.range.expected);
      if (e.value != nullptr) {
        *e.value = x;
      } else {
        *e.count = static_cast<std::size_t>(x);
      }
    }
  }

 private:
  struct entry {
    const char* name;
    std::string text;
    double* value;
    std::size_t* count;
    number_range range;
  };

  CLI::App& app_;
  std::deque<entry> entries_;  // the app keeps references to the texts
};

}  // namespace support
