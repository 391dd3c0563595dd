// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

/// \file
/// A table of comma-separated values with a header line; a field in quotes may hold commas.

class csv_table {
 public:
  explicit csv_table(const std::filesystem::path& path) : path_(path) {
    std::ifstream in(path);
    if (!in) {
      throw std::runtime_error("cannot open " + path.string());
    }
    std::string line;
    while (std::getline(in, line)) {
      if (!line.empty() && line.back() == '\r') {
        line.pop_back();
      }
      if (line.empty() || line.front() == '#') {
        continue;
      }
      std::vector<std::string> words(1);
      bool quoted = false;
      for (const char c : line) {
        if (c == '"') {
          quoted = !quoted;
        } else if (c == ',' && !quoted) {
          words.emplace_back();
        } else {
          words.back() += c;
        }
      }
      if (column_.empty()) {
        for (std::size_t i = 0; i < words.size(); ++i) {
          column_[words[i]] = i;
        }
      } else {
        words.resize(column_.size());
        rows_.push_back(words);
      }
    }
  }

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] bool has(const std::string& column) const { return column_.count(column) != 0; }
  [[nodiscard]] const std::string& text(std::size_t row, const std::string& column) const {
    return rows_.at(row).at(column_.at(column));
  }
  [[nodiscard]] double number(std::size_t row, const std::string& column) const {
    return std::strtod(text(row, column).c_str(), nullptr);
  }
  /// All digits of the table, for a long double reference.
  [[nodiscard]] long double precise(std::size_t row, const std::string& column) const {
    return std::strtold(text(row, column).c_str(), nullptr);
  }

 private:
  std::filesystem::path path_;
  std::map<std::string, std::size_t> column_;
  std::vector<std::vector<std::string>> rows_;
};
