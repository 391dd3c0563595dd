// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/law/bridge/young_laplace.hpp"
#include "tetrapore/law/entry/mayer_stowe_princen.hpp"
#include "tetrapore/law/entry/ringed.hpp"
#include "tetrapore/network.hpp"
#include "tetrapore/two_phase.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <string>

/// \file
/// Primary drainage with and without the question whether the rings exist.

namespace ringed_curves {

using namespace tetrapore;

/// Bridges that remember the highest suction of each gap they were asked about: the facets around an edge ask the same.
/// One thread at a time.
struct remembered_bridges {
  young_laplace<> law;
  std::shared_ptr<std::map<std::array<double, 3>, outcome<double, bridge_status>>> known =
      std::make_shared<std::map<std::array<double, 3>, outcome<double, bridge_status>>>();

  [[nodiscard]] auto bridge(const edge<double>& e, const given_suction<double>& p) const noexcept {
    return law.bridge(e, p);
  }
  [[nodiscard]] outcome<double, bridge_status> highest_suction(const edge<double>& e) const noexcept {
    const auto [at, added] = known->try_emplace({e.radius1, e.radius2, e.gap});
    if (added) {
      at->second = law.highest_suction(e);
    }
    return at->second;
  }
};
using with_rings = ringed<mayer_stowe_princen, remembered_bridges>;

inline with_rings law_of_water() { return {{.surface_tension = 1.0}, {.law = {.surface_tension = 1.0}}}; }

struct figures {
  std::size_t limited = 0;  ///< facets of which a gap gives way first
  double half = 0;          ///< p_c at S = 0.5 [unit of σ over length]
  double residual = 0;      ///< liquid at the end
};

template <gap_model Model, class Law>
figures drained(const network& net, const Law& law) {
  facet_rule<Law, Model> rule(net, law);
  figures f;
  f.limited = rule.facets()[entry_status::gap_limited] + rule.facets()[entry_status::no_hole];
  drainage invasion(net, rule);
  invasion.run();
  const retention_curve curve(invasion);
  f.half = curve.pressure_at(0.5).value_or(std::nan(""));
  f.residual = curve.end_saturation();
  return f;
}

/// A row of docs/campaigns/ringed_drainage.json. A curve that starts below S = 0.5, for the gaps of its facets let gas
/// in at no suction at all, has no p_c there: null.
/// \param radius  the unit of length for p_c
inline std::string json_row(const char* name, const figures& f, double radius) {
  const std::string half = f.half > 0 ? std::to_string(f.half * radius) : "null";
  return std::string("  \"") + name + "\": {\"gap_limited\": " + std::to_string(f.limited) + ", \"pc_s50\": " + half +
         ", \"residual\": " + std::to_string(f.residual) + "}";
}

}  // namespace ringed_curves
