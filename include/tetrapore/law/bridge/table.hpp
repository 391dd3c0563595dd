// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/bridge/closed_form.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

/// \file
/// A bridge law of one material pair from a table, made at start-up from any law that also knows where its bridges end.

namespace tetrapore::inline TETRAPORE_ABI {

/// What a table is made from: `l.bridge(edge, volume)` and `l.rupture_gap(edge, volume)`, the largest gap it spans.
template <class L>
concept tabulable = bridge_law<L, double> && requires(const L l, const edge<double> e, const given_volume<double> v) {
  { l.rupture_gap(e, v).value.gap } -> std::convertible_to<double>;
  { l.rupture_gap(e, v).ok() } -> std::convertible_to<bool>;
};

namespace detail {

[[nodiscard]] inline double size_of(double x) noexcept { return x < 0 ? -x : x; }

/// Chebyshev's places on [−1, 1] with both ends.
template <std::size_t N>
[[nodiscard]] std::array<double, N> ends_and_between() noexcept {
  std::array<double, N> x;
  for (std::size_t k = 0; k < N; ++k) {
    x[k] = -std::cos(pi<double> * static_cast<double>(k) / static_cast<double>(N - 1));
  }
  x[0] = -1;
  x[N - 1] = 1;
  return x;
}
/// The same with the upper end alone.
template <std::size_t N>
[[nodiscard]] std::array<double, N> upper_end_and_between() noexcept {
  std::array<double, N> x;
  for (std::size_t k = 0; k < N; ++k) {
    x[k] = -std::cos(pi<double> * static_cast<double>(2 * k + 1) / static_cast<double>(2 * N - 1));
  }
  x[N - 1] = 1;
  return x;
}
/// Between the places, and below the first where that is no end. A polynomial through ends_and_between is worst in the
/// middles that are no neighbours of an end.
template <std::size_t N>
[[nodiscard]] std::array<double, N> middles_of(const std::array<double, N>& x) noexcept {
  std::array<double, N> m;
  m[0] = x[0] > -1 ? (x[0] - 1) / 2 : (x[0] + x[1] * 3) / 4;
  for (std::size_t k = 1; k < N; ++k) {
    m[k] = (x[k - 1] + x[k]) / 2;
  }
  return m;
}

template <std::size_t N>
using square_matrix = std::array<std::array<double, N>, N>;

/// The matrix that makes values at the places into coefficients of powers.
template <std::size_t N>
[[nodiscard]] square_matrix<N> coefficients_of(const std::array<double, N>& x) noexcept {
  square_matrix<N> m{};
  for (std::size_t k = 0; k < N; ++k) {
    std::array<double, N> p{};  // the polynomial that is 1 at x_k and 0 at the others
    p[0] = 1;
    std::size_t degree = 0;
    for (std::size_t j = 0; j < N; ++j) {
      if (j == k) {
        continue;
      }
      const double scale = 1 / (x[k] - x[j]);
      ++degree;
      for (std::size_t i = degree; i > 0; --i) {
        p[i] = (p[i - 1] - x[j] * p[i]) * scale;
      }
      p[0] = -x[j] * p[0] * scale;
    }
    for (std::size_t i = 0; i < N; ++i) {
      m[i][k] = p[i];
    }
  }
  return m;
}

template <std::size_t N>
[[nodiscard]] std::array<double, N> product(const square_matrix<N>& m, const std::array<double, N>& x) noexcept {
  std::array<double, N> y{};
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t k = 0; k < N; ++k) {
      y[i] += m[i][k] * x[k];
    }
  }
  return y;
}

/// Asks a law for one bridge after the other along a gap: warm where the law can.
template <class Law>
struct column_solver {
  const Law& law;

  [[nodiscard]] pull_outcome<double> operator()(const edge<double>& e, given_volume<double> liquid) noexcept {
    const auto answer = law.bridge(e, liquid);
    return {{answer.value.force}, answer.reason};
  }
};
template <class Law>
  requires warm_bridge_law<Law>
struct column_solver<Law> {
  const Law& law;
  typename Law::template warm_state<double> state{};

  [[nodiscard]] pull_outcome<double> operator()(const edge<double>& e, given_volume<double> liquid) noexcept {
    const auto answer = law.bridge(e, liquid, state);
    return {{answer.value.force}, answer.reason};
  }
};

/// Degree 6, in pairs, so that the products do not wait for each other.
[[nodiscard]] inline double polynomial(const std::array<double, 7>& c, double x) noexcept {
  const double x2 = x * x;
  return ((c[0] + x * c[1]) + x2 * (c[2] + x * c[3])) + (x2 * x2) * ((c[4] + x * c[5]) + x2 * c[6]);
}

/// The gap at which the force turns back, in the widest one of stable bridges, where these end before: along a curve of
/// bridges the gap is smooth in the force, and has its maximum there. NaN where there is none in reach.
template <class Law>
[[nodiscard]] double turning_gap(const Law& law, edge<double> e, given_volume<double> liquid, double widest) noexcept {
  constexpr std::size_t n = 8;
  constexpr double reach = 0.1;     // how much of the gap the first look takes in; then some 10 times what is beyond
  constexpr double nearest = 1e-6;  // and this at least
  double part = reach;
  double beyond = 0;
  for (int look = 0; look < 3; ++look) {
    std::array<double, n> force;
    std::array<double, n> gap;  // in the widest, less 1; then divided differences
    for (std::size_t i = 0; i < n; ++i) {
      const double x = 0.55 - 0.45 * std::cos(pi<double> * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
      e.gap = widest * (1 - part * x * x);
      gap[i] = e.gap / widest - 1;
      force[i] = law.bridge(e, liquid).value.force;
    }
    for (std::size_t j = 1; j < n; ++j) {
      for (std::size_t i = n; i-- > j;) {
        gap[i] = (gap[i] - gap[i - 1]) / (force[i] - force[i - j]);
      }
    }
    double f = force[0];
    double step = f;
    for (int newton = 0; newton < 20 && size_of(step) > 1e-13 * size_of(force[0]); ++newton) {
      double slope = 0;
      double bend = 0;
      beyond = gap[n - 1];
      for (std::size_t i = n - 1; i-- > 0;) {
        bend = bend * (f - force[i]) + 2 * slope;
        slope = slope * (f - force[i]) + beyond;
        beyond = beyond * (f - force[i]) + gap[i];
      }
      step = -slope / bend;
      if (!(bend < 0)) {
        return quiet_nan<double>;
      }
      f += step;
    }
    if (!(beyond <= reach)) {
      return quiet_nan<double>;
    }
    beyond = beyond > 0 ? beyond : 0;
    part = nearest + reach * beyond / (0.1 * reach + beyond);  // smooth, so that the gap is smooth in the volume
  }
  return widest * (1 + beyond);
}

}  // namespace detail

/// What a table is asked to hold. Lengths [m], volumes [m³].
struct table_range {
  required<double> radius1;
  required<double> radius2;  ///< infinity for a plane
  required<double> least_volume;
  required<double> largest_volume;  ///< less than 2^Octaves times the least
  double deepest_overlap = 0;       ///< how far below 0 the gap may go
};

/// How a table came out.
struct table_report {
  bridge_status reason;    ///< ok; else why there is no table: more octaves than it has (not_covered), bad input, or
                           ///< what the law answered inside the range
  double error;            ///< of the force on the check grid, in the largest force of the table
  double error_at_volume;  ///< where [m³]
  double error_at_gap;     ///< where [m]
  double rupture_error;    ///< of the rupture gap on the check grid, relative
  std::uint32_t solved;    ///< bridges of the law in the table
  std::uint32_t checked;   ///< bridges of the law on the check grid
};

/// The storage of a table and its look-up; the caller keeps it, the law `tabulated` points to it.
///
/// Volumes lie in eighths of octaves. Each holds the gap D_f at which bridges fold, a length s, and cells of equal
/// width in
///
///   y = √(s (D_f − D) / ((s + D) D_f)), 1 at contact and 0 at the fold, where the force is smooth in y,
///
/// in each a polynomial of degree 3 in the volume and 4 in y, continuous from cell to cell. Where the liquid of equal
/// spheres slides to one side before the bridge folds, D_f is the gap at which it would, so that the force stays smooth
/// in y, and the y of the last bridge is a curve of its own: it starts from 0 at the volume from which on the liquid
/// slides. Where the pair is not quite equal, the force bends sharply right before the fold: the last cell is halved
/// again and again. The bits of the volume are the cell and the place in it: a look-up takes one square root and no
/// logarithm. Overlaps have cells of their own. `Octaves` is the range of volumes, 2^Octaves (29 to 37 KiB each);
/// `GapCells` the cells between contact and fold: with 8 the error grows about tenfold, and no look-up gets faster.
/// \par Units   inside: lengths in R₁, forces over R₁ [N/m]
/// \par Domain  one ratio of radii at any size, a plane, two angles; what its law answers
/// \par Accuracy  of the largest force of the table 2e-7 to 6e-7 (docs/bridges.md), in its report for each table
/// \par Source  the variables are this project's; after a table in (ln V, √(1 − ξ)), ξ a ratio of logarithms of the gap
template <int Octaves = 20, int GapCells = 16>
  requires(0 < Octaves && Octaves <= 63 && 1 < GapCells)
class bridge_table {
 public:
  /// Error of the force in the largest force of a table of the exact law, around every pair and volume of
  /// open_bridge.csv; what a table has of its own is in its report. With 16 cells or more.
  static constexpr double stated_accuracy = 1e-6;

  /// Fills the table by the law, whose angles and surface tension are those of the pair, and measures it between its
  /// nodes. After a report that is not ok the table is empty.
  template <tabulable Law>
  table_report build(const Law& law, const table_range& range) noexcept {
    rows_ = 0;
    top_ = 0;
    const edge<double> pair{range.radius1, range.radius2, 0, {}};
    if (!sound(pair) || !detail::finite_and_positive(range.least_volume.get()) ||
        !detail::finite_and_positive(range.largest_volume.get()) || !(range.largest_volume > range.least_volume) ||
        !(range.deepest_overlap >= 0) || !(range.deepest_overlap < range.radius1) ||
        !(range.deepest_overlap < range.radius2)) {
      return refused(bridge_status::invalid_input);
    }
    const double span = range.largest_volume / range.least_volume;
    const int rows = cell_of(span) + 1;
    if (!(span < static_cast<double>(std::uint64_t{1} << Octaves)) || rows > row_count) {
      return refused(bridge_status::not_covered);
    }
    plane_first_ = !(range.radius1 < infinity<double>);
    radius1_ = plane_first_ ? range.radius2 : range.radius1;
    ratio_ = plane_first_ ? infinity<double> : range.radius2 / range.radius1;
    unit_ = range.least_volume / (radius1_ * radius1_ * radius1_);
    per_unit_ = 1 / unit_;
    per_radius1_ = 1 / radius1_;
    depth_ = range.deepest_overlap / radius1_;
    const table_report made = fill(law, rows);
    if (made.reason == bridge_status::ok) {
      rows_ = rows;
      top_ = upper_end(rows - 1);
      exchangeable_ = same_from_the_other_end(law);
    }
    return made;
  }

  /// The force by the table, for a ratio of radii that is its own but for a relative tolerance. \par Units  [m], [m³]
  [[nodiscard]] outcome<bridge_pull<double>, bridge_status> pull(double radius1, double radius2, double gap_of_pair,
                                                                 double volume,
                                                                 double tolerance = 1e-9) const noexcept {
    const bool swapped = exchangeable_ ? !alike(radius2, radius1, tolerance) : plane_first_;
    const double radius = swapped ? radius2 : radius1;
    const double other = swapped ? radius1 : radius2;
    const double inverse = radius == radius1_ ? per_radius1_ : 1 / radius;
    const double v = volume * (inverse * inverse * inverse) * per_unit_;
    if (!(v >= 1 && v < top_) || !alike(other, radius, tolerance)) {
      return detail::no_pull<double>(why_not({radius1, radius2, gap_of_pair, {}}, volume));
    }
    const place at = place_of(v);
    const row& cells = row_[at.row];
    const double gap = gap_of_pair * inverse;
    const double fold = detail::polynomial(cells.fold, at.t);
    if (!(gap <= fold)) {
      return detail::no_pull<double>(gap > fold && gap <= largest ? cells.beyond(at.t) : bridge_status::invalid_input);
    }
    const double s = cells.scale + cells.scale_slope * at.t;
    double z;  // in widths of a cell, from the last bridge to contact and on into the overlap
    if (gap >= 0) {
      const double y = std::sqrt(s * (fold - gap) / ((s + gap) * fold));
      if (cells.slides(at.t) && y < detail::polynomial(cells.last, at.t)) {
        return detail::no_pull<double>(bridge_status::lopsided);
      }
      z = GapCells - (1 - y) * (cells.width + cells.width_slope * at.t);
    } else if (gap >= -depth_) {
      z = GapCells + overlap_cells * (gap * (into * s + depth_) / ((gap - into * s) * depth_));
    } else {
      return detail::no_pull<double>(gap > -1 && gap > -ratio_ ? bridge_status::not_covered
                                                               : bridge_status::invalid_input);
    }
    int k;
    double x;  // in the cell, from −1 to 1
    if (z >= 1) {
      const int last = gap >= 0 ? GapCells - 1 : GapCells + overlap_cells - 1;
      k = static_cast<int>(z) < last ? static_cast<int>(z) : last;
      x = 2 * (z - k) - 1;
      k += halvings;
    } else {
      const cell in = cell_at(z);
      k = in.index;
      x = 2 * (z - in.from) / in.width - 1;
    }
    return {{radius * cells.force[static_cast<std::size_t>(k)].at(at.t, x)}, bridge_status::ok};
  }

 private:
  static constexpr int per_octave = 8;
  static constexpr int row_count = Octaves * per_octave;
  static constexpr int overlap_cells = 8;
  static constexpr int halvings = 4;  ///< of the last gap cell, towards rupture
  static constexpr std::size_t volume_nodes = 4;
  static constexpr std::size_t gap_nodes = 5;
  static constexpr std::size_t limit_nodes = 7;
  static constexpr std::size_t cell_count = static_cast<std::size_t>(halvings + GapCells + overlap_cells);
  static constexpr std::size_t column_length = (gap_nodes - 1) * cell_count + 1;

  /// A polynomial in the place in the volume cell and the place in the gap cell, both from −1 to 1.
  struct patch {
    std::array<std::array<double, volume_nodes>, gap_nodes> by;  ///< by power of the gap, then of the volume

    [[nodiscard]] double at(double t, double y) const noexcept {
      const double y2 = y * y;
      const double y4 = y2 * y2;
      std::array<double, volume_nodes> c;
      for (std::size_t i = 0; i < volume_nodes; ++i) {
        c[i] = ((by[0][i] + y * by[1][i]) + y2 * (by[2][i] + y * by[3][i])) + y4 * by[4][i];
      }
      return (c[0] + t * c[1]) + (t * t) * (c[2] + t * c[3]);
    }
  };
  struct row {
    std::array<double, limit_nodes> fold;  ///< coefficients of the gap where bridges fold, in R₁
    double scale;                          ///< s in the middle, in R₁
    double scale_slope;
    double width;  ///< gap cells per unit of y, in the middle
    double width_slope;
    double turn;  ///< the liquid slides to one side where direction × place > turn
    double direction;
    std::array<double, limit_nodes> last;  ///< coefficients of the y of the last bridge, where the liquid slides
    bridge_status beyond_fold;             ///< what the law says there
    std::array<patch, cell_count> force;

    [[nodiscard]] bool slides(double t) const noexcept { return direction * t > turn; }
    [[nodiscard]] bool slides_at_all() const noexcept { return turn < 1; }
    [[nodiscard]] double last_y(double t) const noexcept { return slides(t) ? detail::polynomial(last, t) : 0; }
    [[nodiscard]] bridge_status beyond(double t) const noexcept {
      return slides(t) ? bridge_status::lopsided : beyond_fold;
    }
    /// The place of the last bridge, in widths of a cell.
    [[nodiscard]] double lowest(double t) const noexcept {
      return GapCells - (1 - last_y(t)) * (width + width_slope * t);
    }
  };
  struct place {
    std::size_t row;
    double t;
  };

  [[nodiscard]] static int cell_of(double v) noexcept {
    return static_cast<int>(std::bit_cast<std::uint64_t>(v) >> 49) - 1023 * per_octave;
  }
  [[nodiscard]] static place place_of(double v) noexcept {
    constexpr std::uint64_t low_bits = (std::uint64_t{1} << 49) - 1;
    constexpr std::uint64_t one = std::uint64_t{1023} << 52;
    const double within = std::bit_cast<double>((std::bit_cast<std::uint64_t>(v) & low_bits) | one);  // 1 to 1.125
    return {static_cast<std::size_t>(cell_of(v)), within * 16 - 17};
  }
  /// The volume, in the least one, at a place in a row.
  [[nodiscard]] static double volume_at(int k, double t) noexcept {
    return std::ldexp(1 + (k % per_octave) * 0.125 + (t + 1) * 0.0625, k / per_octave);
  }
  [[nodiscard]] static double upper_end(int k) noexcept { return volume_at(k, 1); }

  [[nodiscard]] bool alike(double other, double radius, double tolerance) const noexcept {
    const double expected = radius * ratio_;
    return other == expected || (other - expected < tolerance * other && expected - other < tolerance * other);
  }
  static constexpr double far_fold = 1.06;  ///< in the widest gap
  static constexpr double into = 3;         ///< the length of an overlap over that of a gap
  static constexpr double largest = std::numeric_limits<double>::max();

  /// Why the fast path has no answer: bad input, no liquid, another pair or a volume outside the table.
  [[nodiscard]] bridge_status why_not(const edge<double>& e, double volume) const noexcept {
    if (!sound(e) || !(volume >= 0) || !(volume <= largest)) {
      return bridge_status::invalid_input;
    }
    return volume > 0 ? bridge_status::not_covered : bridge_status::no_liquid;
  }

  /// Two spheres, or a sphere and a plane, in either order.
  [[nodiscard]] static bool sound(const edge<double>& e) noexcept {
    const double smaller = e.radius1 < e.radius2 ? e.radius1 : e.radius2;
    return e.radius1 > 0 && e.radius2 > 0 && smaller <= largest && e.gap > -smaller && e.gap <= largest;
  }

  [[nodiscard]] static table_report refused(bridge_status why) noexcept {
    const double unknown = quiet_nan<double>;
    return {why, unknown, unknown, unknown, unknown, 0, 0};
  }

  [[nodiscard]] edge<double> pair_at(double gap) const noexcept {
    const double other = radius1_ * ratio_;
    return {plane_first_ ? other : radius1_, plane_first_ ? radius1_ : other, radius1_ * gap, {0, 0, 1}};
  }
  [[nodiscard]] given_volume<double> liquid_at(int k, double t) const noexcept {
    return {volume_at(k, t) * unit_ * radius1_ * radius1_ * radius1_};
  }

  [[nodiscard]] static double scale_at(const row& r, double t) noexcept { return r.scale + r.scale_slope * t; }

  /// The gap of a place z of a row, in widths of a cell from the fold on.
  [[nodiscard]] double gap_of(const row& r, double t, double z) const noexcept {
    const double s = scale_at(r, t);
    if (z <= GapCells) {
      const double fold = detail::polynomial(r.fold, t);
      const double y = 1 - (GapCells - z) / (r.width + r.width_slope * t);
      const double q = y * y;
      return s * fold * (1 - q) / (s + q * fold);
    }
    const double u = (z - GapCells) / overlap_cells;
    return -u * into * s * depth_ / (into * s + depth_ * (1 - u));
  }
  /// A cell along the gap: the last of equal width is halved again and again.
  struct cell {
    int index;
    double from;
    double width;

    [[nodiscard]] double at(double x) const noexcept { return from + width * (x + 1) / 2; }
  };
  [[nodiscard]] static cell cell_of_index(int c) noexcept {
    return c == 0          ? cell{0, 0, 1.0 / (1 << halvings)}
           : c <= halvings ? cell{c, 1.0 / (2 << (halvings - c)), 1.0 / (2 << (halvings - c))}
                           : cell{c, static_cast<double>(c - halvings), 1};
  }
  /// The cell of a place below 1.
  [[nodiscard]] static cell cell_at(double z) noexcept {
    const int halved = z > 0 ? 1022 - static_cast<int>(std::bit_cast<std::uint64_t>(z) >> 52) : halvings;
    return cell_of_index(halved < halvings ? halvings - halved : 0);
  }

  /// Where the bridges of a volume end.
  struct limit {
    bridge_status reason;
    bridge_status beyond;  ///< what the law says beyond
    double gap;            ///< the widest, in R₁
    double fold;           ///< where they fold; see with_fold

    [[nodiscard]] bool slides() const noexcept { return beyond == bridge_status::lopsided; }
  };
  template <tabulable Law>
  [[nodiscard]] limit limit_at(const Law& law, int k, double t) const noexcept {
    const given_volume<double> liquid = liquid_at(k, t);
    const auto widest = law.rupture_gap(pair_at(0), liquid);
    limit found{widest.reason, bridge_status::ok, widest.value.gap / radius1_, widest.value.gap / radius1_};
    if (!widest.ok()) {
      return found;
    }
    found.beyond = law.bridge(pair_at(found.gap * 1.001), liquid).reason;
    if (!(found.gap > 0) || verdict_of(found.beyond) != verdict::absent) {
      found.reason = !(found.gap > 0) || found.beyond == bridge_status::ok ? bridge_status::not_covered : found.beyond;
    }
    return found;
  }

  /// The same, with the gap at which bridges that end before would fold; NaN where that is far.
  template <tabulable Law>
  [[nodiscard]] limit with_fold(const Law& law, int k, double t) const noexcept {
    limit found = limit_at(law, k, t);
    if (found.reason == bridge_status::ok && found.slides()) {
      found.fold = detail::turning_gap(law, pair_at(0), liquid_at(k, t), found.gap * radius1_) / radius1_;
    }
    return found;
  }

  /// The curves of a row: where its bridges fold, and where the liquid slides to one side. `lower` is where the bridges
  /// at its lower end end, known from the row before it, and becomes that of its upper end.
  template <tabulable Law>
  [[nodiscard]] bridge_status draw_limits(const Law& law, int k, limit& lower) noexcept {
    const auto places = detail::ends_and_between<limit_nodes>();
    const auto fit = detail::coefficients_of(places);
    std::array<limit, limit_nodes> at;
    std::array<double, limit_nodes> fold;
    bool far = false;
    for (std::size_t i = 0; i < limit_nodes; ++i) {
      at[i] = i == 0 ? lower : with_fold(law, k, places[i]);
      if (at[i].reason != bridge_status::ok) {
        return at[i].reason;
      }
      fold[i] = at[i].fold;
      far = far || !(fold[i] > 0);
    }
    lower = at.back();
    if (far) {  // any smooth curve beyond the bridges will do
      for (std::size_t i = 0; i < limit_nodes; ++i) {
        fold[i] = far_fold * at[i].gap;
      }
    }
    row& made = row_[static_cast<std::size_t>(k)];
    made.fold = detail::product(fit, fold);
    const double low = scale_of(volume_at(k, -1), fold.front());
    const double high = scale_of(volume_at(k, 1), fold.back());
    made.scale = (low + high) / 2;
    made.scale_slope = (high - low) / 2;
    made.beyond_fold = at[at.front().slides() ? limit_nodes - 1 : 0].beyond;
    return draw_last(law, k, at);
  }
  /// The part of draw_limits that concerns liquid that slides.
  template <tabulable Law>
  [[nodiscard]] bridge_status draw_last(const Law& law, int k, const std::array<limit, limit_nodes>& at) noexcept {
    row& made = row_[static_cast<std::size_t>(k)];
    const auto places = detail::ends_and_between<limit_nodes>();
    const auto y_at = [&](double t, double gap) {
      const double s = scale_at(made, t);
      const double fold = detail::polynomial(made.fold, t);
      const double q = s * (fold - gap) / ((s + gap) * fold);
      return q > 0 ? std::sqrt(q) : 0;
    };
    made.last = {};
    made.direction = 1;
    made.turn = at.front().slides() ? -2 : 2;
    if (at.front().slides() && at.back().slides()) {
      std::array<double, limit_nodes> y;
      for (std::size_t i = 0; i < limit_nodes; ++i) {
        y[i] = y_at(places[i], at[i].gap);
      }
      made.last = detail::product(detail::coefficients_of(places), y);
    } else if (at.front().slides() != at.back().slides()) {
      made.direction = at.back().slides() ? 1 : -1;
      double folding = -made.direction;
      double sliding = made.direction;
      for (int i = 0; i < 45; ++i) {
        const double t = (folding + sliding) / 2;
        const limit there = limit_at(law, k, t);
        if (there.reason != bridge_status::ok) {
          return there.reason;
        }
        (there.slides() ? sliding : folding) = t;
      }
      made.turn = made.direction * folding;
      constexpr std::size_t n = 4;  // the y of the last bridge begins at 0 there, and is small
      std::array<double, n> t = detail::ends_and_between<n>();
      std::array<double, n> y{};
      for (std::size_t i = 0; i < n; ++i) {
        t[i] = folding + (made.direction - folding) * (t[i] + 1) / 2;
        if (i > 0) {
          const limit there = limit_at(law, k, t[i]);
          if (there.reason != bridge_status::ok) {
            return there.reason;
          }
          y[i] = y_at(t[i], there.gap);
        }
      }
      const auto fitted = detail::product(detail::coefficients_of(t), y);
      for (std::size_t i = 0; i < n; ++i) {
        made.last[i] = fitted[i];
      }
    }
    const double low = GapCells / (1 - made.last_y(-1));
    const double high = GapCells / (1 - made.last_y(1));
    made.width = (low + high) / 2;
    made.width_slope = (high - low) / 2;
    return bridge_status::ok;
  }

  using column = std::array<double, column_length>;

  /// The forces of a volume, over R₁, at the places of all cells from the last bridge to the deepest overlap.
  template <tabulable Law>
  [[nodiscard]] bridge_status fill_column(const Law& law, int k, double t, column& force,
                                          std::uint32_t& solved) const noexcept {
    const row& here = row_[static_cast<std::size_t>(k)];
    detail::column_solver<Law> solver{law};
    bridge_status reason = bridge_status::ok;
    const auto solve = [&](double z) {
      const auto answer = solver(pair_at(gap_of(here, t, z)), liquid_at(k, t));
      reason = reason == bridge_status::ok ? answer.reason : reason;
      ++solved;
      return answer.value.force / radius1_;
    };
    const int halved = here.slides_at_all() ? halvings : -1;
    for (int c = cells() - 1; c >= 0; --c) {  // from the deepest overlap on
      const auto places = c == 0 ? detail::upper_end_and_between<gap_nodes>() : detail::ends_and_between<gap_nodes>();
      double* const at = &force[static_cast<std::size_t>(c) * (gap_nodes - 1)];
      for (std::size_t j = gap_nodes; c > halved && j-- > (c == 0 ? 0U : 1U);) {
        at[j] = solve(cell_of_index(c).at(places[j]));
      }
    }
    if (here.slides_at_all()) {  // the force goes on smoothly, so that one polynomial serves for the halves
      auto places = detail::upper_end_and_between<gap_nodes>();
      const double lowest = here.lowest(t);
      std::array<double, gap_nodes> values;
      for (std::size_t j = gap_nodes; j-- > 0;) {
        values[j] = solve(1 + (places[j] - 1) / 2 * (1 - lowest));
      }
      const auto powers = detail::product(detail::coefficients_of(places), values);
      for (int c = halvings; c >= 0; --c) {
        const auto within = c == 0 ? places : detail::ends_and_between<gap_nodes>();
        for (std::size_t j = gap_nodes; j-- > (c == 0 ? 0U : 1U);) {
          const double x = 1 + 2 * (cell_of_index(c).at(within[j]) - 1) / (1 - lowest);
          double sum = 0;
          for (std::size_t i = gap_nodes; i-- > 0;) {
            sum = sum * x + powers[i];
          }
          force[static_cast<std::size_t>(c) * (gap_nodes - 1) + j] = sum;
        }
      }
    }
    return reason;
  }

  template <tabulable Law>
  [[nodiscard]] table_report fill(const Law& law, int rows) noexcept {
    table_report report{bridge_status::ok, 0, 0, 0, 0, 0, 0};
    const auto volume_places = detail::ends_and_between<volume_nodes>();
    const auto volume_fit = detail::coefficients_of(volume_places);
    const auto gap_fit = detail::coefficients_of(detail::ends_and_between<gap_nodes>());
    const auto first_fit = detail::coefficients_of(detail::upper_end_and_between<gap_nodes>());
    std::array<column, volume_nodes> force;
    double most = 0;
    limit lower = with_fold(law, 0, -1);
    for (int k = 0; k < rows; ++k) {
      const bridge_status drawn = draw_limits(law, k, lower);
      if (drawn != bridge_status::ok) {
        return refused(drawn);
      }
      // the lower end of a row is the upper end of the one before it
      for (std::size_t i = 0; i < volume_nodes; ++i) {
        if (i == 0 && k > 0 && joined(k)) {
          force[0] = force[volume_nodes - 1];
          continue;
        }
        const bridge_status filled = fill_column(law, k, volume_places[i], force[i], report.solved);
        if (filled != bridge_status::ok) {
          return refused(filled);
        }
      }
      for (int c = 0; c < cells(); ++c) {
        const std::size_t first = static_cast<std::size_t>(c) * (gap_nodes - 1);
        std::array<std::array<double, gap_nodes>, volume_nodes> fitted;
        for (std::size_t i = 0; i < volume_nodes; ++i) {
          std::array<double, gap_nodes> along;
          for (std::size_t j = 0; j < gap_nodes; ++j) {
            along[j] = force[i][first + j];
            most = along[j] > most ? along[j] : most;
          }
          fitted[i] = detail::product(c == 0 ? first_fit : gap_fit, along);
        }
        for (std::size_t j = 0; j < gap_nodes; ++j) {
          std::array<double, volume_nodes> across;
          for (std::size_t i = 0; i < volume_nodes; ++i) {
            across[i] = fitted[i][j];
          }
          row_[static_cast<std::size_t>(k)].force[static_cast<std::size_t>(c)].by[j] =
              detail::product(volume_fit, across);
        }
      }
    }
    return check(law, rows, most, report);
  }
  [[nodiscard]] int cells() const noexcept { return halvings + GapCells + (depth_ > 0 ? overlap_cells : 0); }

  /// Whether a row begins as the one before it ends.
  [[nodiscard]] bool joined(int k) const noexcept {
    const row& before = row_[static_cast<std::size_t>(k - 1)];
    const row& here = row_[static_cast<std::size_t>(k)];
    const double fold = detail::polynomial(here.fold, -1) / detail::polynomial(before.fold, 1) - 1;
    const double width = (here.width - here.width_slope) / (before.width + before.width_slope) - 1;
    return detail::size_of(fold) < 1e-12 && detail::size_of(width) < 1e-12;
  }

  /// Measures the table between its nodes.
  template <tabulable Law>
  [[nodiscard]] table_report check(const Law& law, int rows, double most, table_report report) noexcept {
    const auto volume_places = detail::middles_of(detail::ends_and_between<volume_nodes>());
    const auto gap_places = detail::middles_of(detail::ends_and_between<gap_nodes>());
    const auto first_places = detail::middles_of(detail::upper_end_and_between<gap_nodes>());
    const auto given_up = [this](bridge_status why) {
      rows_ = 0;
      top_ = 0;
      return refused(why);
    };
    rows_ = rows;
    top_ = upper_end(rows - 1);
    exchangeable_ = false;
    for (int k = 0; k < rows; ++k) {
      const row& made = row_[static_cast<std::size_t>(k)];
      for (std::size_t i = 1; i < volume_nodes; ++i) {
        const double t = volume_places[i];
        const auto liquid = liquid_at(k, t);
        const auto widest = law.rupture_gap(pair_at(0), liquid);
        const double off = widest.value.gap / (radius1_ * gap_of(made, t, made.lowest(t))) - 1;
        if (!widest.ok() || !(off < 1) || !(off > -1)) {
          return given_up(widest.ok() ? bridge_status::not_covered : widest.reason);
        }
        report.rupture_error =
            detail::size_of(off) > report.rupture_error ? detail::size_of(off) : report.rupture_error;
        if (i != volume_nodes / 2 && detail::size_of(made.turn) > 1) {
          continue;  // the middle is the worst place of a row that is smooth
        }
        // where the liquid slides the halved cells are one
        for (int c = made.slides_at_all() ? halvings : 0; c < cells(); ++c) {
          const bool first = c == (made.slides_at_all() ? halvings : 0);
          for (std::size_t j = first ? 0 : 2; j + 1 < gap_nodes; ++j) {
            const double z = !first                 ? cell_of_index(c).at(gap_places[j])
                             : made.slides_at_all() ? 1 + (first_places[j] - 1) / 2 * (1 - made.lowest(t))
                                                    : cell_of_index(c).at(first_places[j]);
            const auto e = pair_at(gap_of(made, t, z));
            const auto exact = law.bridge(e, liquid);
            const auto mine = pull(e.radius1, e.radius2, e.gap, liquid.value);
            if (!exact.ok() || !mine.ok()) {
              return given_up(exact.ok() ? mine.reason : exact.reason);
            }
            ++report.checked;
            const double error = detail::size_of(mine.value.force - exact.value.force) / (most * radius1_);
            if (error > report.error) {
              report.error = error;
              report.error_at_volume = liquid.value;
              report.error_at_gap = e.gap;
            }
          }
        }
      }
    }
    return report;
  }

  /// Between the length √(V/R) over which the force falls and the rupture gap.
  [[nodiscard]] double scale_of(double v, double rupture) const noexcept {
    return std::sqrt(std::sqrt(v * unit_) * 0.05 * rupture);
  }

  template <tabulable Law>
  [[nodiscard]] bool same_from_the_other_end(const Law& law) const noexcept {
    const edge<double> e = pair_at(0);
    const given_volume<double> liquid = liquid_at(0, 0.5);
    const auto back = law.bridge(edge<double>{e.radius2, e.radius1, e.gap, e.normal}, liquid);
    const double difference = back.value.force / law.bridge(e, liquid).value.force - 1;
    return back.ok() && difference < 1e-9 && difference > -1e-9;
  }

  double radius1_ = 1;
  double ratio_ = 1;
  double unit_ = 1;  ///< the least volume, in R₁³
  double per_radius1_ = 1;
  double per_unit_ = 1;
  double top_ = 0;    ///< the end of the last row, in the least volume; 0: empty
  double depth_ = 0;  ///< deepest overlap, in R₁
  bool exchangeable_ = false;
  bool plane_first_ = false;  ///< built for a plane and a sphere, so that R₁ is the second radius
  int rows_ = 0;
  std::array<row, static_cast<std::size_t>(row_count)> row_;
};

/// The force of a pair from a table that the caller keeps and has built.
/// \par Units   as the table was built: force [N] for lengths [m]
/// \par Domain  pairs of the table's ratio of radii (to 1e-9; to a rounding where they are float), at any size; its
///              volumes relative to R³; gaps from its deepest overlap on: not_covered outside. Beyond the rupture gap
///              the answer of the law it was made from. Computes in double
/// \par Accuracy  1.3 times the error in the table's report, 2e-7 to 6e-7 of the largest force; 25 ns
/// \par Source  own; the law that it was made from
template <class Table = bridge_table<>>
struct tabulated {
  const Table* table;

  /// As of the table, in the largest force that it holds.
  static constexpr double stated_accuracy = Table::stated_accuracy;

  template <std::floating_point T>
  [[nodiscard]] outcome<bridge_pull<T>, bridge_status> bridge(const edge<T>& e, given_volume<T> liquid) const noexcept {
    const auto answer = table->pull(static_cast<double>(e.radius1), static_cast<double>(e.radius2),
                                    static_cast<double>(e.gap), static_cast<double>(liquid.value),
                                    std::is_same_v<T, float> ? 4 * static_cast<double>(epsilon<float>) : 1e-9);
    return {{static_cast<T>(answer.value.force)}, answer.reason};
  }
};
static_assert(bridge_law<tabulated<>>);

}  // namespace tetrapore::inline TETRAPORE_ABI
