// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/error.hpp"
#include "tetrapore/core/outcome.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <utility>

/// \file
/// Experiments that look for a threshold: hold a value, wait, decide on which side of the threshold it lies, halve the
/// bracket.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// How a hold ended.
enum class hold_end : std::uint8_t {
  stable,      ///< nothing moves any more: the value lies below the threshold
  passed,      ///< the fluid went through: it lies above
  not_finite,  ///< a density is not a number
  dissolved,   ///< a phase is gone, or no densities belong to the value
  drifting,    ///< the interface stands, but mass goes on moving
  step_limit   ///< the interface still moves after the most steps that are allowed
};

[[nodiscard]] constexpr verdict verdict_of(hold_end e) noexcept {
  return e == hold_end::stable || e == hold_end::passed ? verdict::ok : verdict::failed;
}
[[nodiscard]] constexpr const char* describe(hold_end e) noexcept {
  switch (e) {
    case hold_end::stable: return "stable";
    case hold_end::passed: return "the fluid went through";
    case hold_end::not_finite: return "a density is not a number";
    case hold_end::dissolved: return "a phase dissolved";
    case hold_end::drifting: return "the interface stands, but mass drifts";
    case hold_end::step_limit: return "the interface still moves after the most steps allowed";
  }
  return "not an end of a hold";
}

/// What a hold found.
struct hold_report {
  double value = 0;     ///< that was set
  double measured = 0;  ///< what the fluids show of it
  double position = 0;  ///< of the interface
  std::uint64_t steps = 0;
  std::uint64_t updates = 0;  ///< of a fluid node, all components as one
  hold_end end = hold_end::stable;
};

/// Why a search ended.
enum class search_end : std::uint8_t {
  running,      ///< not yet
  converged,    ///< the bracket is as narrow as asked
  unbracketed,  ///< refused: widened as often as allowed, the threshold is not inside
  undecided     ///< failed: a hold gave no answer; its end says why
};

[[nodiscard]] constexpr verdict verdict_of(search_end e) noexcept {
  switch (e) {
    case search_end::converged: return verdict::ok;
    case search_end::unbracketed: return verdict::refused;
    case search_end::running:
    case search_end::undecided: break;
  }
  return verdict::failed;
}
[[nodiscard]] constexpr const char* describe(search_end e) noexcept {
  switch (e) {
    case search_end::running: return "the search has not ended";
    case search_end::converged: return "the bracket is as narrow as asked";
    case search_end::unbracketed: return "the threshold lies outside the widest bracket allowed";
    case search_end::undecided: return "a hold gave no answer";
  }
  return "not an end of a search";
}

/// How a threshold is searched. \par Domain  0 < lower < upper, widen > 1, width > 0
struct search_options {
  double lower = 0.7;
  double upper = 1.3;
  double width = 0.03;  ///< of the last bracket, relative to its middle
  double widen = 1.3;   ///< factor by which an end moves on that turned out to lie on the other side
  std::uint32_t most_widenings = 8;
};

/// Bisection from a bracket that need not hold the threshold: an end that turns out to lie on the other side becomes
/// the other end, and a new one is sought beyond. Values go up wherever they can: the first is the lower end. A hold
/// that ends while the fluid still creeps was close to the threshold: values half a width above and below decide.
class threshold_search {
 public:
  /// Everything that a search remembers. Plain numbers, to be saved as they are.
  struct memory {
    double lower = 0;
    double upper = 0;
    double measured_lower = 0;  ///< what the last stable hold showed
    double position_lower = 0;
    double creeping = 0;  ///< a value at which the fluid still moved at the last step allowed; 0: none
    std::uint64_t steps = 0;
    std::uint64_t updates = 0;
    std::uint32_t holds = 0;
    std::uint32_t widenings = 0;
    std::uint8_t lower_known = 0;
    std::uint8_t upper_known = 0;
    hold_end last = hold_end::stable;
    search_end end = search_end::running;
  };

  explicit threshold_search(const search_options& o) : options_(o) {
    if (!(o.lower > 0) || !(o.upper > o.lower) || !(o.upper < 1e300)) {
      throw parameter_error("bracket", short_number(o.lower) + " to " + short_number(o.upper), "0 < lower < upper");
    }
    if (!(o.width > 0) || !(o.widen > 1)) {
      throw parameter_error("search", "width " + short_number(o.width) + ", widen " + short_number(o.widen),
                            "width > 0, widen > 1");
    }
    memory_.lower = o.lower;
    memory_.upper = o.upper;
  }
  threshold_search(const search_options& o, const memory& m) : threshold_search(o) { memory_ = m; }

  [[nodiscard]] const memory& now() const noexcept { return memory_; }
  [[nodiscard]] bool running() const noexcept { return memory_.end == search_end::running; }
  [[nodiscard]] double value() const noexcept { return (memory_.lower + memory_.upper) / 2; }

  /// The value to hold next.
  [[nodiscard]] double next() const noexcept {
    if (memory_.creeping > 0) {
      const double above = memory_.creeping * (1 + options_.width / 2);
      return memory_.upper_known == 0 || memory_.upper > above ? above : memory_.creeping * (1 - options_.width / 2);
    }
    return memory_.lower_known == 0 ? memory_.lower : memory_.upper_known == 0 ? memory_.upper : value();
  }

  /// Takes in what the hold at `next()` found.
  void take(const hold_report& r) noexcept {
    const double held = next();
    memory_.steps += r.steps;
    memory_.updates += r.updates;
    ++memory_.holds;
    memory_.last = r.end;
    if (r.end == hold_end::stable) {
      memory_.lower = held;
      memory_.lower_known = 1;
      memory_.measured_lower = r.measured;
      memory_.position_lower = r.position;
      if (!(memory_.upper > held)) {
        widen(memory_.upper, held * options_.widen);
      }
    } else if (r.end == hold_end::passed) {
      memory_.upper = held;
      memory_.upper_known = 1;
      if (memory_.lower_known == 0) {
        widen(memory_.lower, held / options_.widen);
      }
    } else if (r.end == hold_end::step_limit && memory_.creeping == 0) {
      memory_.creeping = held;
      return;
    } else {
      memory_.end = search_end::undecided;
    }
    const bool outside = memory_.lower_known != 0 && memory_.lower >= memory_.creeping;
    memory_.creeping = outside || memory_.upper <= memory_.creeping ? 0 : memory_.creeping;
    if (running() && memory_.lower_known != 0 && memory_.upper_known != 0 &&
        memory_.upper - memory_.lower <= options_.width * value() * (1 + 1e-12)) {
      memory_.end = search_end::converged;
    }
  }

 private:
  void widen(double& end, double to) noexcept {
    if (memory_.widenings == options_.most_widenings) {
      memory_.end = search_end::unbracketed;
      return;
    }
    ++memory_.widenings;
    end = to;
  }

  search_options options_;
  memory memory_;
};

/// An experiment in which a value is held until the fluids stand still or have passed.
/// Syntax: `e.hold(value)` gives a hold_report; `e.keep()` makes the present state the one that holds start from;
/// `e.back()` returns to it.
/// Semantics: a hold is a function of the kept state and the value alone.
/// Models: entry_experiment; a user's own.
template <class E>
concept held_experiment = requires(E e, double value) {
  { e.hold(value) } -> std::same_as<hold_report>;
  e.keep();
  e.back();
};

/// Runs a search to its end; `after(report)` is called behind each hold, when everything may be saved.
template <held_experiment E, class After>
  requires std::invocable<After&, const hold_report&>
void run(E& experiment, threshold_search& search, After after) {
  while (search.running()) {
    const hold_report r = experiment.hold(search.next());
    if (r.end == hold_end::stable) {
      experiment.keep();
    } else {
      experiment.back();
    }
    search.take(r);
    after(r);
  }
}
template <held_experiment E>
void run(E& experiment, threshold_search& search) {
  run(experiment, search, [](const hold_report&) {});
}

}  // namespace lbm
}  // namespace tetrapore::inline TETRAPORE_ABI
