// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// \file
/// Campaigns: what is measured once and kept in docs/campaigns. Whatever a test asks of it is asked of the file, just
/// written or there before, so that neither a bad measurement nor a changed file passes later.

namespace campaigns {

inline std::filesystem::path file_of(const std::string& name) {
  const std::filesystem::path folder = TETRAPORE_CAMPAIGN_DIR;
  std::filesystem::create_directories(folder);
  return folder / (name + ".json");
}

/// One line of a file: {"name": value, …}.
class row {
 public:
  row() = default;
  explicit row(const std::string& line) {
    std::size_t at = 0;
    const auto quoted = [&] {
      const std::size_t end = line.find('"', at + 1);
      if (end == std::string::npos) {
        throw std::invalid_argument("a row that is cut off: " + line);
      }
      const std::string text = line.substr(at + 1, end - at - 1);
      at = end + 1;
      return text;
    };
    while ((at = line.find('"', at)) != std::string::npos) {
      std::string name = quoted();
      at = line.find_first_not_of(": ", at);
      const std::size_t end = line.find_first_of(",}", at);
      if (end == std::string::npos) {
        throw std::invalid_argument("a row that is cut off: " + line);
      }
      if (line[at] == '"') {
        put(name, quoted());
      } else {
        entries_.emplace_back(std::move(name), line.substr(at, end - at));
        at = end;
      }
    }
  }

  template <class Value>
  row& put(const std::string& name, const Value& value) {
    std::string text;
    if constexpr (std::is_same_v<Value, bool>) {
      text = value ? "true" : "false";
    } else if constexpr (std::is_floating_point_v<Value>) {
      char digits[32];
      std::snprintf(digits, sizeof digits, "%.4g", static_cast<double>(value));
      text = std::isfinite(value) ? digits : "null";
    } else if constexpr (std::is_integral_v<Value>) {
      text = std::to_string(value);
    } else {
      text = '"' + std::string(value) + '"';
    }
    entries_.emplace_back(name, text);
    return *this;
  }

  [[nodiscard]] bool has(const std::string& name) const { return find(name) != nullptr; }
  /// NaN where the file says null.
  [[nodiscard]] double number(const std::string& name) const {
    const std::string& text = at(name);
    return text == "null" ? std::numeric_limits<double>::quiet_NaN() : std::stod(text);
  }
  [[nodiscard]] std::string word(const std::string& name) const {
    const std::string& text = at(name);
    return text.front() == '"' ? text.substr(1, text.size() - 2) : text;
  }
  [[nodiscard]] std::string line() const {
    std::string all;
    for (const auto& [name, value] : entries_) {
      all.append(all.empty() ? "{\"" : ", \"").append(name).append("\": ").append(value);
    }
    return all + "}";
  }

 private:
  [[nodiscard]] const std::string* find(const std::string& name) const {
    for (const auto& entry : entries_) {
      if (entry.first == name) {
        return &entry.second;
      }
    }
    return nullptr;
  }
  [[nodiscard]] const std::string& at(const std::string& name) const {
    const std::string* value = find(name);
    if (value == nullptr) {
      throw std::out_of_range("no " + name + " in " + line());
    }
    return *value;
  }

  std::vector<std::pair<std::string, std::string>> entries_;
};

/// The rows of docs/campaigns/<name>.json, which `measure()` gives where there is no such file. `head` says what goes
/// for all of them.
template <class Measure>
std::vector<row> rows_of(const std::string& name, const row& head, Measure measure) {
  const auto path = file_of(name);
  if (!std::filesystem::exists(path)) {
    const std::vector<row> measured = measure();
    const auto part = path.string() + ".part";
    std::ofstream out(part);
    const std::string of_all = head.line();
    out << "{\n  \"command\": \"tests/run.sh --long long_lbm\",\n";
    if (of_all.size() > 1) {
      out << "  " << of_all.substr(1, of_all.size() - 2) << ",\n";
    }
    out << "  \"rows\": [\n";
    for (std::size_t k = 0; k < measured.size(); ++k) {
      out << "    " << measured[k].line() << (k + 1 < measured.size() ? ",\n" : "\n");
    }
    out << "  ]\n}\n";
    out.close();
    std::filesystem::rename(part, path);
  }
  std::vector<row> rows;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("    {", 0) == 0) {
      rows.emplace_back(line);
    }
  }
  return rows;
}

/// A line  "name": [number, …]  or  [number, …]; no numbers where a line is none of these.
struct named_numbers {
  std::string name;
  std::vector<double> numbers;
};
inline named_numbers numbers_of(const std::string& line) {
  named_numbers of;
  const std::size_t open = line.find('[');
  const std::size_t close = line.find(']');
  if (open == std::string::npos || close == std::string::npos) {
    return of;
  }
  if (const std::size_t quote = line.find('"'); quote < open) {
    of.name = line.substr(quote + 1, line.find('"', quote + 1) - quote - 1);
  }
  for (std::size_t at = open + 1; at < close;) {
    std::size_t read = 0;
    of.numbers.push_back(std::stod(line.substr(at, close - at), &read));
    at = line.find_first_not_of(", ", at + read);
  }
  return of;
}

}  // namespace campaigns
