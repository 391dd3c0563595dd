// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/io/read_columns.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// \file
/// .xyzd, the packings of the packing-generation project: little-endian doubles x y z diameter, one grain after the
/// other, and a text file .nfo beside it that states the periodic box.

namespace tetrapore::inline TETRAPORE_ABI {
namespace io {
namespace detail {

/// What a .nfo file states.
struct nfo {
  stated_box domain;
  std::optional<std::uint64_t> grains;
  std::string source;
};

inline nfo read_nfo(byte_source& bytes, const read_options& options, read_report& report) {
  nfo n;
  n.source = bytes.name();
  line_source lines(bytes, options.longest_line);
  std::string_view line;
  std::vector<std::string_view> words;
  std::optional<double> theoretical;
  std::optional<double> final_porosity;
  while (lines.next(line)) {
    const auto text = trimmed(line);
    const auto colon = text.find(':');
    if (colon == std::string_view::npos) {
      continue;
    }
    const auto key = text.substr(0, colon);
    split(text.substr(colon + 1), 0, words);
    if (key == "N") {
      std::uint64_t count = 0;
      if (words.size() != 1 || !parse_count(words[0], count)) {
        throw input_error(lines.where(), shown(text), "the number of grains");
      }
      n.grains = count;
    } else if (key == "Dimensions") {
      if (words.size() != 3) {
        throw input_error(lines.where(), shown(text), "three lengths of the box");
      }
      box b{};
      for (std::size_t k = 0; k < 3; ++k) {
        b.hi[k] = number_at(lines, words[k], "a length of the box");
      }
      refuse_bad_box(b, lines.where());
      n.domain.bounds = b;
      n.domain.periodic = {true, true, true};
      n.domain.source = bytes.name();
    } else if (key == "Theoretical Porosity" && !words.empty()) {
      theoretical = number_at(lines, words[0], "a porosity");
    } else if (key == "Final Porosity" && !words.empty()) {
      final_porosity = number_at(lines, words[0], "a porosity");
    }
  }
  if (theoretical && final_porosity && std::abs(*theoretical - *final_porosity) > 1e-9) {
    report.warnings.push_back("the .nfo file states porosity " + short_number(*theoretical) +
                              " for the diameters and " + short_number(*final_porosity) +
                              " at the end: radii may need a factor");
  }
  return n;
}

inline packing read_xyzd(byte_source& bytes, const nfo* box_file, const read_options& options, read_report& report) {
  constexpr std::size_t record = 32;
  grain_collector grains(options, report);
  std::vector<char> block(record * 1024);
  std::uint64_t at = 0;
  const auto where = [&] { return bytes.name() + ": byte " + std::to_string(at); };
  for (;;) {
    const std::size_t got = bytes.read(block.data(), block.size());
    for (std::size_t i = 0; i + record <= got; i += record, at += record) {
      std::array<double, 4> v{};
      for (std::size_t k = 0; k < 4; ++k) {
        std::uint64_t bits = 0;
        for (std::size_t b = 8; b-- > 0;) {
          bits = bits << 8 | static_cast<unsigned char>(block[i + 8 * k + b]);
        }
        v[k] = std::bit_cast<double>(bits);
      }
      grains.add({v[0], v[1], v[2]}, 0.5 * v[3], where);
    }
    if (got % record != 0) {
      throw input_error(where(), std::to_string(got % record) + " bytes after the last whole grain",
                        "records of 32 bytes: x y z diameter");
    }
    if (got < block.size()) {
      break;
    }
  }
  report.lines = grains.count();
  if (box_file != nullptr && box_file->grains && *box_file->grains != grains.count()) {
    throw input_error(where(), std::to_string(grains.count()) + " grains",
                      std::to_string(*box_file->grains) + ", as " + box_file->source + " states");
  }
  return grains.finish(box_file != nullptr ? box_file->domain : stated_box{}, where());
}

}  // namespace detail
}  // namespace io
}  // namespace tetrapore::inline TETRAPORE_ABI
