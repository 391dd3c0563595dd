// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/csv_table.hpp"
#include "tetrapore/law/entry/concept.hpp"
#include "tetrapore/simplex/make_opening.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <sstream>
#include <string>
#include <vector>

/// \file
/// Openings of the truth tables, random openings, and rigid motions of them.

namespace openings {

using namespace tetrapore;

template <real T>
[[nodiscard]] T degrees(T angle) {
  return angle * static_cast<T>(pi<T>) / 180;
}

[[nodiscard]] inline std::string name_of(entry_status s) {
  switch (s) {
    case entry_status::ok: return "ok";
    case entry_status::dry_corner: return "dry_corner";
    case entry_status::lost_arc: return "lost_arc";
    case entry_status::merged: return "merged";
    case entry_status::closed: return "closed";
    case entry_status::gap_limited: return "gap_limited";
    case entry_status::no_hole: return "no_hole";
    case entry_status::not_covered: return "not_covered";
    case entry_status::invalid_input: return "invalid_input";
    case entry_status::not_converged: return "not_converged";
  }
  return "unknown";
}

/// The row of a table with columns R1 … d23.
template <std::floating_point T = double>
[[nodiscard]] outcome<opening<T>, opening_status> from_row(const csv_table& t, std::size_t row) {
  const auto get = [&](const char* name) { return static_cast<T>(t.precise(row, name)); };
  return opening_from_distances<T>(get("R1"), get("R2"), get("R3"), get("d12"), get("d13"), get("d23"));
}

/// Sides written as "d:x:y:R" (disc) and "l:x:y:nx:ny" (line), separated by blanks.
[[nodiscard]] inline opening<double> from_sides(const std::string& text) {
  opening<double> o;
  std::istringstream words(text);
  for (std::string w; words >> w;) {
    std::vector<double> x;
    std::stringstream cut(w.substr(2));
    for (std::string n; std::getline(cut, n, ':');) {
      x.push_back(std::strtod(n.c_str(), nullptr));
    }
    if (w.front() == 'd') {
      o.add_disc({x[0], x[1]}, x[2]);
    } else {
      o.add_line({x[0], x[1]}, {x[2], x[3]});
    }
  }
  return o;
}

/// The same opening in another scalar.
template <real T, real S>
[[nodiscard]] opening<T> as(const opening<S>& o) {
  opening<T> r;
  r.count = o.count;
  for (std::size_t k = 0; k < o.count; ++k) {
    const auto& s = o.sides[k];
    r.sides[k] = {{T(s.point.x), T(s.point.y)}, {T(s.normal.x), T(s.normal.y)}, T(s.radius), s.kind};
    r.gaps[k] = o.gaps[k];
  }
  return r;
}

/// Begins with another side.
template <real T>
[[nodiscard]] opening<T> rotated(const opening<T>& o, std::size_t by) {
  opening<T> r = o;
  for (std::size_t k = 0; k < o.count; ++k) {
    r.sides[k] = o.sides[(k + by) % o.count];
    r.gaps[k] = o.gaps[(k + by) % o.count];
  }
  return r;
}

/// Seen from behind: mirrored in the y-axis and listed the other way round.
template <real T>
[[nodiscard]] opening<T> mirrored(const opening<T>& o) {
  opening<T> r = o;
  for (std::size_t k = 0; k < o.count; ++k) {
    r.sides[k] = o.sides[o.count - 1 - k];
    r.sides[k].point.x = -r.sides[k].point.x;
    r.sides[k].normal.x = -r.sides[k].normal.x;
    r.gaps[k] = o.gaps[(2 * o.count - 2 - k) % o.count];
  }
  return r;
}

template <real T>
[[nodiscard]] opening<T> turned(const opening<T>& o, T angle) {
  const T c = std::cos(angle);
  const T s = std::sin(angle);
  const auto turn = [&](vec2<T> v) -> vec2<T> { return {c * v.x - s * v.y, s * v.x + c * v.y}; };
  opening<T> r = o;
  for (std::size_t k = 0; k < o.count; ++k) {
    r.sides[k].point = turn(o.sides[k].point);
    r.sides[k].normal = turn(o.sides[k].normal);
  }
  return r;
}

template <real T>
[[nodiscard]] opening<T> moved(const opening<T>& o, vec2<T> by) {
  opening<T> r = o;
  for (std::size_t k = 0; k < o.count; ++k) {
    r.sides[k].point = o.sides[k].point + by;
  }
  return r;
}

template <real T>
[[nodiscard]] opening<T> scaled(const opening<T>& o, T by) {
  opening<T> r = o;
  for (std::size_t k = 0; k < o.count; ++k) {
    r.sides[k].point = o.sides[k].point * by;
    r.sides[k].radius = o.sides[k].radius * by;
  }
  return r;
}

/// Random openings of three sides as a packing has them: mostly three discs with gaps and small overlaps of any width,
/// some with one wall, some with two.
class random_throats {
 public:
  explicit random_throats(std::uint64_t seed) : engine_(seed) {}

  [[nodiscard]] double uniform(double lo, double hi) {
    return lo + (hi - lo) * (static_cast<double>(engine_() >> 11U) * 0x1p-53);
  }
  [[nodiscard]] double contact_angle() { return uniform(0, 1) < 0.4 ? 0.0 : degrees(uniform(0, 85)); }
  /// Width of a gap between radii of about 1: near contact, wide, or an overlap.
  [[nodiscard]] double gap() {
    const double kind = uniform(0, 1);
    if (kind < 0.3) {
      return std::pow(10.0, uniform(-12, -2));
    }
    return kind < 0.75 ? uniform(0, 0.5) : (kind < 0.9 ? -uniform(0, 0.08) : 0.0);
  }
  [[nodiscard]] double radius() { return uniform(0, 1) < 0.2 ? std::pow(10.0, uniform(-3, 0)) : uniform(0.4, 1.0); }

  [[nodiscard]] opening<double> operator()() {
    const double kind = uniform(0, 1);
    if (kind < 0.8) {
      for (;;) {
        const double a = radius();
        const double b = radius();
        const double c = radius();
        const auto wide = [&](double r, double s) {
          const double g = gap();
          return r + s + g * (g < 0 ? std::min(r, s) : std::min(1.0, 2 * std::min(r, s)));
        };
        const auto o = opening_from_distances(a, b, c, wide(a, b), wide(a, c), wide(b, c));
        if (o.ok()) {
          return o.value;
        }
      }
    }
    if (kind < 0.95) {
      throat<double> t{};
      t.grain_count = 2;
      const double a = radius();
      const double b = radius();
      const double low = a + std::abs(gap()) * a;
      const double high = b + std::abs(gap()) * b;
      const double d = a + b + std::abs(gap()) * std::min(a, b);
      const double across = std::sqrt(std::max(0.0, d * d - (low - high) * (low - high)));
      t.grains[0] = {{0, 0, low}, a};
      t.grains[1] = {{across, 0, high}, b};
      t.walls[0] = {{0, 0, 0}, {0, 0, 1}};
      return opening_of(t);
    }
    throat<double> t{};
    t.grain_count = 1;
    const double a = radius();
    t.grains[0] = {{a + std::abs(gap()) * a, a + std::abs(gap()) * a, 0}, a};
    t.walls[0] = {{0, 0, 0}, {1, 0, 0}};
    t.walls[1] = {{0, 0, 0}, {0, 1, 0}};
    return opening_of(t);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace openings
