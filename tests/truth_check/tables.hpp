// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/csv_table.hpp"
#include "truth_check/report.hpp"

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

/// \file
/// The tables of truth that truth_check knows.

namespace truth_check {

/// A named table of truth: how it is recognised, and what it measures.
struct known_table {
  std::string name;
  std::function<bool(const csv_table&)> recognise;
  std::function<std::vector<law_report>(const csv_table&)> measure;
};

inline bool has_all(const csv_table& t, std::initializer_list<const char*> columns) {
  return std::all_of(columns.begin(), columns.end(), [&](const char* c) { return t.has(c); });
}

/// One file measures the tables of one family of laws.
std::vector<known_table> entry_tables();
std::vector<known_table> bridge_tables();
std::vector<known_table> lubrication_tables();

}  // namespace truth_check
