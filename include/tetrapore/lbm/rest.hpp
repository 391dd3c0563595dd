// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/lbm/coexistence.hpp"
#include "tetrapore/lbm/experiment.hpp"
#include "tetrapore/lbm/measurement.hpp"
#include "tetrapore/lbm/kept_waits.hpp"
#include "tetrapore/lbm/simulation.hpp"

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>

/// \file
/// What experiments with fluids at rest share: two components that repel each other, an interface to start from, and
/// the wait until nothing changes any more.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// When a quantity counts as at rest. \par Domain  window even and at least 2, still > 0
struct rest_options {
  std::uint64_t window = 500;  ///< steps between two looks
  double still = 1e-4;         ///< change of the quantity from look to look, relative to it
  std::uint64_t looks = 2;     ///< in a row that see it still
  std::uint64_t most_steps = 60000;
  kept_waits* kept = nullptr;  ///< where to go on from, and where states are saved
};

/// How the wait ended: `hold_end::stable`, or why not. Experiments that aim at a density or a suction and rest beside
/// it say `hold_end::missed`; what they measured there stands.
struct rest_report {
  double change = 0;  ///< of the quantity in the last window, relative to it
  std::uint64_t steps = 0;
  std::uint64_t updates = 0;  ///< of a fluid node, all components as one
  hold_end end = hold_end::step_limit;
};

/// Runs until `look()`, a number, is still. Where it is no finite number the wait ends as not_finite, where it is 0 as
/// dissolved. Waits that are kept end to the bit as they would have, where `look` is a function of the fluids alone.
/// \throw input_error  a kept state that is damaged or of another wait
template <class Simulation, class Look>
  requires std::convertible_to<std::invoke_result_t<Look&>, double>
rest_report rest(Simulation& s, const rest_options& o, Look look) {
  if (o.window < 2 || o.window % 2 != 0 || !(o.still > 0)) {
    throw parameter_error("rest", "a window of " + std::to_string(o.window) + " steps", "an even number, still > 0");
  }
  struct {
    rest_report report{};
    double before = 0;
    std::uint64_t still = 0;
  } now;
  now.before = look();
  kept_wait kept(o.kept, s, parameter_hash{}.add(o.window).add(o.still).add(o.looks).add(o.most_steps).add(now.before),
                 [&] { s.run(2); });
  if (kept.take_up(now)) {
    look();  // what it shows besides
  }
  rest_report& r = now.report;
  while (r.end == hold_end::step_limit && r.steps < o.most_steps) {
    s.run(o.window);
    r.steps += o.window;
    r.updates += o.window * s.sites().size();
    const double value = look();
    if (!std::isfinite(value) || value == 0) {  // not saved: it comes again, with what the looks before it showed
      r.end = std::isfinite(value) ? hold_end::dissolved : hold_end::not_finite;
      break;
    }
    r.change = std::abs(value - now.before) / std::abs(value);
    now.before = value;
    now.still = r.change < o.still ? now.still + 1 : 0;
    r.end = now.still == o.looks ? hold_end::stable : hold_end::step_limit;
    kept.save(now);
  }
  return r;
}

/// What was waited for, in the form of all experiments: a value at rest, or none.
[[nodiscard]] inline measurement at_rest(double value, const rest_report& r, double discretisation) noexcept {
  const bool rests = r.end == hold_end::stable || r.end == hold_end::missed;
  const double at = rests ? value : quiet_nan<double>;
  const double change = std::abs(at) * r.change;
  return {at, at - change, at + change, discretisation, r.updates, verdict_of(r.end), describe(r.end)};
}

/// Two components with ψ = ρ or another potential that repel each other with the strength G and relax with τ.
template <class Model>
  requires(Model::components == 2)
[[nodiscard]] Model repelling_pair(double attraction, double tau = 1, double reference = 1) {
  Model m;
  m.attraction = {{{0, attraction}, {attraction, 0}}};
  m.reference = {reference, reference};
  for (auto& c : m.collisions) {
    c.tau = tau;
  }
  return m;
}

/// c of `coexistence` where the force is weak: what an experiment starts from.
template <class Model>
[[nodiscard]] double weak_force_factor(const Model& m) noexcept {
  return decltype(m.forcing)::carries_source ? 1 : 1 / (1 - m.collisions[0].rate() / 2);
}

/// Gas where `depth(place)` is positive, liquid where it is negative, a smooth interface between them.
template <class Simulation, class Depth>
void lay_interface(Simulation& s, const reservoir_pair& rho, Depth depth) {
  s.initialise([&](const std::array<int, 3>& p, auto& at, auto&) {
    const double gas = 0.5 * (1 + std::tanh(depth(p) / 1.5));
    for (std::size_t c = 0; c < 2; ++c) {
      at[c] = rho.liquid[c] + (rho.gas[c] - rho.liquid[c]) * gas;
    }
  });
}

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
