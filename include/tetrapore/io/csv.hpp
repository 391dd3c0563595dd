// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/io/output_file.hpp"

#include <initializer_list>

/// \file
/// Tables as comma-separated values.

namespace tetrapore::inline TETRAPORE_ABI {
namespace io {

/// Writes a table: one header line, then rows of as many cells. Numbers read back to the last bit, whatever the locale;
/// NaN and infinity are written as `nan` and `inf`, which pandas, NumPy, R and gnuplot read. A text with a comma, a
/// quote or a line break is quoted as RFC 4180 says. The file appears on `commit`.
/// ```
/// csv_writer table("retention.csv", {"p_c [Pa]", "S"});
/// table.row(pressure, saturation);
/// table.commit();
/// ```
/// \throw output_error  where the file cannot be written
class csv_writer {
 public:
  csv_writer(std::filesystem::path path, std::initializer_list<std::string_view> header)
      : file_(std::move(path)), columns_(header.size()) {
    std::string_view separator;
    for (const std::string_view name : header) {
      file_ << separator;
      cell(name);
      separator = ",";
    }
    file_ << '\n';
  }

  template <class... Cells>
  void row(const Cells&... cells) {
    TETRAPORE_EXPECTS(sizeof...(cells) == columns_, "a row has as many cells as the header");
    std::string_view separator;
    ((file_ << separator, cell(cells), separator = ","), ...);
    file_ << '\n';
  }

  void commit() { file_.commit(); }

 private:
  template <class N>
    requires std::integral<N> || std::floating_point<N>
  void cell(N number) {
    file_ << number;
  }
  void cell(std::string_view text) {
    if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
      file_ << text;
      return;
    }
    file_ << '"';
    for (const char c : text) {
      file_ << (c == '"' ? std::string_view("\"\"") : std::string_view(&c, 1));
    }
    file_ << '"';
  }

  output_file file_;
  [[maybe_unused]] std::size_t columns_;
};

}  // namespace io
}  // namespace tetrapore::inline TETRAPORE_ABI
