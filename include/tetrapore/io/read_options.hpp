// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/error.hpp"
#include "tetrapore/packing/packing.hpp"
#include "tetrapore/packing/wrap.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// \file
/// What the readers of packings are asked, and what they report.

namespace tetrapore::inline TETRAPORE_ABI {
namespace io {

/// The formats that the readers know.
enum class packing_format : unsigned char {
  automatic,  ///< told from the first line, then from the extension
  text,       ///< columns between blanks, `# box x0 x1 y0 y1 z0 z1 ; …` in a comment
  csv,        ///< columns between commas, semicolons or tabs
  yade,       ///< `#format x_y_z_r`, then text
  dump,       ///< LAMMPS and LIGGGHTS: `ITEM: TIMESTEP` …
  xyzd,       ///< little-endian doubles x y z diameter, with a .nfo file beside
  pack_out    ///< five lines of header (Number of Spheres, Domain Length …), then x y z r
};

[[nodiscard]] constexpr const char* describe(packing_format f) noexcept {
  switch (f) {
    case packing_format::automatic: return "automatic";
    case packing_format::text: return "text";
    case packing_format::csv: return "csv";
    case packing_format::yade: return "yade";
    case packing_format::dump: return "dump";
    case packing_format::xyzd: return "xyzd";
    case packing_format::pack_out: return "pack.out";
  }
  return "not a format";
}

/// A column of a table, by its name in the header or by its position (0 is the first).
class column {
 public:
  column() = default;
  column(std::string name) : name_(std::move(name)), named_(true) {}      // NOLINT(google-explicit-constructor)
  column(const char* name) : name_(name), named_(true) {}                 // NOLINT(google-explicit-constructor)
  column(int position) : position_(static_cast<std::size_t>(position)) {  // NOLINT(google-explicit-constructor)
    if (position < 0) {
      throw parameter_error("column", std::to_string(position), "a position, 0 for the first column, or a name");
    }
  }

  [[nodiscard]] bool given() const noexcept { return named_ || position_.has_value(); }
  [[nodiscard]] bool named() const noexcept { return named_; }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] std::optional<std::size_t> position() const noexcept { return position_; }

 private:
  std::string name_;
  bool named_ = false;
  std::optional<std::size_t> position_;
};

/// Which columns hold what. Columns left out are looked for under their usual names, then taken as x y z r.
struct column_map {
  column x = {};
  column y = {};
  column z = {};
  column radius = {};
  column diameter = {};
};

/// \par Units  everything in the unit of the file, but `scale` [m per unit of the file]
struct read_options {
  packing_format format = packing_format::automatic;
  double scale = 1.0;                                          ///< metres per unit of the file
  column_map columns = {};                                     ///< tables only
  std::optional<double> radius = std::nullopt;                 ///< one radius for all grains of a file that gives none
  double radius_factor = 1.0;                                  ///< all radii are multiplied by it
  std::optional<box> bounds = std::nullopt;                    ///< instead of the file's box
  std::optional<std::array<bool, 3>> periodic = std::nullopt;  ///< instead of the file's periodic axes
  std::optional<std::size_t> snapshot = std::nullopt;  ///< dump: which time step, 0 is the first; none: the last
  bool wrap = true;                                    ///< bring grains into the box along periodic axes
  std::size_t longest_line = 65536;                    ///< [bytes] longer lines are refused
};

/// What was read, and what was done with it.
struct read_report {
  std::string source;  ///< file, or the name given to a block of memory
  packing_format format = packing_format::automatic;
  std::size_t lines = 0;            ///< lines of text, or records of a binary file
  std::size_t grains_read = 0;      ///< before images were removed
  std::string box_source = "none";  ///< "line 1", "packing.nfo", "options", "none"
  std::size_t snapshots = 1;        ///< time steps in the file
  std::string time_step;            ///< of the one that was read
  wrap_report wrapping;
  std::vector<std::string> warnings;
};

/// What a reader returns: the packing, and what it met on the way.
struct read_result {
  tetrapore::packing packing;
  read_report report;
};

}  // namespace io
}  // namespace tetrapore::inline TETRAPORE_ABI
