// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/io/read_columns.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// \file
/// pack.out, the sphere packings of LBPM: five lines of header, then x y z r in a periodic box that starts at 0.

namespace tetrapore::inline TETRAPORE_ABI {
namespace io {
namespace detail {

inline packing read_pack_out(byte_source& bytes, const read_options& options, read_report& report) {
  grain_collector grains(options, report);
  line_source lines(bytes, options.longest_line);
  std::string_view line;
  std::vector<std::string_view> fields;
  const auto after_colon = [&](std::string_view label) {
    const bool read = lines.next(line);
    const auto text = trimmed(line);
    const auto colon = text.find(':');
    if (!read || text.substr(0, label.size()) != label || colon == std::string_view::npos) {
      throw input_error(lines.where(), read ? shown(text) : "the end of the file", std::string(label) + " …: …");
    }
    return trimmed(text.substr(colon + 1));
  };

  std::uint64_t stated = 0;
  const auto number = after_colon("Number of Spheres");
  if (!parse_count(number, stated)) {
    throw input_error(lines.where(), shown(number), "the number of spheres");
  }
  stated_box domain;
  domain.periodic = {true, true, true};
  split(after_colon("Domain Length"), ',', fields);
  if (fields.size() != 3) {
    throw input_error(lines.where(), std::to_string(fields.size()) + " lengths", "three, between commas");
  }
  box b{};
  for (std::size_t k = 0; k < 3; ++k) {
    b.hi[k] = number_at(lines, fields[k], "a length of the domain");
  }
  refuse_bad_box(b, lines.where());
  domain.bounds = b;
  domain.source = "line 2, periodic by convention";
  for (int rest = 3; rest <= 5; ++rest) {  // porosity, distribution of radii, coordination number
    if (!lines.next(line)) {
      throw input_error(lines.where(), "the end of the file", "five lines of header");
    }
  }

  grain_columns columns{{0, 1, 2}, 3, 1.0, 4};
  while (lines.next(line)) {
    split(line, 0, fields);
    if (fields.empty()) {
      continue;
    }
    if (fields.size() != 4) {
      throw input_error(lines.where(), std::to_string(fields.size()) + " columns", "4: x y z r");
    }
    grains.add_row(fields, columns, lines);
  }
  report.lines = lines.number();
  if (grains.count() != stated) {
    throw input_error(lines.where(), std::to_string(grains.count()) + " spheres",
                      std::to_string(stated) + ", as line 1 states");
  }
  return grains.finish(domain, lines.where());
}

}  // namespace detail
}  // namespace io
}  // namespace tetrapore::inline TETRAPORE_ABI
