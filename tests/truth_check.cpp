// SPDX-License-Identifier: BSD-3-Clause
//
// truth_check TABLE.csv: measures every law that the table's columns name and prints one line per law.
//   rows     rows of the table that ask the law for something inside its domain
//   solved   an answer: a value, or that the opening is closed
//   refused  the law refused, failed or gave no value
//   wrong    status differs from the table, a refusal inside the law's stated domain, or an error above
//            stated_accuracy · condition (support/condition.hpp) beyond the printed digits of the table
//   max_rel_err, p99_rel_err     relative error of the main results, as it stands
//   max_rel_err_per_condition    what stated_accuracy promises: the error beyond the table's digits over the condition
//   table_digits                 relative half unit of the table's last digit, the worst of the rows; only where the
//                                digits and not the law limit what can be seen
//   ns_per_call                  over the rows that are not wrong
// Exit: 0 when nothing is wrong, 1 when something is, 2 when the table is not known.
#include "support/condition.hpp"
#include "support/csv_table.hpp"
#include "support/openings.hpp"
#include "tetrapore/law/entry.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace tetrapore;

/// What one row says about one law.
struct row_result {
  bool solved = false;
  bool wrong = false;
  std::optional<double> error;             ///< relative, of the main results, where the table has a value
  double per_condition = 0;                ///< that error beyond the table's digits, over the condition
  double digits = 0;                       ///< relative half unit of the table's last digit; 0: finer than a double
  std::optional<double> derivative_error;  ///< relative, of the derivatives, where they are measured
};

struct law_report {
  std::string law;
  double stated_accuracy = 0;
  std::vector<row_result> rows;
  double nanoseconds = 0;
};

double percentile_99(std::vector<double> x) {
  if (x.empty()) {
    return 0;
  }
  std::sort(x.begin(), x.end());
  const auto rank = (99 * x.size() + 99) / 100;
  return x[rank - 1];
}

/// Prints the line of a law; returns how many rows are wrong.
std::size_t print(const law_report& r) {
  std::size_t solved = 0;
  std::size_t wrong = 0;
  double per_condition = 0;
  double digits = 0;
  std::vector<double> errors;
  std::vector<double> slopes;
  for (const auto& row : r.rows) {
    solved += row.solved ? 1U : 0U;
    wrong += row.wrong ? 1U : 0U;
    per_condition = std::max(per_condition, row.per_condition);
    digits = std::max(digits, row.digits);
    if (row.error) {
      errors.push_back(*row.error);
    }
    if (row.derivative_error) {
      slopes.push_back(*row.derivative_error);
    }
  }
  const double worst = errors.empty() ? 0 : *std::max_element(errors.begin(), errors.end());
  std::printf(
      "law=%s rows=%zu solved=%zu refused=%zu wrong=%zu max_rel_err=%.3g p99_rel_err=%.3g ns_per_call=%.1f "
      "max_rel_err_per_condition=%.3g stated_accuracy=%.3g",
      r.law.c_str(), r.rows.size(), solved, r.rows.size() - solved, wrong, worst, percentile_99(errors), r.nanoseconds,
      per_condition, r.stated_accuracy);
  if (digits > 0) {
    std::printf(" table_digits=%.3g", digits);
  }
  if (!slopes.empty()) {
    std::printf(" max_rel_err_derivative=%.3g", *std::max_element(slopes.begin(), slopes.end()));
  }
  std::printf("\n");
  return wrong;
}

/// Nanoseconds of call(i) for i < n, the best of several passes.
template <class Call>
double time_of(std::size_t n, const Call& call) {
  double best = 1e300;
  for (int pass = 0; pass < 25; ++pass) {
    const auto start = std::chrono::steady_clock::now();
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      sum += call(i);
    }
    const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - start;
    volatile double keep = sum;
    static_cast<void>(keep);
    best = std::min(best, spent.count() / static_cast<double>(n));
  }
  return best;
}

/// One question to an entry law: an opening inside its domain, an angle, and what the table says.
struct entry_question {
  opening<double> shape;
  double contact_angle = 0;
  std::string status;
  double curvature = 0;
  double digits = 0;  ///< relative half unit of the curvature's last digit, where a double holds more
};

/// dp/dx of the law against a central difference of its long double value, for one coordinate of one side.
template <class Law>
std::optional<double> derivative_error(const Law& law, const opening<double>& shape) {
  const auto slopes = law.derivative(shape);
  if (!slopes.ok()) {
    return std::nullopt;
  }
  double size = 0;
  double worst = 0;
  for (std::size_t k = 0; k < shape.count; ++k) {
    if (shape.sides[k].kind != side_kind::disc) {
      continue;
    }
    const double computed[3] = {slopes.value.by_centre[k].x, slopes.value.by_centre[k].y, slopes.value.by_radius[k]};
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = [&](long double step) {
        auto o = openings::as<long double>(shape);
        auto& s = o.sides[k];
        (axis == 0 ? s.point.x : axis == 1 ? s.point.y : s.radius) += step;
        return law.entry_pressure(o);
      };
      const long double h =
          1e-6L * static_cast<long double>(law.surface_tension.get()) / static_cast<long double>(slopes.value.pressure);
      const auto a = at(h);
      const auto b = at(-h);
      const auto a2 = at(2 * h);
      const auto b2 = at(-2 * h);
      if (!a.ok() || !b.ok() || !a2.ok() || !b2.ok()) {
        return std::nullopt;
      }
      const auto slope = static_cast<double>((8 * (a.value - b.value) - (a2.value - b2.value)) / (12 * h));
      worst = std::max(worst, std::abs(slope - computed[axis]));
      size = std::max(size, std::abs(slope));
    }
  }
  // Touching sides of an open gap have no derivative; lines have no coordinates here.
  return std::isfinite(worst) && size > 0 ? std::optional(worst / size) : std::nullopt;
}

template <class Law>
law_report measure_entry(const std::string& name, const std::vector<entry_question>& questions) {
  law_report report{name, Law::stated_accuracy, {}, 0};
  std::vector<entry_question> right;
  for (const auto& q : questions) {
    const Law law{.surface_tension = 1.0, .contact_angle = q.contact_angle};
    const auto answer = law.entry_pressure(q.shape);
    const bool has_value = q.status == "ok" || q.status == "dry_corner";
    row_result row;
    row.solved = answer.kind() == verdict::ok || answer.kind() == verdict::absent;
    row.wrong = openings::name_of(answer.reason) != q.status;
    if (has_value && answer.ok()) {
      row.digits = q.digits;
      row.error = std::abs(answer.value / q.curvature - 1);
      const double beyond = *row.error - q.digits;
      row.per_condition = beyond > 0 ? beyond / openings::condition(law, q.shape) : 0;
      row.wrong = row.wrong || !(row.per_condition <= Law::stated_accuracy);
      if constexpr (requires { law.derivative(q.shape); }) {
        row.derivative_error = derivative_error(law, q.shape);
      }
    }
    report.rows.push_back(row);
    if (!row.wrong) {
      right.push_back(q);
    }
  }
  if (!right.empty()) {
    report.nanoseconds = time_of(right.size(), [&](std::size_t i) {
      const auto& q = right[i];
      const double p = Law{.surface_tension = 1.0, .contact_angle = q.contact_angle}.entry_pressure(q.shape).value;
      return p < 1e300 ? p : 0;
    });
  }
  return report;
}

/// A named table of truth: how it is recognised, and what it measures.
struct known_table {
  std::string name;
  std::function<bool(const csv_table&)> recognise;
  std::function<std::vector<law_report>(const csv_table&)> measure;
};

bool has_all(const csv_table& t, std::initializer_list<const char*> columns) {
  return std::all_of(columns.begin(), columns.end(), [&](const char* c) { return t.has(c); });
}

/// Throats of three circles: the status, C_msp, and the inscribed circle.
std::vector<law_report> measure_throats(const csv_table& t) {
  std::vector<entry_question> msp;
  std::vector<entry_question> inscribed;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto o = openings::from_row(t, i);
    const double angle = openings::degrees(t.number(i, "theta_deg"));
    msp.push_back({o.value, angle, t.text(i, "status"), t.number(i, "C_msp")});
    const double r = t.number(i, "r_ins");
    inscribed.push_back({o.value, angle, r > 0 ? "ok" : (r < 0 ? "closed" : "no_hole"), 2 * std::cos(angle) / r});
  }
  return {measure_entry<mayer_stowe_princen>("mayer_stowe_princen", msp),
          measure_entry<inscribed_circle>("inscribed_circle", inscribed)};
}

/// The opening of a name of closed_forms.csv; nothing for a shape that has no 3 to 8 sides.
std::optional<opening<double>> named_shape(const std::string& name) {
  const auto begins = [&](const char* with) { return name.rfind(with, 0) == 0; };
  const auto value = [](const auto& made) -> std::optional<opening<double>> {
    return made.ok() ? std::optional(made.value) : std::nullopt;
  };
  if (begins("regular_")) {
    return value(regular_polygon(static_cast<std::size_t>(std::atoi(name.c_str() + 8)), 1.0));
  }
  if (begins("2_touching_rods_on_plate")) {
    return value(two_discs_on_plate(1.0, 0.0));
  }
  if (begins("3_rods_equal_gap_")) {
    return value(ring_of_discs(3, 1.0, std::atof(name.c_str() + 17)));
  }
  if (name.find("_touching_rods") != std::string::npos) {
    return value(ring_of_discs(static_cast<std::size_t>(std::atoi(name.c_str())), 1.0, 0.0));
  }
  return std::nullopt;
}

std::vector<law_report> measure_closed_forms(const csv_table& t) {
  std::vector<entry_question> msp;
  std::vector<entry_question> inscribed;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto o = named_shape(t.text(i, "shape"));
    const double angle = openings::degrees(t.number(i, "theta_deg"));
    if (!o) {
      continue;
    }
    const bool dry = t.text(i, "note").rfind("dry corners", 0) == 0;
    const bool has_value = t.text(i, "C_msp") != "nan";
    msp.push_back({*o, angle, dry ? "dry_corner" : (has_value ? "ok" : "gap_limited"), t.number(i, "C_msp")});
    if (o->count == 3) {
      // The column is 2 cos θ / r for polygons, 2 / r for rods.
      const double factor = t.text(i, "shape").rfind("regular", 0) == 0 ? 1.0 : std::cos(angle);
      inscribed.push_back({*o, angle, "ok", factor * t.number(i, "C_inscribed_2_over_r")});
    }
  }
  return {measure_entry<mayer_stowe_princen>("mayer_stowe_princen", msp),
          measure_entry<inscribed_circle>("inscribed_circle", inscribed)};
}

/// The two plane branches beside the three-dimensional menisci; the table has 5 to 7 digits.
std::vector<law_report> measure_mirror_sides(const csv_table& t) {
  std::vector<entry_question> arcs;
  std::vector<entry_question> open;
  const auto half_unit = [&](std::size_t i, const char* column) {
    const std::string& digits = t.text(i, column);
    const auto decimals = static_cast<double>(digits.size() - digits.find('.') - 1);
    return 0.5 * std::pow(10.0, -decimals) / t.number(i, column);
  };
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double gap = t.number(i, "gap_over_R");
    const double angle = openings::degrees(t.number(i, "theta_deg"));
    arcs.push_back({ring_of_discs(3, 1.0, gap).value, angle, "ok", t.number(i, "C_msp_2D"), half_unit(i, "C_msp_2D")});
    open.push_back({ring_of_discs(3, 1.0, gap, gap_state::open).value, angle, "ok", t.number(i, "C_open_2D"),
                    half_unit(i, "C_open_2D")});
  }
  return {measure_entry<mayer_stowe_princen>("mayer_stowe_princen", arcs),
          measure_entry<mayer_stowe_princen>("mayer_stowe_princen_open_gaps", open)};
}

/// Needles and dry corners: three circles given by distances.
std::vector<law_report> measure_hard_throats(const csv_table& t) {
  std::vector<entry_question> msp;
  for (std::size_t i = 0; i < t.size(); ++i) {
    msp.push_back({openings::from_row(t, i).value, openings::degrees(t.number(i, "theta_deg")),
                   t.text(i, "category") == "sliver" ? "ok" : "dry_corner", t.number(i, "C")});
  }
  return {measure_entry<mayer_stowe_princen>("mayer_stowe_princen", msp)};
}

/// Rings of discs and lines given by their coordinates.
std::vector<law_report> measure_rings(const csv_table& t) {
  std::vector<entry_question> msp;
  for (std::size_t i = 0; i < t.size(); ++i) {
    msp.push_back({openings::from_sides(t.text(i, "sides")), openings::degrees(t.number(i, "theta_deg")), "ok",
                   t.number(i, "C")});
  }
  return {measure_entry<mayer_stowe_princen>("mayer_stowe_princen", msp)};
}

std::vector<known_table> known_tables() {
  return {
      {"open_msp: throats of three circles",
       [](const csv_table& t) {
         return has_all(t, {"R1", "R2", "R3", "d12", "d13", "d23", "status", "C_msp", "r_ins"});
       },
       measure_throats},
      {"closed_forms: named shapes",
       [](const csv_table& t) {
         return has_all(t, {"shape", "scale", "theta_deg", "C_msp", "C_inscribed_2_over_r"});
       },
       measure_closed_forms},
      {"se_results: three spheres with mirror sides",
       [](const csv_table& t) {
         return has_all(t, {"theta_deg", "gap_over_R", "C_msp_2D", "C_open_2D"});
       },
       measure_mirror_sides},
      {"entry_hard: needles and dry corners",
       [](const csv_table& t) {
         return has_all(t, {"category", "R1", "R2", "R3", "d12", "d13", "d23", "theta_deg", "C", "A_nw"});
       },
       measure_hard_throats},
      {"entry_rings: rings of discs and lines",
       [](const csv_table& t) {
         return has_all(t, {"category", "theta_deg", "C", "sides"});
       },
       measure_rings},
  };
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: truth_check TABLE.csv\n");
    return 2;
  }
  try {
    const csv_table table(arguments[1]);
    for (const auto& known : known_tables()) {
      if (known.recognise(table)) {
        std::size_t wrong = 0;
        for (const auto& report : known.measure(table)) {
          wrong += print(report);
        }
        return wrong == 0 ? 0 : 1;
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "truth_check: %s\n", error.what());
    return 2;
  }
  std::fprintf(stderr, "truth_check: %s is not a table that any law here knows; known are\n", arguments[1]);
  for (const auto& known : known_tables()) {
    std::fprintf(stderr, "  %s\n", known.name.c_str());
  }
  return 2;
}
