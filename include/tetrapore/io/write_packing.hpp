// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/error.hpp"
#include "tetrapore/io/output_file.hpp"
#include "tetrapore/packing/packing.hpp"

#include <array>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

/// \file
/// Our text format: one comment with the box, then x y z r.

namespace tetrapore::inline TETRAPORE_ABI {
namespace io {

/// How a packing is written.
struct write_packing_options {
  int digits = 17;           ///< significant digits; 17 give back the same bits
  std::string comment = {};  ///< further comment lines: who made the packing, and how
};

/// The text of a packing: `# box x0 x1 y0 y1 z0 z1 ; units m ; columns x y z r ; N n ; periodic xz`, comments, grains.
/// \par Units  [m]
/// \par Accuracy  bit for bit with 17 digits
/// \throw parameter_error  a number of digits that is not 1 to 17
[[nodiscard]] inline std::string packing_text(const packing& p, const write_packing_options& options = {}) {
  if (options.digits < 1 || options.digits > 17) {
    throw parameter_error("digits", std::to_string(options.digits), "1 to 17");
  }
  std::string text;
  text.reserve(p.grains.size() * 80 + 256);
  const auto put = [&](double value, char after) {
    std::array<char, 40> digits{};
    const auto end =
        std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::general, options.digits);
    text.append(digits.data(), end.ptr);
    text += after;
  };
  text += "# ";
  if (p.bounds) {
    text += "box ";
    for (std::size_t k = 0; k < 3; ++k) {
      put(p.bounds->lo[k], ' ');
      put(p.bounds->hi[k], ' ');
    }
    text += "; units m ; columns x y z r ; N " + std::to_string(p.grains.size());
    std::string axes;
    for (std::size_t k = 0; k < 3; ++k) {
      axes += p.periodic[k] ? std::string(1, static_cast<char>('x' + static_cast<char>(k))) : "";
    }
    text += axes.empty() ? "\n" : " ; periodic " + axes + "\n";
  } else {
    text += "x y z r\n";
  }
  for (std::string_view rest = options.comment; !rest.empty();) {
    const auto stop = rest.find('\n');
    text += "# ";
    text += rest.substr(0, stop);
    text += '\n';
    rest.remove_prefix(stop == std::string_view::npos ? rest.size() : stop + 1);
  }
  for (const auto& g : p.grains) {
    put(g.centre.x, ' ');
    put(g.centre.y, ' ');
    put(g.centre.z, ' ');
    put(g.radius, '\n');
  }
  return text;
}

/// Writes a packing to a file, in our text format. The file appears under its name only when it is complete.
/// \throw output_error  the file cannot be written
inline void write_packing(const packing& p, const std::filesystem::path& path,
                          const write_packing_options& options = {}) {
  const auto text = packing_text(p, options);
  output_file file(path);
  file << text;
  file.commit();
}

}  // namespace io
}  // namespace tetrapore::inline TETRAPORE_ABI
