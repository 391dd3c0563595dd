// SPDX-License-Identifier: BSD-3-Clause
//
// Resistances of a pair against the whole problem of two spheres, or of a sphere and a plane, in Stokes flow. The table
// gives the resistance to any motion of both spheres; a law gives that to their relative motion with the rigid motions
// of the pair left free. So here the rigid motions are eliminated from the table: what is left is the least power at a
// given relative motion.
#include "tetrapore/law/lubrication/leading_order.hpp"
#include "tetrapore/law/lubrication/sphere_plane.hpp"
#include "tetrapore/law/lubrication/two_spheres.hpp"
#include "truth_check/tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace truth_check {
namespace {

using namespace tetrapore;
using number = long double;

/// A pair, and its true resistance; NaN where the table does not say. μ = a1 = 1.
struct resistance_question {
  edge<double> shape;
  double squeeze = 0;
  double shear = std::numeric_limits<double>::quiet_NaN();
  double coupling = std::numeric_limits<double>::quiet_NaN();
  double roll = std::numeric_limits<double>::quiet_NaN();
  double twist = std::numeric_limits<double>::quiet_NaN();
  std::string name;
};

/// The resistance to moving apart, of two bodies that are free to move together.
number in_series(number r11, number r12, number r22) { return (r11 * r22 - r12 * r12) / (r11 + 2 * r12 + r22); }

/// Least power of a quadratic form in (s, ρ, u, Ω) over the last two: shear, coupling, roll.
std::array<number, 3> rest_free(std::array<std::array<number, 4>, 4> n) {
  for (std::size_t gone = 4; gone-- > 2;) {
    for (std::size_t i = 0; i < gone; ++i) {
      for (std::size_t j = 0; j < gone; ++j) {
        n[i][j] -= n[i][gone] * n[gone][j] / n[gone][gone];
      }
    }
  }
  return {n[0][0], n[0][1], n[1][1]};
}

resistance_question two_spheres_of(const csv_table& t, std::size_t i) {
  const auto of = [&](const char* column) { return t.precise(i, column); };
  const number pi = tetrapore::pi<number>;
  const number a = of("lambda");
  const number h = of("h_over_a1");
  const number both = 1 + a;
  resistance_question q;
  q.shape = {1.0, static_cast<double>(a), static_cast<double>(h), {0, 0, 1}};
  q.name = "lambda " + t.text(i, "lambda") + " h " + t.text(i, "h_over_a1");
  q.squeeze = static_cast<double>(in_series(6 * pi * of("XA11"), 3 * pi * both * of("XA12"), 6 * pi * a * of("XA22")));
  q.twist = static_cast<double>(
      in_series(8 * pi * of("XC11"), pi * both * both * both * of("XC12"), 8 * pi * a * a * a * of("XC22")));

  // forces and torques (F1, F2, T1, T2) by (V1, V2, ω1, ω2): sphere 1 at +z, V along x, ω about y
  std::array<std::array<number, 4>, 4> m{};
  const auto set = [&m](std::size_t row, std::size_t column, number x) { m[row][column] = m[column][row] = x; };
  set(0, 0, 6 * pi * of("YA11"));
  set(0, 1, 3 * pi * both * of("YA12"));
  set(1, 1, 6 * pi * a * of("YA22"));
  set(0, 2, 4 * pi * of("YB11"));
  set(1, 2, pi * both * both * of("YB12"));
  set(0, 3, pi * both * both * of("YB21"));
  set(1, 3, 4 * pi * a * a * of("YB22"));
  set(2, 2, 8 * pi * of("YC11"));
  set(2, 3, pi * both * both * both * of("YC12"));
  set(3, 3, 8 * pi * a * a * a * of("YC22"));
  // slip s and roll ρ, and the rigid motions: translation u, rotation Ω about the middle of the gap
  const number arm1 = 1 + h / 2;
  const number arm2 = a + h / 2;
  const std::array<std::array<number, 4>, 4> motion{
      {{0, 1, 0, 0}, {0, -arm2, 0, 1}, {1, 1, 0, 0}, {arm1, -arm2, 1, 1}}};
  std::array<std::array<number, 4>, 4> n{};
  for (std::size_t p = 0; p < 4; ++p) {
    for (std::size_t r = 0; r < 4; ++r) {
      for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t l = 0; l < 4; ++l) {
          n[p][r] += motion[p][k] * m[k][l] * motion[r][l];
        }
      }
    }
  }
  const auto [shear, coupling, roll] = rest_free(n);
  q.shear = static_cast<double>(shear);
  q.coupling = static_cast<double>(coupling);
  q.roll = static_cast<double>(roll);
  return q;
}

/// What a relative error is measured in, by mode (squeeze; shear, coupling, roll; twist): 1, and for the leading order
/// how its error fades as the gap closes.
template <class Law>
std::array<double, 5> error_units(const edge<double>&) {
  return {1, 1, 1, 1, 1};
}
template <>
std::array<double, 5> error_units<leading_order>(const edge<double>& e) {
  const double y = 4 * e.radius1 / (1 + e.radius1 / e.radius2) / e.gap;
  const double logarithm = std::log1p(y);
  const double bounded = 4 / (4 + logarithm);
  return {logarithm / y, bounded, bounded, bounded, bounded};
}

/// A law on the rows that it says it covers. What it leaves out altogether, a resistance of 0, has no error.
template <class Law>
law_report measure_resistance(const std::string& name, const std::vector<resistance_question>& questions) {
  const bool squeeze_alone =
      std::all_of(questions.begin(), questions.end(), [](const resistance_question& q) { return std::isnan(q.shear); });
  const double stated = squeeze_alone ? Law::stated_squeeze_accuracy : Law::stated_accuracy;
  law_report report{name, stated, {}, 0, {}};
  const Law law{.viscosity = 1.0};
  std::vector<edge<double>> right;
  double outside = 0;
  std::array<double, 5> worst{};
  double squeeze_per_unit = 0;
  double others_per_unit = 0;
  for (const auto& q : questions) {
    const auto answer = law.resistance(q.shape);
    if (answer.reason == pair_status::not_covered || answer.reason == pair_status::too_far) {
      ++outside;
      continue;
    }
    row_result row;
    row.name = q.name;
    row.solved = answer.ok();
    row.wrong = !answer.ok();
    if (answer.ok()) {
      const auto& r = answer.value;
      const double side = std::sqrt(q.shear * q.roll);  // what a coupling is measured by: it may be 0
      const std::array<double, 5> errors{r.squeeze / q.squeeze - 1, r.shear / q.shear - 1,
                                         (r.coupling - q.coupling) / side, r.roll / q.roll - 1, r.twist / q.twist - 1};
      const std::array<double, 5> values{r.squeeze, r.shear, side, r.roll, r.twist};
      const std::array<double, 5> units = error_units<Law>(q.shape);
      row.error = 0;
      for (std::size_t k = 0; k < errors.size(); ++k) {
        if (values[k] > 0 && !std::isnan(errors[k])) {
          const double error = std::abs(errors[k]);
          worst[k] = std::max(worst[k], error);
          double& per_unit = k == 0 ? squeeze_per_unit : others_per_unit;
          per_unit = std::max(per_unit, error / units[k]);
          row.error = std::max(*row.error, error);
          const double allowed = units[k] * (k == 0 ? Law::stated_squeeze_accuracy : Law::stated_accuracy);
          row.per_condition = std::max(row.per_condition, error / allowed * stated);
        }
      }
      row.wrong = !(row.per_condition <= stated);
    }
    report.rows.push_back(row);
    if (!row.wrong) {
      right.push_back(q.shape);
    }
  }
  if (!right.empty()) {
    report.nanoseconds = time_of(right.size(), [&](std::size_t i) {
      const auto r = law.resistance(right[i]).value;
      return r.squeeze + r.shear + r.coupling + r.roll + r.twist;
    });
  }
  constexpr std::array<const char*, 5> names{"max_rel_err_squeeze", "max_rel_err_shear", "max_rel_err_coupling",
                                             "max_rel_err_roll", "max_rel_err_twist"};
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (worst[k] > 0) {
      report.more.emplace_back(names[k], worst[k]);
    }
  }
  report.more.emplace_back("squeeze_err_per_unit", squeeze_per_unit);
  report.more.emplace_back("stated_squeeze_accuracy", Law::stated_squeeze_accuracy);
  if (!squeeze_alone) {
    report.more.emplace_back("other_err_per_unit", others_per_unit);
  }
  report.more.emplace_back("outside", outside);
  return report;
}

std::vector<law_report> measure_two_spheres(const csv_table& t) {
  std::vector<resistance_question> all;
  for (std::size_t i = 0; i < t.size(); ++i) {
    all.push_back(two_spheres_of(t, i));
  }
  return {measure_resistance<two_spheres>("two_spheres", all), measure_resistance<leading_order>("leading_order", all)};
}

std::vector<law_report> measure_sphere_plane(const csv_table& t) {
  std::vector<resistance_question> all;
  for (std::size_t i = 0; i < t.size(); ++i) {
    resistance_question q;
    q.shape = {1.0, infinity<double>, t.number(i, "h_over_a"), {0, 0, 1}};
    q.squeeze = static_cast<double>(6 * tetrapore::pi<number> * t.precise(i, "lambda_exact"));
    q.name = "h " + t.text(i, "h_over_a");
    all.push_back(q);
  }
  return {measure_resistance<sphere_plane>("sphere_plane", all),
          measure_resistance<leading_order>("leading_order", all)};
}

/// All motions of a sphere beside a plane at rest. Sliding without turning and turning without sliding, about the
/// sphere's centre, give slip and roll in the middle of the gap.
std::vector<law_report> measure_moving_sphere(const csv_table& t) {
  std::vector<resistance_question> all;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto of = [&](const char* column) { return t.precise(i, column); };
    const number force = 6 * tetrapore::pi<number>;
    const number torque = 8 * tetrapore::pi<number>;
    const number arm = 1 + of("h_over_a") / 2;
    const number shear = force * of("F_slide");
    const number coupling = arm * shear - torque * of("T_slide");
    resistance_question q;
    q.shape = {1.0, infinity<double>, t.number(i, "h_over_a"), {0, 0, 1}};
    q.squeeze = static_cast<double>(force * of("F_normal"));
    q.shear = static_cast<double>(shear);
    q.coupling = static_cast<double>(coupling);
    q.roll = static_cast<double>(torque * of("T_turn") - arm * (arm * shear - 2 * coupling));
    q.twist = static_cast<double>(torque * of("twist"));
    q.name = "h " + t.text(i, "h_over_a");
    all.push_back(q);
  }
  return {measure_resistance<sphere_plane>("sphere_plane", all),
          measure_resistance<leading_order>("leading_order", all)};
}

}  // namespace

std::vector<known_table> lubrication_tables() {
  return {{"open_lubrication: two spheres in Stokes flow",
           [](const csv_table& t) {
             return has_all(t, {"lambda", "h_over_a1", "XA11", "YB21", "YC22", "XC12"});
           },
           measure_two_spheres},
          {"open_sphere_plane_normal: a sphere that approaches a plane",
           [](const csv_table& t) {
             return has_all(t, {"h_over_a", "lambda_exact"});
           },
           measure_sphere_plane},
          {"sphere_plane: a sphere that moves beside a plane",
           [](const csv_table& t) {
             return has_all(t, {"h_over_a", "F_slide", "T_turn", "F_normal"});
           },
           measure_moving_sphere}};
}

}  // namespace truth_check
