// SPDX-License-Identifier: BSD-3-Clause
//
// Bridges against exact ones. A stable row must be answered by itself: force, areas, and the one of volume and suction
// that was not given, to max(stated_accuracy, 16 κ), κ = 2⁻⁵³ Σ |x ∂y/∂x| / |y| over the gap and what was given, from the
// row's own stiffnesses: what the rounding of the request alone does. An unstable row is a trap: its request must get
// the stable bridge of the same request if there is one, else a status, and never the row's own numbers.
#include "tetrapore/law/bridge.hpp"
#include "tetrapore/law/bridge/young_laplace.hpp"
#include "truth_check/tables.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <type_traits>
#include <utility>

namespace truth_check {
namespace {

using namespace tetrapore;

constexpr double rounding = 0x1p-53;

/// What a law states of its own error.
template <class Law>
constexpr double stated_by(double otherwise) {
  if constexpr (requires { Law::stated_accuracy; }) {
    return Law::stated_accuracy;
  } else {
    return otherwise;
  }
}
constexpr double exact_accuracy = stated_by<young_laplace<>>(1e-12);
constexpr double fold_accuracy = 1e-10;

/// What a row asks, and what is true. σ = R1 = 1.
struct bridge_question {
  edge<double> shape;
  double angle1 = 0;
  double angle2 = 0;
  bool by_volume = true;
  double volume = 0;
  double suction = 0;
  double force = 0;
  std::array<double, 3> areas{};      ///< liquid-gas, wetted on 1, wetted on 2
  std::array<double, 5> stiffness{};  ///< dF/dD at V, dF/dD at p, dV/dD at p, dp/dD at V, dV/dp at D
  int stable = 0;                     ///< under the row's control; −1: not determined
  double fold = 0;                    ///< D_rupt; NaN where the table has none
  std::string request;                ///< the text of what is given
  std::string name;                   ///< of the row

  [[nodiscard]] double given() const { return by_volume ? volume : suction; }
};

bridge_question question_of(const csv_table& t, std::size_t i) {
  const double degree = pi<double> / 180;
  bridge_question q;
  q.shape = {1.0, t.number(i, "R2"), t.number(i, "D"), {1, 0, 0}};
  q.angle1 = t.number(i, "theta1_deg") * degree;
  q.angle2 = t.number(i, "theta2_deg") * degree;
  q.by_volume = t.text(i, "control") == "V";
  q.volume = t.number(i, "V");
  q.suction = t.number(i, "pc");
  q.force = t.number(i, "F");
  q.areas = {t.number(i, "A_lg"), t.number(i, "A_s1"), t.number(i, "A_s2")};
  q.stiffness = {t.number(i, "dFdD_V"), t.number(i, "dFdD_p"), t.number(i, "dVdD_p"), t.number(i, "dpcdD_V"),
                 t.number(i, "dVdpc_D")};
  const std::string& stable = t.text(i, q.by_volume ? "stable_V" : "stable_p");
  q.stable = stable.empty() ? 0 : static_cast<int>(std::strtol(stable.c_str(), nullptr, 10));
  q.fold = t.text(i, "D_rupt").empty() ? std::numeric_limits<double>::quiet_NaN() : t.number(i, "D_rupt");
  q.name = "row " + t.text(i, "id") + " (" + t.text(i, "tag") + ")";
  for (const char* column : {"control", "R2", "theta1_deg", "theta2_deg", "D"}) {
    q.request += t.text(i, column) + ' ';
  }
  q.request += t.text(i, q.by_volume ? "V" : "pc");
  return q;
}

/// Calls f with what the row gives.
template <class F>
auto with_given(const bridge_question& q, const F& f) {
  return q.by_volume ? f(given_volume<double>{q.volume}) : f(given_suction<double>{q.suction});
}

/// How far the rounding of the gap and of what is given may move the main results, relatively.
struct bridge_conditions {
  double force;
  double other;  ///< the one of volume and suction that is not given
  double areas;  ///< the table has no slopes of areas: the better conditioned of the other two

  explicit bridge_conditions(const bridge_question& q) {
    const auto& [f_v, f_p, v_p, p_v, v_by_p] = q.stiffness;
    const double gap = q.shape.gap;
    const double by_given = q.by_volume ? -p_v : v_p;  // dF by V, or by p
    const double slope = q.by_volume ? f_v : f_p;
    force = rounding * (std::abs(gap * slope) + std::abs(q.given() * by_given)) / std::abs(q.force);
    other = q.by_volume ? rounding * (std::abs(gap * p_v) + std::abs(q.volume / v_by_p)) / std::abs(q.suction)
                        : rounding * (std::abs(gap * v_p) + std::abs(q.suction * v_by_p)) / std::abs(q.volume);
    areas = std::min(force, other);
  }
};

/// The errors of an answer against a row: relative, and over what conditioning allows. A result that is 0 has no
/// relative error; its absolute one is held against the rounding of the request.
class bridge_errors {
 public:
  void add(double answer, double truth, double condition, double accuracy) {
    const double error = std::abs(answer - truth);
    const double allowed = std::max(accuracy, 16 * condition);
    if (truth != 0) {
      largest = std::max(largest, error / std::abs(truth));
      per_condition = std::max(per_condition, error / std::abs(truth) * accuracy / allowed);
    }
    if (std::isnan(error)) {
      largest = per_condition = std::numeric_limits<double>::infinity();
    }
  }

  double largest = 0;
  double per_condition = 0;  ///< scaled so that `accuracy` is what conditioning allows
};

template <class Law>
bridge_errors errors_of(const Law& law, const bridge_question& q, const meniscus<double>& m) {
  const bridge_conditions kappa(q);
  const auto areas = law.areas(q.shape, m);
  bridge_errors e;
  e.add(m.force, q.force, kappa.force, exact_accuracy);
  e.add(q.by_volume ? m.suction : m.volume, q.by_volume ? q.suction : q.volume, kappa.other, exact_accuracy);
  e.add(areas.liquid_gas, q.areas[0], kappa.areas, exact_accuracy);
  e.add(areas.wetted1, q.areas[1], kappa.areas, exact_accuracy);
  e.add(areas.wetted2, q.areas[2], kappa.areas, exact_accuracy);
  return e;
}

/// The stiffnesses, each against the larger of itself and its kin of the same unit: they may pass through 0.
template <class Law>
double stiffness_error(const Law& law, const bridge_question& q, const meniscus<double>& m) {
  const auto s = law.stiffness(q.shape, m);
  const auto& [f_v, f_p, v_p, p_v, v_by_p] = q.stiffness;
  const double force_scale = std::max(std::abs(f_v), std::abs(f_p));
  const double root = std::sqrt(force_scale * std::abs(v_by_p));  // (dV/dD)² = (dF/dD|p − dF/dD|V) dV/dp
  double worst = 0;
  const auto add = [&](double answer, double truth, double scale) {
    const double error = std::abs(answer - truth) / std::max(std::abs(truth), scale);
    worst = std::isnan(error) ? std::numeric_limits<double>::infinity() : std::max(worst, error);
  };
  add(s.force_by_gap_at_volume, f_v, force_scale);
  add(s.force_by_gap_at_suction, f_p, force_scale);
  add(s.volume_by_gap_at_suction, v_p, root);
  add(s.suction_by_gap_at_volume, p_v, root / std::abs(v_by_p));
  add(s.volume_by_suction, v_by_p, 0);
  return worst;
}

/// What the rounding of the request may do to a stiffness: near the fold it grows as (D_r − D)^(−1/2).
double stiffness_allowed(const bridge_question& q) {
  const double left = std::abs(q.fold - q.shape.gap) / q.fold;
  return 1e-10 + (left < 1 ? 16 * rounding / left : 16 * rounding);
}

/// Whether the answer is the row's own bridge, stable or not.
bool same_bridge(const bridge_question& q, const meniscus<double>& m) {
  return std::abs(m.force - q.force) <= 1e-8 * std::abs(q.force) &&
         std::abs(m.volume - q.volume) <= 1e-8 * std::abs(q.volume) &&
         std::abs(m.suction - q.suction) <= 1e-8 * std::abs(q.suction);
}

/// An equal pair can lean over before its fold.
bool may_lean(const bridge_question& q) {
  return q.shape.radius2 == q.shape.radius1 && q.angle1 == q.angle2;
}

young_laplace<> exact_law(const bridge_question& q) {
  return {.surface_tension = 1.0, .contact_angle1 = q.angle1, .contact_angle2 = q.angle2};
}

/// Mean nanoseconds per request, of all that pass `take`.
template <class Take>
double time_exact(const std::vector<bridge_question>& all, const Take& take) {
  std::vector<bridge_question> taken;
  for (const auto& q : all) {
    if (take(q)) {
      taken.push_back(q);
    }
  }
  return taken.empty() ? 0 : time_of(taken.size(), [&](std::size_t i) {
    const auto& q = taken[i];
    const double force = with_given(q, [&](const auto& g) { return exact_law(q).bridge(q.shape, g).value.force; });
    return force < 1e300 ? force : 0;
  });
}

law_report measure_exact(const std::vector<bridge_question>& questions) {
  using law_type = young_laplace<>;
  law_report report{"young_laplace", exact_accuracy, {}, 0, {}};
  std::map<std::string, const bridge_question*> stable;
  for (const auto& q : questions) {
    if (q.stable == 1) {
      stable[q.request] = &q;
    }
  }
  std::vector<bridge_question> right;
  double traps = 0;
  double slipped = 0;  // traps that got a bridge
  for (const auto& q : questions) {
    const law_type law = exact_law(q);
    const auto answer = with_given(q, [&](const auto& g) { return law.bridge(q.shape, g); });
    const bool answered = answer.ok() || answer.kind() == verdict::absent;
    row_result row;
    row.name = q.name;
    row.solved = answered;
    const auto twin = stable.find(q.request);
    const bridge_question* truth = twin == stable.end() ? nullptr : twin->second;
    if (truth != nullptr) {
      row.wrong = !answer.ok();
      if (answer.ok()) {
        const bridge_errors e = errors_of(law, *truth, answer.value);
        const double slope = stiffness_error(law, *truth, answer.value);
        row.error = e.largest;
        row.per_condition = e.per_condition;
        row.derivative_error = slope;
        row.wrong = !(e.per_condition <= exact_accuracy) || !(slope <= stiffness_allowed(*truth));
      }
    } else if (q.stable == 0) {
      ++traps;
      slipped += answer.ok() ? 1 : 0;
      // Short of the fold there is a stable bridge, unless the pair is equal and it leans over first.
      const bool must_be = q.shape.gap < q.fold && !may_lean(q);
      row.wrong = answer.ok() ? same_bridge(q, answer.value) : (must_be || answer.kind() != verdict::absent);
    } else {
      row.wrong = !answered;
    }
    report.rows.push_back(row);
    if (!row.wrong) {
      right.push_back(q);
    }
  }
  report.nanoseconds = time_exact(right, [](const bridge_question&) { return true; });
  const auto stable_one = [](bool by_volume) {
    return [by_volume](const bridge_question& q) { return q.stable == 1 && q.by_volume == by_volume; };
  };
  report.more = {{"ns_volume", time_exact(right, stable_one(true))},
                 {"ns_suction", time_exact(right, stable_one(false))},
                 {"unstable_rows", traps},
                 {"unstable_rows_answered_by_another_bridge", slipped}};
  return report;
}

/// A law of given volume that knows the force alone, on the stable rows that it says it covers.
template <class Law, class Make>
law_report measure_closed_form(const std::string& name, const std::vector<bridge_question>& questions,
                               const Make& make) {
  constexpr double accuracy = stated_by<Law>(std::numeric_limits<double>::infinity());
  law_report report{name, accuracy, {}, 0, {}};
  std::vector<bridge_question> right;
  double outside = 0;
  for (const auto& q : questions) {
    const std::optional<Law> law = make(q);
    if (!q.by_volume || q.stable != 1 || !law) {
      continue;
    }
    const auto answer = law->bridge(q.shape, given_volume<double>{q.volume});
    if (answer.reason == bridge_status::not_covered) {
      ++outside;
      continue;
    }
    row_result row;
    row.name = q.name;
    row.solved = answer.ok() || answer.kind() == verdict::absent;
    row.wrong = !answer.ok();
    if (answer.ok()) {
      row.error = std::abs(answer.value.force / q.force - 1);
      row.per_condition = *row.error;
      row.wrong = !(*row.error <= accuracy);
    }
    report.rows.push_back(row);
    if (!row.wrong) {
      right.push_back(q);
    }
  }
  if (!right.empty()) {
    report.nanoseconds = time_of(right.size(), [&](std::size_t i) {
      return make(right[i])->bridge(right[i].shape, given_volume<double>{right[i].volume}).value.force;
    });
  }
  report.more = {{"outside", outside}};
  return report;
}

std::vector<bridge_question> questions_of(const csv_table& t) {
  std::vector<bridge_question> all;
  for (std::size_t i = 0; i < t.size(); ++i) {
    all.push_back(question_of(t, i));
  }
  return all;
}

std::vector<law_report> measure_bridges(const csv_table& t) {
  return {measure_exact(questions_of(t))};
}

/// Where a bridge must end.
struct rupture_question {
  bridge_question pair;  ///< its gap does not matter
  double fold = 0;
  std::optional<double> lopsided;  ///< the gap where symmetry is lost first
  bool determined = true;          ///< whether the table knows which comes first
};

/// Whether a bridge hangs just before a gap and none just beyond it. Near the fold F changes as the root of the distance:
/// what is just before must be farther from it than rounding.
bool ends_at(const bridge_question& q, double gap) {
  const auto bridge_at = [&](double factor) {
    edge<double> e = q.shape;
    e.gap = gap * factor;
    return with_given(q, [&](const auto& g) { return exact_law(q).bridge(e, g); });
  };
  return bridge_at(1 - 1e-6).ok() && bridge_at(1 + 1e-9).kind() == verdict::absent;
}

std::vector<law_report> measure_ruptures(const std::vector<rupture_question>& questions) {
  law_report report{"young_laplace", fold_accuracy, {}, 0, {}};
  double leaning = 0;
  const auto limit_of = [](const rupture_question& r) {
    return with_given(r.pair, [&](const auto& g) { return exact_law(r.pair).rupture_gap(r.pair.shape, g); });
  };
  for (const rupture_question& r : questions) {
    const bridge_question& q = r.pair;
    const auto limit = limit_of(r);
    const double gap = limit.value.gap;
    row_result row;
    row.name = q.name;
    row.solved = limit.ok();
    row.wrong = !limit.ok() || !ends_at(q, gap);
    if (limit.ok()) {
      const bool leans = limit.value.end == bridge_end::lopsided;
      leaning += leans ? 1 : 0;
      if (r.determined) {
        row.wrong = row.wrong || leans != r.lopsided.has_value();
        row.error = std::abs(gap / r.lopsided.value_or(r.fold) - 1);
      } else if (leans) {
        row.wrong = row.wrong || !(gap < r.fold);
      } else {
        row.error = std::abs(gap / r.fold - 1);
      }
      row.per_condition = row.error.value_or(0);
      row.wrong = row.wrong || !(row.per_condition <= fold_accuracy);
    }
    report.rows.push_back(row);
  }
  report.nanoseconds = time_of(questions.size(), [&](std::size_t i) {
    const double gap = limit_of(questions[i]).value.gap;
    return gap < 1e300 ? gap : 0;
  });
  report.more = {{"lopsided", leaning}};
  return {report};
}

/// Folds of all pairs. An equal pair may lean over before: which, the other table says.
std::vector<law_report> measure_folds(const csv_table& t) {
  std::vector<rupture_question> all;
  for (const bridge_question& q : questions_of(t)) {
    all.push_back({q, q.shape.gap, std::nullopt, !may_lean(q)});
  }
  return measure_ruptures(all);
}

/// Equal pairs under given volume. Blank: the fold comes first; from 75° on: not found.
std::vector<law_report> measure_lopsided(const csv_table& t) {
  std::vector<rupture_question> all;
  for (std::size_t i = 0; i < t.size(); ++i) {
    bridge_question q;
    q.shape = {1.0, 1.0, 0.0, {1, 0, 0}};
    q.angle1 = q.angle2 = t.number(i, "theta_deg") * pi<double> / 180;
    q.volume = t.number(i, "V");
    q.name = "theta " + t.text(i, "theta_deg") + " V " + t.text(i, "V").substr(0, 8);
    const bool blank = t.text(i, "D_asym").empty();
    all.push_back({q, t.number(i, "D_fold"), blank ? std::nullopt : std::optional(t.number(i, "D_asym")),
                   !blank || t.number(i, "theta_deg") < 75});
  }
  return measure_ruptures(all);
}

}  // namespace

std::vector<known_table> bridge_tables() {
  const auto is_bridges = [](const csv_table& t) {
    return has_all(t, {"tag", "control", "R2", "theta1_deg", "D", "V", "pc", "F", "dFdD_V", "stable_V"}) && t.size() > 0;
  };
  return {{"open_bridge: exact bridges",
           [=](const csv_table& t) { return is_bridges(t) && t.text(0, "tag") != "rupture"; }, measure_bridges},
          {"rupture_open: folds", [=](const csv_table& t) { return is_bridges(t) && t.text(0, "tag") == "rupture"; },
           measure_folds},
          {"rupture_asym_open: where equal pairs lean over",
           [](const csv_table& t) {
             return has_all(t, {"theta_deg", "V", "D_fold", "D_asym"});
           },
           measure_lopsided}};
}

}  // namespace truth_check
