// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/io/read_source.hpp"
#include "tetrapore/packing/sizes.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// \file
/// Grading curves: cumulative mass fraction against diameter.

namespace tetrapore::inline TETRAPORE_ABI {
namespace io {
namespace detail {

[[nodiscard]] inline std::vector<mass_below> read_sizes_from(byte_source& bytes) {
  line_source lines(bytes, 65536);
  std::string_view line;
  std::vector<std::string_view> fields;
  std::vector<mass_below> curve;
  double metres = 0;
  while (lines.next(line)) {
    const auto row = trimmed(line.substr(0, line.find('#')));
    if (row.empty()) {
      continue;
    }
    split(row, ',', fields);
    if (metres == 0) {
      constexpr std::array<std::pair<std::string_view, double>, 3> units{
          {{"diameter_m", 1.0}, {"diameter_mm", 1e-3}, {"diameter_um", 1e-6}}};
      for (const auto& [name, unit] : units) {
        metres = fields[0] == name ? unit : metres;
      }
      if (metres == 0 || fields.size() != 2 || fields[1] != "cumulative_mass_fraction") {
        throw input_error(lines.where(), shown(row),
                          "diameter_m (or diameter_mm, diameter_um),cumulative_mass_fraction");
      }
      continue;
    }
    if (fields.size() != 2) {
      throw input_error(lines.where(), std::to_string(fields.size()) + " columns", "2: diameter, fraction");
    }
    const mass_below point{metres * number_at(lines, fields[0], "the diameter"),
                           number_at(lines, fields[1], "the cumulative mass fraction")};
    const bool rises =
        curve.empty() || (point.diameter >= curve.back().diameter && point.fraction >= curve.back().fraction);
    if (!(point.diameter > 0) || !(point.fraction >= 0 && point.fraction <= 1) || !rises) {
      throw input_error(lines.where(), shown(row), "a diameter above 0 and a fraction from 0 to 1, neither falling");
    }
    curve.push_back(point);
  }
  if (curve.size() < 2 || curve.front().fraction != 0 || curve.back().fraction != 1) {
    throw input_error(lines.where(), std::to_string(curve.size()) + " points that do not go from fraction 0 to 1",
                      "a curve that does");
  }
  return curve;
}

}  // namespace detail

/// Reads a grading curve: CSV with the header `diameter_mm,cumulative_mass_fraction` (or _m, _um), comments after '#'.
/// \par Units  diameters become [m]
/// \throw input_error  names file and line, what was found and what was expected
[[nodiscard]] inline std::vector<mass_below> read_sizes(const std::filesystem::path& path) {
  byte_source bytes(path);
  return detail::read_sizes_from(bytes);
}

[[nodiscard]] inline std::vector<mass_below> read_sizes_from_memory(std::string_view content, const std::string& name) {
  byte_source bytes(content, name);
  return detail::read_sizes_from(bytes);
}

}  // namespace io
}  // namespace tetrapore::inline TETRAPORE_ABI
