// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/io/read_columns.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// \file
/// Dumps of LAMMPS and LIGGGHTS in text: one or more time steps, each with its box and its columns by name.

namespace tetrapore::inline TETRAPORE_ABI {
namespace io {
namespace detail {

/// Reads a dump, section by section.
class dump_reader {
 public:
  dump_reader(byte_source& bytes, const read_options& options, read_report& report)
      : options_(options), report_(report), grains_(options, report), lines_(bytes, options.longest_line) {}

  packing read() {
    std::size_t seen = 0;
    bool found = false;
    std::string_view line;
    while (lines_.next(line)) {
      const auto text = trimmed(line);
      if (text.empty()) {
        continue;
      }
      if (text == "ITEM: TIMESTEP") {
        time_step_ = std::string(trimmed(content("the time step")));
        has_count_ = false;
        pending_ = {};
      } else if (text == "ITEM: NUMBER OF ATOMS") {
        const auto value = trimmed(content("the number of atoms"));
        if (!parse_count(value, count_)) {
          throw input_error(lines_.where(), shown(value), "the number of atoms");
        }
        has_count_ = true;
      } else if (text.substr(0, 16) == "ITEM: BOX BOUNDS") {
        read_box(text.substr(16));
      } else if (text.substr(0, 11) == "ITEM: ATOMS") {
        const bool wanted = !options_.snapshot || *options_.snapshot == seen;
        read_atoms(text.substr(11), wanted);
        if (wanted) {
          found = true;
          kept_ = pending_;
          report_.time_step = time_step_;
        }
        ++seen;
        if (wanted && options_.snapshot) {
          break;
        }
      } else if (text == "ITEM: UNITS" || text == "ITEM: TIME") {
        static_cast<void>(content("a value"));
      } else {
        throw input_error(lines_.where(), shown(text), "a section of a dump: ITEM: TIMESTEP, NUMBER OF ATOMS, …");
      }
    }
    report_.lines = lines_.number();
    report_.snapshots = seen;
    if (!found) {
      throw input_error(lines_.where(), std::to_string(seen) + " time steps",
                        options_.snapshot ? "a time step number " + std::to_string(*options_.snapshot) + " (0 is first)"
                                          : "at least one");
    }
    return grains_.finish(kept_, lines_.where());
  }

 private:
  std::string_view content(const char* what) {
    std::string_view line;
    if (!lines_.next(line)) {
      throw input_error(lines_.where(), "the end of the file", what);
    }
    return line;
  }

  void read_box(std::string_view flags) {
    split(flags, 0, fields_);
    if (fields_.size() != 3 && !fields_.empty()) {
      throw input_error(lines_.where(), shown(trimmed(flags)), "an orthogonal box: three flags such as pp ff ff");
    }
    for (std::size_t k = 0; k < fields_.size(); ++k) {
      pending_.periodic[k] = fields_[k] == "pp";
    }
    pending_.source = "line " + std::to_string(lines_.number());
    box b{};
    for (std::size_t k = 0; k < 3; ++k) {
      split(content("two bounds of the box"), 0, fields_);
      if (fields_.size() != 2) {
        throw input_error(lines_.where(), std::to_string(fields_.size()) + " numbers", "two bounds of the box");
      }
      b.lo[k] = number_at(lines_, fields_[0], "a lower bound");
      b.hi[k] = number_at(lines_, fields_[1], "an upper bound");
    }
    refuse_bad_box(b, lines_.where());
    pending_.bounds = b;
  }

  void read_atoms(std::string_view names_text, bool wanted) {
    if (!has_count_) {
      throw input_error(lines_.where(), "ITEM: ATOMS", "ITEM: NUMBER OF ATOMS before it");
    }
    split(names_text, 0, fields_);
    std::vector<std::string> names;
    for (const auto field : fields_) {
      names.push_back(lower_case(field));
    }
    const auto from = lines_.where();
    const bool scaled = name_coordinates(names, from);
    grain_columns columns;
    if (wanted) {
      columns = choose_columns(names, names.size(), options_, from);
      grains_.restart();
    }
    for (std::uint64_t i = 0; i < count_; ++i) {
      std::string_view line;
      if (!lines_.next(line)) {
        throw input_error(lines_.where(), "the end of the file after " + std::to_string(i) + " atoms",
                          std::to_string(count_) + " atoms");
      }
      if (wanted) {
        split(line, 0, fields_);
        if (fields_.size() != names.size()) {
          throw input_error(lines_.where(), std::to_string(fields_.size()) + " columns",
                            std::to_string(names.size()) + ", as ITEM: ATOMS names");
        }
        add(columns, scaled);
      }
    }
  }

  void add(const grain_columns& columns, bool scaled) {
    if (!scaled) {
      grains_.add_row(fields_, columns, lines_);
      return;
    }
    vec3<double> centre{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double s = number_at(lines_, fields_[columns.centre[k]], "a scaled coordinate");
      centre[k] = pending_.bounds->lo[k] + s * pending_.bounds->size()[k];
    }
    grains_.add(centre, grains_.radius_of(fields_, columns, lines_), [&] { return lines_.where(); });
  }

  /// Gives unwrapped (xu) or scaled (xs, xsu) coordinates the plain names where x is absent; true for scaled ones.
  bool name_coordinates(std::vector<std::string>& names, const std::string& where) const {
    if (find_name(names, "x")) {
      return false;
    }
    for (const std::string suffix : {"u", "s", "su"}) {
      if (find_name(names, "x" + suffix)) {
        for (auto& name : names) {
          if (name.size() == 1 + suffix.size() && name[0] >= 'x' && name[0] <= 'z' && name.substr(1) == suffix) {
            name.resize(1);
          }
        }
        if (suffix != "u" && !pending_.bounds) {
          throw input_error(where, "scaled coordinates", "ITEM: BOX BOUNDS before them");
        }
        return suffix != "u";
      }
    }
    return false;
  }

  const read_options& options_;
  read_report& report_;
  grain_collector grains_;
  line_source lines_;
  stated_box pending_;
  stated_box kept_;
  std::string time_step_;
  std::uint64_t count_ = 0;
  bool has_count_ = false;
  std::vector<std::string_view> fields_;
};

inline packing read_dump(byte_source& bytes, const read_options& options, read_report& report) {
  return dump_reader(bytes, options, report).read();
}

}  // namespace detail
}  // namespace io
}  // namespace tetrapore::inline TETRAPORE_ABI
