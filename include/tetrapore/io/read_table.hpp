// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/io/read_columns.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// \file
/// Tables of grains: our text format, CSV, and Yade's text export. One reader: rows of columns, and comments that may
/// state the box, the names of the columns and the number of grains.

namespace tetrapore::inline TETRAPORE_ABI {
namespace io {
namespace detail {

/// What the comments and the header of a table say.
class table_header {
 public:
  stated_box domain;
  std::vector<std::string> names;       ///< in lower case
  std::optional<std::uint64_t> grains;  ///< how many the file says it has
  std::size_t grains_line = 0;
  bool open_ended = false;  ///< more columns may follow the named ones

  /// A comment, without its '#'. \throw input_error  a box that cannot be read
  void take_comment(std::string_view comment, const line_source& lines, read_report& report) {
    const auto text = trimmed(comment);
    if (text == "box" || (text.substr(0, 3) == "box" && is_blank(text[3]))) {
      take_box_line(text, lines, report);
    } else if (text.substr(0, 7) == "format " && lines.number() == 1) {
      split_names(trimmed(text.substr(7)), '_');
      open_ended = !names.empty() && names.back() == "attrs";
      certain_ = true;
    } else if (!certain_) {
      last_comment_ = std::string(text);
    }
  }

  /// Names in the last comment before the table count when they match its width and contain x, y and z.
  void adopt_comment(std::size_t width, char separator) {
    if (certain_ || last_comment_.empty()) {
      return;
    }
    split_names(last_comment_, separator);
    if (names.size() != width || !find_name(names, "x") || !find_name(names, "y") || !find_name(names, "z")) {
      names.clear();
    }
  }

  void take_names(const std::vector<std::string_view>& fields) {
    names.clear();
    for (const auto field : fields) {
      names.push_back(lower_case(field));
    }
    certain_ = true;
    open_ended = false;
  }

 private:
  void split_names(std::string_view text, char separator) {
    std::vector<std::string_view> fields;
    split(text, separator, fields);
    names.clear();
    for (const auto field : fields) {
      names.push_back(lower_case(field));
    }
  }

  // box x0 x1 y0 y1 z0 z1 ; units m ; columns x y z r ; N 1000 ; periodic xz
  void take_box_line(std::string_view text, const line_source& lines, read_report& report) {
    if (domain.bounds) {
      throw input_error(lines.where(), "a second box", "one box; the first is on " + domain.source);
    }
    std::vector<std::string_view> parts;
    std::vector<std::string_view> words;
    split(text, ';', parts);
    for (const auto part : parts) {
      split(part, 0, words);
      if (words.empty()) {
        continue;
      }
      if (words[0] == "box") {
        if (words.size() != 7) {
          throw input_error(lines.where(), shown(part), "box x0 x1 y0 y1 z0 z1");
        }
        std::array<double, 6> v{};
        for (std::size_t k = 0; k < 6; ++k) {
          v[k] = number_at(lines, words[k + 1], "a bound of the box");
        }
        const box b{{v[0], v[2], v[4]}, {v[1], v[3], v[5]}};
        refuse_bad_box(b, lines.where());
        domain.bounds = b;
        domain.source = "line " + std::to_string(lines.number());
      } else if (words[0] == "columns") {
        take_names({words.begin() + 1, words.end()});
      } else if (words[0] == "periodic") {
        for (std::size_t k = 1; k < words.size(); ++k) {
          if (!parse_axes(words[k], domain.periodic)) {
            throw input_error(lines.where(), shown(words[k]), "periodic axes, such as xz");
          }
        }
      } else if (words[0] == "N" && words.size() == 2) {
        std::uint64_t n = 0;
        if (!parse_count(words[1], n)) {
          throw input_error(lines.where(), shown(words[1]), "the number of grains after N");
        }
        grains = n;
        grains_line = lines.number();
      } else if (words[0] == "units" && words.size() == 2 && words[1] != "m") {
        report.warnings.push_back("the file says units " + shown(words[1]) + ": state the scale to metres");
      }
    }
  }

  bool certain_ = false;
  std::string last_comment_;
};

[[nodiscard]] inline char find_separator(std::string_view row, packing_format format) noexcept {
  if (format == packing_format::text || format == packing_format::yade) {
    return 0;
  }
  for (const char c : {';', ','}) {
    if (row.find(c) != std::string_view::npos) {
      return c;
    }
  }
  return format == packing_format::csv && row.find('\t') != std::string_view::npos ? '\t' : '\0';
}

/// True for text that a writer meant as a number, finite or not.
[[nodiscard]] inline bool meant_as_number(std::string_view text) noexcept {
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return stop == text.data() + text.size() && !text.empty() && error != std::errc::invalid_argument;
}

inline packing read_table(byte_source& bytes, const read_options& options, read_report& report) {
  grain_collector grains(options, report);
  line_source lines(bytes, options.longest_line);
  table_header header;
  grain_columns columns;
  char separator = 0;
  std::size_t width = 0;  // 0 until the first row of the table, names included
  bool chosen = false;
  std::string_view line;
  std::vector<std::string_view> fields;
  while (lines.next(line)) {
    const auto hash = line.find('#');
    const auto row = trimmed(line.substr(0, hash));
    if (row.empty()) {
      if (hash != std::string_view::npos) {
        header.take_comment(line.substr(hash + 1), lines, report);
      }
      continue;
    }
    if (width == 0) {
      separator = find_separator(row, report.format);
      if (report.format == packing_format::automatic) {
        report.format = separator == 0 ? packing_format::text : packing_format::csv;
      }
    }
    split(row, separator, fields);
    if (width == 0) {
      width = fields.size();
      bool any_number = false;
      for (const auto field : fields) {
        any_number = any_number || meant_as_number(field);
      }
      if (!any_number) {
        header.take_names(fields);
        continue;
      }
      header.adopt_comment(width, separator);
    }
    if (fields.size() != width) {
      throw input_error(lines.where(), std::to_string(fields.size()) + " columns",
                        std::to_string(width) + ", as in the first row");
    }
    if (!chosen) {
      if (!header.names.empty() && header.names.size() != width && !header.open_ended) {
        throw input_error(lines.where(), std::to_string(width) + " columns",
                          std::to_string(header.names.size()) + ", as the header names");
      }
      columns = choose_columns(header.names, width, options, lines.where());
      chosen = true;
    }
    grains.add_row(fields, columns, lines);
  }
  report.lines = lines.number();
  if (header.grains && *header.grains != grains.count()) {
    throw input_error(lines.where(), std::to_string(grains.count()) + " grains",
                      std::to_string(*header.grains) + ", as line " + std::to_string(header.grains_line) + " states");
  }
  return grains.finish(header.domain, lines.where());
}

}  // namespace detail
}  // namespace io
}  // namespace tetrapore::inline TETRAPORE_ABI
