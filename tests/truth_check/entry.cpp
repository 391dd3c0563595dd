// SPDX-License-Identifier: BSD-3-Clause
#include "support/condition.hpp"
#include "support/openings.hpp"
#include "tetrapore/law/entry.hpp"
#include "truth_check/tables.hpp"

#include <cstdlib>

namespace truth_check {
namespace {

using namespace tetrapore;

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
  law_report report{name, Law::stated_accuracy, {}, 0, {}};
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

}  // namespace

std::vector<known_table> entry_tables() {
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

}  // namespace truth_check
