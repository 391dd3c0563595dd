// SPDX-License-Identifier: BSD-3-Clause
//
// Campaign: throats at the limits of the lattice, each of which ends with a number or with the name of what is wrong
// (docs/campaigns/throat_diagnoses.json).
#include "support/campaign.hpp"
#include "support/lattice_throats.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace lattice_throats;

namespace {

using fluids = mixture<d3q19, bgk>;
const std::string refused = "refused";

/// A hold at `factor` × the pressure expected: from a fifth below on a meniscus should rest, from a quarter above not.
campaigns::row row_of_hold(const char* what, const entry_set_up& s, double factor) {
  campaigns::row row;
  row.put(what, true).put("tau", s.tau).put("G", s.pair.attraction).put("factor", s.pair.factor);
  row.put("tension", s.pair.surface_tension).put("held", factor);
  try {
    entry_experiment<float, fluids, storage::in_place> e(s);
    const double p = factor * e.lattice_pressure(e.plane().best) / e.correction();
    const hold_report r = e.hold(p);
    row.put("end", describe(r.end)).put("measured", r.measured / p);
  } catch (const setup_error&) {
    row.put("end", refused).put("measured", quiet_nan<double>);
  }
  return row;
}

constexpr double width = 0.03;  // of a bracket

campaigns::row row_of_search(double gap, double inscribed, double factor) {
  const entry_set_up s = equal_spheres(gap, inscribed);
  const double best = plane_entry_of(s.throat, s.sides).best;
  const entry_result r = found(s, 0.7 * factor, 1.3 * factor, width, 1.3);
  campaigns::row row;
  row.put("search", true).put("gap", gap).put("inscribed", inscribed).put("start", factor);
  row.put("end", describe(r.end)).put("last_hold", describe(r.last));
  row.put("lower", r.lower / best).put("upper", r.upper / best).put("value", r.value / best);
  row.put("film", describe(r.film)).put("discretisation", r.discretisation);
  return row.put("holds", r.holds).put("updates", r.updates);
}

std::vector<campaigns::row> all_rows() {
  std::vector<campaigns::row> rows;
  for (const double tau : {0.51, 0.55, 0.6, 0.7, 1.0, 1.5, 2.0}) {
    for (const double strength : {1.1, 1.5, 1.8, 2.4, 3.2}) {  // G ρ over its critical value, halves of it at τ = 1
      entry_set_up s = equal_spheres(0.4, 3);
      s.tau = tau;
      s.pair.factor = 1 / (1 - 1 / (2 * tau));
      s.pair.attraction = 2 * strength / s.pair.factor;
      s.pair.common = (s.pair.factor - 1) / 2;
      rows.push_back(row_of_hold("claimed_pair", s, 0.8));  // the tension of another pair
      if (const auto pair = measure_pair<fluids>(s.pair.attraction, tau); pair.ok()) {
        s.pair = pair.value;
        rows.push_back(row_of_hold("measured_pair", s, 0.8));
        rows.push_back(row_of_hold("measured_pair", s, 1.25));
      }
    }
  }
  for (const double factor : {1.5, 1.7, 1.9, 2.1, 2.3, 2.6}) {  // 1.995 is right
    entry_set_up s = equal_spheres(0.4, 4);
    s.pair.factor = factor;
    rows.push_back(row_of_hold("wrong_reservoirs", s, 0.8));
  }
  for (const double gap : {0.0, 0.4}) {
    for (const double inscribed : {2.5, 3.0}) {
      rows.push_back(row_of_search(gap, inscribed, 1));
    }
    for (const double inscribed : {2.0, 4.0, 6.5}) {
      for (const double factor : {0.7, 1.0, 1.3}) {
        rows.push_back(row_of_search(gap, inscribed, factor));
      }
    }
  }
  return rows;
}

bool ends(const campaigns::row& r, hold_end how) { return r.word("end") == describe(how); }

void check_hold(const campaigns::row& r) {
  const double held = r.number("held");
  const bool below = held < 1;
  const bool of_table = r.number("tau") == 1 && r.number("G") == 1.8;
  CHECK_FALSE(ends(r, below ? hold_end::passed : hold_end::stable));
  if (ends(r, hold_end::stable)) {  // the fluids show what was set
    const entry_set_up s = equal_spheres(0.4, 3);
    CHECK(std::abs(r.number("measured") - 1) <= s.rules.flow + 0.3 / (3.0 * 3.0));
  }
  if (r.has("measured_pair")) {
    CHECK(r.word("end") != refused);
    CHECK((below || ends(r, hold_end::passed) || ends(r, hold_end::dissolved)));
    CHECK((!below || !of_table || ends(r, hold_end::stable)));
  } else {  // the table's own pair alone is what it claims to be
    CHECK((r.word("end") == refused) == !(r.has("claimed_pair") && of_table));
    CHECK(std::isnan(r.number("measured")) == (r.word("end") == refused));
  }
}

void check_search(const campaigns::row& r) {
  const double inscribed = r.number("inscribed");
  const double gap = r.number("gap");
  const double low = r.number("lower");
  const double high = r.number("upper");
  constexpr double digit = 1e-4;
  CHECK(r.word("end") == describe(search_end::converged));
  CHECK(high - low <= width * (low + high) / 2 + digit);
  // Surface Evolver's value over the least plane one, extrapolated to angle 0
  CHECK(std::abs(r.number("value") / (gap > 0 ? 0.994 : 1.0) - 1) <= r.number("discretisation") + width / 2);
  if (inscribed <= 2 || (gap > 0 && inscribed <= 3)) {
    CHECK(r.word("film") == describe(film_status::unresolved));
  }
  if (inscribed >= 4) {
    CHECK(r.word("film") == describe(film_status::resolved));
  }
}

}  // namespace

TEST_CASE("throats at the limits of the lattice end with a number or with a name") {
  const auto rows = campaigns::rows_of("throat_diagnoses", {}, all_rows);
  std::map<std::pair<double, double>, std::vector<campaigns::row>> searches;  // by gap and nodes, from below and above
  std::size_t claimed = 0;
  std::size_t rested = 0;
  std::size_t wrong = 0;
  for (const campaigns::row& r : rows) {
    CAPTURE(r.line());
    if (r.has("search")) {
      check_search(r);
      if (r.number("start") != 1) {
        searches[{r.number("gap"), r.number("inscribed")}].push_back(r);
      }
    } else {
      check_hold(r);
      claimed += r.has("claimed_pair") ? 1U : 0U;
      wrong += r.has("wrong_reservoirs") ? 1U : 0U;
      rested += r.has("measured_pair") && ends(r, hold_end::stable) ? 1U : 0U;
    }
  }
  CHECK(claimed == 35);
  CHECK(wrong == 6);
  CHECK(rested >= 5);  // 7: not every pair is only named
  CHECK(searches.size() == 6);
  for (const auto& [of, both] : searches) {
    REQUIRE(both.size() == 2);
    CAPTURE(of.first);
    CAPTURE(of.second);
    CHECK(both[0].number("lower") <= both[1].number("upper"));
    CHECK(both[1].number("lower") <= both[0].number("upper"));
  }
}
