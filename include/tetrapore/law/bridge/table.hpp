// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/bridge/closed_form.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

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

/// Degree 7, in pairs, so that the products do not wait for each other.
[[nodiscard]] inline double polynomial(const std::array<double, 8>& c, double x) noexcept {
  const double x2 = x * x;
  return ((c[0] + x * c[1]) + x2 * (c[2] + x * c[3])) + (x2 * x2) * ((c[4] + x * c[5]) + x2 * (c[6] + x * c[7]));
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
/// Volumes lie in quarters of octaves. Each holds the rupture gap D_r and a length s, and cells of equal width in
///
///   y = √(s (D_r − D) / ((s + D) D_r)), 1 at contact and 0 at rupture, where the force is smooth in y,
///
/// (where equal spheres lose their bridge to the lopsided limit, just before it folds, cells that narrow towards
/// rupture), in each a polynomial of degree 4 in the volume and 5 in y, continuous from cell to cell. The bits of the
/// volume are the cell and the place in it, so that a look-up takes one square root and no logarithm. Overlaps have
/// cells of their own.
/// \par Units   inside: lengths in R₁, forces over R₁ [N/m]
/// \par Source  the variables are this project's; after a table in (ln V, √(1 − ξ)), ξ a ratio of logarithms of the gap
template <int Octaves = 16, int GapCells = 16>
  requires(Octaves > 0 && GapCells > 1)
class bridge_table {
 public:
  /// Error of the force in the largest force of a table of the exact law, for every pair and volume of open_bridge.csv;
  /// what a table has of its own is in its report. With 16 cells or more.
  static constexpr double stated_accuracy = 1e-6;

  /// Fills the table by the law, whose angles and surface tension are those of the pair, and measures it between its
  /// nodes. After a report that is not ok the table is empty.
  template <tabulable Law>
  table_report build(const Law& law, const table_range& range) noexcept {
    rows_ = 0;
    top_ = 0;
    const edge<double> pair{range.radius1, range.radius2, 0, {}};
    if (detail::admit_pair(pair, 1.0, 0.0, 0.0) != bridge_status::ok ||
        !detail::finite_and_positive(range.least_volume.get()) ||
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
    radius1_ = range.radius1;
    ratio_ = range.radius2 / range.radius1;
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

  /// The force by the table. \par Units  [m], [m³]
  [[nodiscard]] outcome<bridge_pull<double>, bridge_status> pull(double radius1, double radius2, double gap_of_pair,
                                                                 double volume) const noexcept {
    const bool swapped = exchangeable_ && !alike(radius2, radius1);
    const double radius = swapped ? radius2 : radius1;
    const double other = swapped ? radius1 : radius2;
    const double inverse = radius == radius1_ ? per_radius1_ : 1 / radius;
    const double v = volume * (inverse * inverse * inverse) * per_unit_;
    if (!(v >= 1 && v < top_) || !alike(other, radius)) {
      return detail::no_pull<double>(why_not({radius1, radius2, gap_of_pair, {}}, volume));
    }
    const place at = place_of(v);
    const row& cells = row_[at.row];
    const double gap = gap_of_pair * inverse;
    const double rupture = detail::polynomial(cells.rupture, at.t);
    if (!(gap <= rupture)) {
      return detail::no_pull<double>(gap > rupture && gap <= largest ? cells.beyond : bridge_status::invalid_input);
    }
    const double s = cells.scale + cells.scale_slope * at.t;
    double z;  // in widths of a cell, from rupture to contact and on into the overlap
    if (gap >= 0) {
      const double y = std::sqrt(s * (rupture - gap) / ((s + gap) * rupture));
      z = GapCells * (graded_ ? (std::sqrt(grade * grade + 4 * (1 + grade) * y) - grade) / 2 : y);
    } else if (gap >= -depth_) {
      z = GapCells + OverlapCells * (gap * (s + depth_) / ((gap - s) * depth_));
    } else {
      return detail::no_pull<double>(gap > -1 && gap > -ratio_ ? bridge_status::not_covered
                                                               : bridge_status::invalid_input);
    }
    const int last = gap >= 0 ? GapCells - 1 : GapCells + OverlapCells - 1;
    const int k = static_cast<int>(z) < last ? static_cast<int>(z) : last;
    return {{radius * cells.force[static_cast<std::size_t>(k)].at(at.t, 2 * (z - k) - 1)}, bridge_status::ok};
  }

 private:
  static constexpr int per_octave = 4;
  static constexpr int row_count = Octaves * per_octave;
  static constexpr int OverlapCells = 3;
  static constexpr std::size_t volume_nodes = 5;
  static constexpr std::size_t gap_nodes = 6;
  static constexpr std::size_t rupture_nodes = 8;
  static constexpr std::size_t cell_count = static_cast<std::size_t>(GapCells + OverlapCells);
  static constexpr std::size_t column_length = (gap_nodes - 1) * cell_count + 1;

  /// A polynomial in the place in the volume cell and the place in the gap cell, both from −1 to 1.
  struct patch {
    std::array<std::array<double, gap_nodes>, volume_nodes> by;  ///< by power of the volume, then of the gap

    [[nodiscard]] double at(double t, double y) const noexcept {
      std::array<double, gap_nodes> c = by[volume_nodes - 1];
      for (std::size_t i = volume_nodes - 1; i-- > 0;) {
        for (std::size_t j = 0; j < gap_nodes; ++j) {
          c[j] = c[j] * t + by[i][j];
        }
      }
      const double y2 = y * y;
      return (c[0] + y * c[1]) + y2 * ((c[2] + y * c[3]) + y2 * (c[4] + y * c[5]));
    }
  };
  struct row {
    std::array<double, rupture_nodes> rupture;  ///< coefficients of the rupture gap, in R₁
    double scale;                               ///< s in the middle, in R₁
    double scale_slope;
    bridge_status beyond;  ///< what the law says beyond the rupture gap
    std::array<patch, cell_count> force;
  };
  struct place {
    std::size_t row;
    double t;
  };

  [[nodiscard]] static int cell_of(double v) noexcept {
    return static_cast<int>(std::bit_cast<std::uint64_t>(v) >> 50) - 1023 * per_octave;
  }
  [[nodiscard]] static place place_of(double v) noexcept {
    constexpr std::uint64_t low_bits = (std::uint64_t{1} << 50) - 1;
    constexpr std::uint64_t one = std::uint64_t{1023} << 52;
    const double within = std::bit_cast<double>((std::bit_cast<std::uint64_t>(v) & low_bits) | one);  // 1 to 1.25
    return {static_cast<std::size_t>(cell_of(v)), within * 8 - 9};
  }
  /// The volume, in the least one, at a place in a row.
  [[nodiscard]] static double volume_at(int k, double t) noexcept {
    return std::ldexp(1 + (k % per_octave) * 0.25 + (t + 1) * 0.125, k / per_octave);
  }
  [[nodiscard]] static double upper_end(int k) noexcept { return volume_at(k, 1); }

  [[nodiscard]] bool alike(double other, double radius) const noexcept {
    const double expected = radius * ratio_;
    return other == expected || (other - expected < 1e-9 * other && expected - other < 1e-9 * other);
  }
  static constexpr double grade = 0.3;
  static constexpr double largest = std::numeric_limits<double>::max();

  /// Why the fast path has no answer: bad input, no liquid, another pair or a volume outside the table.
  [[nodiscard]] bridge_status why_not(const edge<double>& e, double volume) const noexcept {
    if (detail::admit_pair(e, 1.0, 0.0, 0.0) != bridge_status::ok || !(volume >= 0) || !(volume <= largest)) {
      return bridge_status::invalid_input;
    }
    return volume > 0 ? bridge_status::not_covered : bridge_status::no_liquid;
  }

  [[nodiscard]] static table_report refused(bridge_status why) noexcept {
    const double unknown = quiet_nan<double>;
    return {why, unknown, unknown, unknown, unknown, 0, 0};
  }

  [[nodiscard]] edge<double> pair_at(double gap) const noexcept {
    return {radius1_, radius1_ * ratio_, radius1_ * gap, {0, 0, 1}};
  }
  [[nodiscard]] given_volume<double> liquid_at(int k, double t) const noexcept {
    return {volume_at(k, t) * unit_ * radius1_ * radius1_ * radius1_};
  }

  /// The gap of a place z, in widths of a cell from rupture on.
  [[nodiscard]] double gap_of(double z, double rupture, double s) const noexcept {
    if (z <= GapCells) {
      const double u = z / GapCells;
      const double y = graded_ ? u * (u + grade) / (1 + grade) : u;
      const double q = y * y;
      return s * rupture * (1 - q) / (s + q * rupture);
    }
    const double u = (z - GapCells) / OverlapCells;
    return -u * s * depth_ / (s + depth_ * (1 - u));
  }

  template <tabulable Law>
  [[nodiscard]] table_report fill(const Law& law, int rows) noexcept {
    table_report report{bridge_status::ok, 0, 0, 0, 0, 0, 0};
    const auto rupture_places = detail::ends_and_between<rupture_nodes>();
    const auto volume_places = detail::ends_and_between<volume_nodes>();
    const auto gap_places = detail::ends_and_between<gap_nodes>();
    const auto first_places = detail::upper_end_and_between<gap_nodes>();
    const auto rupture_fit = detail::coefficients_of(rupture_places);
    const auto volume_fit = detail::coefficients_of(volume_places);
    const auto gap_fit = detail::coefficients_of(gap_places);
    const auto first_fit = detail::coefficients_of(first_places);
    const int cells = depth_ > 0 ? GapCells + OverlapCells : GapCells;
    std::array<std::array<double, column_length>, volume_nodes> force;  // over R₁, by place in the volume
    double most = 0;

    graded_ = false;
    for (int k = 0; k < rows; ++k) {
      row& made = row_[static_cast<std::size_t>(k)];
      std::array<double, rupture_nodes> rupture;
      for (std::size_t i = 0; i < rupture_nodes; ++i) {
        const bridge_status found = rupture_at(law, k, rupture_places[i], rupture[i]);
        if (found != bridge_status::ok) {
          return refused(found);
        }
      }
      made.rupture = detail::product(rupture_fit, rupture);
      const bridge_status found = keep_within(law, k, detail::middles_of(rupture_places));
      if (found != bridge_status::ok) {
        return refused(found);
      }
      const double lower = scale_of(volume_at(k, -1), rupture.front());
      const double upper = scale_of(volume_at(k, 1), rupture.back());
      made.scale = (lower + upper) / 2;
      made.scale_slope = (upper - lower) / 2;
      made.beyond =
          law.bridge(pair_at(rupture[rupture_nodes / 2] * 1.001), liquid_at(k, rupture_places[rupture_nodes / 2]))
              .reason;
      if (verdict_of(made.beyond) != verdict::absent) {
        return refused(made.beyond == bridge_status::ok ? bridge_status::not_covered : made.beyond);
      }
      graded_ = graded_ || made.beyond == bridge_status::lopsided;
    }
    for (int k = 0; k < rows; ++k) {
      row& made = row_[static_cast<std::size_t>(k)];
      // the lower end of a row is the upper end of the one before it
      for (std::size_t i = 0; i < volume_nodes; ++i) {
        if (k > 0 && i == 0 && joined(k)) {
          force[0] = force[volume_nodes - 1];
          continue;
        }
        const double t = volume_places[i];
        detail::column_solver<Law> solver{law};
        for (int c = cells - 1; c >= 0; --c) {  // from the deepest overlap to rupture
          const auto& places = c == 0 ? first_places : gap_places;
          for (std::size_t j = gap_nodes; j-- > (c == 0 ? 0U : 1U);) {
            const double gap =
                gap_of(c + (places[j] + 1) / 2, detail::polynomial(made.rupture, t), made.scale + made.scale_slope * t);
            const auto answer = solver(pair_at(gap), liquid_at(k, t));
            if (!answer.ok()) {
              return refused(answer.reason);
            }
            ++report.solved;
            const double per_radius = answer.value.force / radius1_;
            force[i][static_cast<std::size_t>(c) * (gap_nodes - 1) + j] = per_radius;
            most = per_radius > most ? per_radius : most;
          }
        }
      }
      for (int c = 0; c < cells; ++c) {
        std::array<std::array<double, gap_nodes>, volume_nodes> fitted;
        for (std::size_t i = 0; i < volume_nodes; ++i) {
          std::array<double, gap_nodes> along;
          for (std::size_t j = 0; j < gap_nodes; ++j) {
            along[j] = force[i][static_cast<std::size_t>(c) * (gap_nodes - 1) + j];
          }
          fitted[i] = detail::product(c == 0 ? first_fit : gap_fit, along);
        }
        for (std::size_t j = 0; j < gap_nodes; ++j) {
          std::array<double, volume_nodes> across;
          for (std::size_t i = 0; i < volume_nodes; ++i) {
            across[i] = fitted[i][j];
          }
          const auto powers = detail::product(volume_fit, across);
          for (std::size_t i = 0; i < volume_nodes; ++i) {
            made.force[static_cast<std::size_t>(c)].by[i][j] = powers[i];
          }
        }
      }
    }
    return check(law, rows, cells, most, report);
  }

  /// The rupture gap of the law, in R₁.
  template <tabulable Law>
  [[nodiscard]] bridge_status rupture_at(const Law& law, int k, double t, double& gap) const noexcept {
    const auto limit = law.rupture_gap(pair_at(0), liquid_at(k, t));
    gap = limit.value.gap / radius1_;
    return !limit.ok() ? limit.reason : gap > 0 ? bridge_status::ok : bridge_status::not_covered;
  }

  /// Lowers the rupture gap of a row to that of the law where it is beyond: in a row in which the fold gives way to the
  /// lopsided limit it has a bend that no polynomial follows.
  template <tabulable Law>
  [[nodiscard]] bridge_status keep_within(const Law& law, int k,
                                          const std::array<double, rupture_nodes>& places) noexcept {
    auto& coefficients = row_[static_cast<std::size_t>(k)].rupture;
    double beyond = 0;
    for (const double t : places) {
      double exact = 0;
      const bridge_status found = rupture_at(law, k, t, exact);
      if (found != bridge_status::ok) {
        return found;
      }
      const double off = detail::polynomial(coefficients, t) / exact - 1;
      beyond = off > beyond ? off : beyond;
    }
    for (double& c : coefficients) {
      c *= beyond > 1e-10 ? 1 - 2 * beyond : 1;
    }
    return bridge_status::ok;
  }
  /// Whether a row begins with the rupture gap with which the one before it ends.
  [[nodiscard]] bool joined(int k) const noexcept {
    const double before = detail::polynomial(row_[static_cast<std::size_t>(k - 1)].rupture, 1);
    return detail::size_of(detail::polynomial(row_[static_cast<std::size_t>(k)].rupture, -1) / before - 1) < 1e-12;
  }

  /// Measures the table between its nodes.
  template <tabulable Law>
  [[nodiscard]] table_report check(const Law& law, int rows, int cells, double most, table_report report) noexcept {
    const auto volume_places = detail::middles_of(detail::ends_and_between<volume_nodes>());
    const auto gap_places = detail::middles_of(detail::ends_and_between<gap_nodes>());
    const auto first_places = detail::middles_of(detail::upper_end_and_between<gap_nodes>());
    rows_ = rows;
    top_ = upper_end(rows - 1);
    exchangeable_ = false;
    for (int k = 0; k < rows; ++k) {
      const row& made = row_[static_cast<std::size_t>(k)];
      for (std::size_t i = 2; i + 1 < volume_nodes; ++i) {
        const double t = volume_places[i];
        const auto liquid = liquid_at(k, t);
        const double rupture = detail::polynomial(made.rupture, t);
        const auto limit = law.rupture_gap(pair_at(0), liquid);
        const double off = limit.value.gap / (radius1_ * rupture) - 1;
        if (!limit.ok() || !(off < 1) || !(off > -1)) {
          rows_ = 0;
          top_ = 0;
          return refused(limit.ok() ? bridge_status::not_covered : limit.reason);
        }
        report.rupture_error =
            detail::size_of(off) > report.rupture_error ? detail::size_of(off) : report.rupture_error;
        for (int c = 0; c < cells; ++c) {
          for (std::size_t j = c == 0 ? 0 : 2; j + 1 < gap_nodes; ++j) {
            const double y = c == 0 ? first_places[j] : gap_places[j];
            const auto e = pair_at(gap_of(c + (y + 1) / 2, rupture, made.scale + made.scale_slope * t));
            const auto exact = law.bridge(e, liquid);
            const auto mine = pull(e.radius1, e.radius2, e.gap, liquid.value);
            if (!exact.ok() || !mine.ok()) {
              rows_ = 0;
              top_ = 0;
              return refused(exact.ok() ? mine.reason : exact.reason);
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
    return std::sqrt(std::sqrt(v * unit_) * 0.25 * rupture);
  }

  template <tabulable Law>
  [[nodiscard]] bool same_from_the_other_end(const Law& law) const noexcept {
    const edge<double> e = pair_at(0);
    const given_volume<double> liquid = liquid_at(0, 0.5);
    const auto back = law.bridge(edge<double>{e.radius2, e.radius1, e.gap, e.normal}, liquid);
    const double difference = back.value.force / law.bridge(e, liquid).value.force - 1;
    return !e.with_plane() && back.ok() && difference < 1e-9 && difference > -1e-9;
  }

  double radius1_ = 1;
  double ratio_ = 1;
  double unit_ = 1;  ///< the least volume, in R₁³
  double per_radius1_ = 1;
  double per_unit_ = 1;
  double top_ = 0;    ///< the end of the last row, in the least volume; 0: empty
  double depth_ = 0;  ///< deepest overlap, in R₁
  bool exchangeable_ = false;
  bool graded_ = false;  ///< narrower cells towards rupture, where the bridge goes lopsided just before it folds
  int rows_ = 0;
  std::array<row, static_cast<std::size_t>(row_count)> row_;
};

/// The force of a pair from a table that the caller keeps and has built.
/// \par Units   as the table was built: force [N] for lengths [m]
/// \par Domain  pairs of the table's ratio of radii, at any size; its volumes relative to R³; gaps from its deepest
///              overlap on: not_covered outside. Beyond the rupture gap the answer of the law it was made from
/// \par Source  own; the law that it was made from
template <class Table = bridge_table<>>
struct tabulated {
  const Table* table;

  /// As of the table, in the largest force that it holds.
  static constexpr double stated_accuracy = Table::stated_accuracy;

  template <std::floating_point T>
  [[nodiscard]] outcome<bridge_pull<T>, bridge_status> bridge(const edge<T>& e, given_volume<T> liquid) const noexcept {
    const auto answer = table->pull(static_cast<double>(e.radius1), static_cast<double>(e.radius2),
                                    static_cast<double>(e.gap), static_cast<double>(liquid.value));
    return {{static_cast<T>(answer.value.force)}, answer.reason};
  }
};
static_assert(bridge_law<tabulated<>>);

}  // namespace tetrapore::inline TETRAPORE_ABI
