// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/io/read_options.hpp"
#include "tetrapore/io/read_source.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// \file
/// What all readers share: which column holds what, and the checks that every grain and every box passes.

namespace tetrapore::inline TETRAPORE_ABI {
namespace io {
namespace detail {

/// The columns of a table that make a grain.
struct grain_columns {
  std::array<std::size_t, 3> centre{};
  std::optional<std::size_t> radius;  ///< none: options.radius
  double radius_per_entry = 1.0;      ///< ½ for a column of diameters
  std::size_t needed = 0;             ///< number of columns that a row has at least
};

[[nodiscard]] inline std::optional<std::size_t> find_name(const std::vector<std::string>& names,
                                                          std::string_view wanted) {
  const auto at = std::find(names.begin(), names.end(), lower_case(wanted));
  return at == names.end() ? std::nullopt : std::optional(static_cast<std::size_t>(at - names.begin()));
}

[[nodiscard]] inline std::optional<std::size_t> find_any(const std::vector<std::string>& names,
                                                         std::initializer_list<const char*> wanted) {
  for (const char* name : wanted) {
    if (const auto at = find_name(names, name)) {
      return at;
    }
  }
  return std::nullopt;
}

[[nodiscard]] inline std::string listed(const std::vector<std::string>& names) {
  if (names.empty()) {
    return "no names";
  }
  std::string all;
  for (const auto& name : names) {
    all += (all.empty() ? "" : " ") + name;
  }
  return "columns " + shown(all);
}

/// Chooses the columns. `names` are in lower case, empty where the file has none; `width` is the number of columns.
/// \throw input_error  a column that was asked for, or a coordinate or radius, is not there
inline grain_columns choose_columns(const std::vector<std::string>& names, std::size_t width,
                                    const read_options& options, const std::string& where) {
  const auto& map = options.columns;
  const auto chosen = [&](const column& c) -> std::optional<std::size_t> {
    if (!c.given()) {
      return std::nullopt;
    }
    const auto at = c.named() ? find_name(names, c.name()) : c.position();
    if (!at || *at >= width) {
      throw input_error(where, c.named() ? listed(names) : std::to_string(width) + " columns",
                        c.named() ? "a column named " + shown(c.name())
                                  : "a column at position " + std::to_string(*c.position()) + " (the first is 0)");
    }
    return at;
  };
  if (map.radius.given() && map.diameter.given()) {
    throw parameter_error("columns", "both a radius and a diameter", "one of them");
  }

  grain_columns c;
  auto radius = chosen(map.radius);
  const auto diameter = chosen(map.diameter);
  if (diameter) {
    radius = diameter;
    c.radius_per_entry = 0.5;
  }
  std::array<std::optional<std::size_t>, 3> centre{chosen(map.x), chosen(map.y), chosen(map.z)};
  constexpr std::array<const char*, 3> axis_name{"x", "y", "z"};
  if (!names.empty()) {
    constexpr std::array<const char*, 3> point_name{"points:0", "points:1", "points:2"};
    for (std::size_t k = 0; k < 3; ++k) {
      if (!centre[k]) {
        centre[k] = find_any(names, {axis_name[k], point_name[k]});
      }
    }
    if (!radius) {
      radius = find_any(names, {"r", "radius", "rad"});
    }
    if (!radius) {
      radius = find_any(names, {"d", "diameter", "diam"});
      c.radius_per_entry = radius ? 0.5 : 1.0;
    }
  } else if (!centre[0] && !centre[1] && !centre[2]) {
    const std::size_t expected = options.radius || radius ? 3 : 4;
    if (width != expected && !radius) {
      throw input_error(where, std::to_string(width) + " columns without names",
                        expected == 4 ? "4 columns x y z r, a line of names, or a column map"
                                      : "3 columns x y z, a line of names, or a column map");
    }
    centre = {0, 1, 2};
    if (!radius && expected == 4) {
      radius = 3;
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (!centre[k]) {
      throw input_error(where, listed(names), std::string("a column for ") + axis_name[k]);
    }
    c.centre[k] = *centre[k];
  }
  if (radius && options.radius) {
    throw parameter_error("radius", "one radius for all, though column " + std::to_string(*radius) + " gives radii",
                          "one or the other");
  }
  if (!radius && !options.radius) {
    throw input_error(where, listed(names), "a column for the radius or the diameter, or one radius for all grains");
  }
  c.radius = radius;
  c.needed = std::max({c.centre[0], c.centre[1], c.centre[2], radius.value_or(0)}) + 1;
  if (c.needed > width) {
    throw input_error(where, std::to_string(width) + " columns", "at least " + std::to_string(c.needed));
  }
  return c;
}

/// A box and periodic axes as a file states them, in its own unit.
struct stated_box {
  std::optional<box> bounds;
  std::array<bool, 3> periodic{};
  std::string source = "none";
};

/// \throw input_error  bounds that are not finite or not in order
inline void refuse_bad_box(const box& b, const std::string& where) {
  constexpr std::array<const char*, 3> axis_name{"x", "y", "z"};
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(b.lo[k] < b.hi[k]) || !std::isfinite(b.hi[k] - b.lo[k])) {
      throw input_error(
          where, "a box from " + short_number(b.lo[k]) + " to " + short_number(b.hi[k]) + " along " + axis_name[k],
          "finite bounds, the lower one first");
    }
  }
}

/// Reads "xz" as periodic along x and z.
[[nodiscard]] inline bool parse_axes(std::string_view text, std::array<bool, 3>& axes) noexcept {
  for (const char c : text) {
    if (c < 'x' || c > 'z') {
      return false;
    }
    axes[static_cast<std::size_t>(c - 'x')] = true;
  }
  return !text.empty();
}

/// Collects grains: each is checked, and scaled to metres.
class grain_collector {
 public:
  grain_collector(const read_options& options, read_report& report) : options_(options), report_(report) {
    const auto positive = [](double v) { return v > 0 && std::isfinite(v); };
    if (!positive(options.scale)) {
      throw parameter_error("scale", short_number(options.scale), "metres per unit of the file, above 0");
    }
    if (!positive(options.radius_factor)) {
      throw parameter_error("radius_factor", short_number(options.radius_factor), "a number above 0");
    }
    if (options.radius && !positive(*options.radius)) {
      throw parameter_error("radius", short_number(*options.radius), "a length above 0");
    }
    if (options.longest_line == 0) {
      throw parameter_error("longest_line", "0", "a number of bytes above 0");
    }
  }

  /// \param where  where() -> std::string, asked only for an error
  template <class Where>
  void add(const vec3<double>& centre, double radius, const Where& where) {
    const sphere<double> g{centre * options_.scale, radius * options_.radius_factor * options_.scale};
    if (!finite(g.centre)) {
      throw input_error(where(), "a centre that is not finite", "finite coordinates [m]");
    }
    if (!(g.radius > 0) || !std::isfinite(g.radius)) {
      throw input_error(where(), "radius " + short_number(radius), "a finite radius above 0");
    }
    grains_.push_back(g);
  }

  /// A row of a table. \throw input_error  too few fields, or a field that is not a finite number
  void add_row(const std::vector<std::string_view>& fields, const grain_columns& c, const line_source& lines) {
    const vec3<double> centre{number_at(lines, fields[c.centre[0]], "x"), number_at(lines, fields[c.centre[1]], "y"),
                              number_at(lines, fields[c.centre[2]], "z")};
    add(centre, radius_of(fields, c, lines), [&] { return lines.where(); });
  }
  [[nodiscard]] double radius_of(const std::vector<std::string_view>& fields, const grain_columns& c,
                                 const line_source& lines) const {
    return c.radius ? c.radius_per_entry * number_at(lines, fields[*c.radius], "the radius") : *options_.radius;
  }

  void restart() noexcept { grains_.clear(); }
  [[nodiscard]] std::size_t count() const noexcept { return grains_.size(); }

  /// The packing: the box of the options or of the file, in metres, and the grains wrapped into it.
  [[nodiscard]] packing finish(const stated_box& stated, const std::string& where) {
    if (grains_.empty()) {
      throw input_error(where, "no grain", "at least one");
    }
    report_.grains_read = grains_.size();
    packing p{std::move(grains_), stated.bounds, stated.periodic};
    report_.box_source = stated.source;
    if (options_.bounds) {
      refuse_bad_box(*options_.bounds, "options.bounds");
      p.bounds = options_.bounds;
      report_.box_source = "options";
    }
    if (options_.periodic) {
      p.periodic = *options_.periodic;
    }
    if (p.bounds) {
      p.bounds->lo *= options_.scale;
      p.bounds->hi *= options_.scale;
      refuse_bad_box(*p.bounds, where);
    } else if (p.periodic != std::array<bool, 3>{}) {
      throw input_error(where, "periodic axes and no box", "the box, in the file or in the options");
    }
    if (options_.wrap) {
      report_.wrapping = wrap(p);
    }
    warn_of_empty_box(p);
    return p;
  }

 private:
  void warn_of_empty_box(const packing& p) {
    if (!p.bounds) {
      return;
    }
    constexpr std::array<const char*, 3> axis_name{"x", "y", "z"};
    for (std::size_t k = 0; k < 3; ++k) {
      double lo = p.grains.front().centre[k] - p.grains.front().radius;
      double hi = p.grains.front().centre[k] + p.grains.front().radius;
      for (const auto& g : p.grains) {
        lo = std::min(lo, g.centre[k] - g.radius);
        hi = std::max(hi, g.centre[k] + g.radius);
      }
      const double filled = (hi - lo) / p.bounds->size()[k];
      if (filled < 0.5) {
        report_.warnings.push_back("the grains fill " + std::to_string(static_cast<int>(100.0 * filled)) +
                                   " % of the box along " + axis_name[k]);
      }
    }
  }

  const read_options& options_;
  read_report& report_;
  std::vector<sphere<double>> grains_;
};

}  // namespace detail
}  // namespace io
}  // namespace tetrapore::inline TETRAPORE_ABI
