// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/core/error.hpp"
#include "tetrapore/core/outcome.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

/// \file
/// Experiments that look for a threshold: hold a value, wait, decide on which side of the threshold it lies, halve the
/// bracket.

namespace tetrapore::inline TETRAPORE_ABI {
namespace lbm {

/// How a hold ended.
enum class hold_end : std::uint8_t {
  stable,      ///< nothing moves any more, or less and less: the value lies below the threshold
  passed,      ///< the fluid went through, or goes faster and faster: it lies above
  not_finite,  ///< a density is not a number
  dissolved,   ///< a phase is gone, or no densities belong to the value
  drifting,    ///< the interface stands, but mass goes on moving
  step_limit,  ///< the interface still moves after the most steps that are allowed
  flowing,     ///< the fluids show another value than was set: something flows through the interface
  missed       ///< at rest, but not at the density or suction that was asked for, however often it was laid again
};

[[nodiscard]] constexpr bool lies_below(hold_end e) noexcept { return e == hold_end::stable; }
[[nodiscard]] constexpr verdict verdict_of(hold_end e) noexcept {
  return lies_below(e) || e == hold_end::passed ? verdict::ok : verdict::failed;
}
[[nodiscard]] constexpr const char* describe(hold_end e) noexcept {
  switch (e) {
    case hold_end::stable: return "stable";
    case hold_end::passed: return "the fluid went through";
    case hold_end::not_finite: return "a density is not a number";
    case hold_end::dissolved: return "a phase dissolved";
    case hold_end::drifting: return "the interface stands, but mass drifts";
    case hold_end::step_limit: return "the interface still moves after the most steps allowed";
    case hold_end::flowing: return "the fluids show another value than was set";
    case hold_end::missed: return "at rest, but not at the density or suction asked for";
  }
  return "not an end of a hold";
}

/// What a hold found.
struct hold_report {
  double value = 0;                     ///< that was set
  double measured = quiet_nan<double>;  ///< what the fluids show of it; NaN where nothing was measured
  double position = 0;                  ///< of the interface
  double film = 1;  ///< share of the liquid that is left beside wetting walls: a tenth of the nodes there has less
  std::uint64_t steps = 0;
  std::uint64_t updates = 0;  ///< of a fluid node, all components as one
  hold_end end = hold_end::stable;
};

/// How a hold ended that its interface calls stable or passed, when what the fluids show is compared with what was set.
/// Where the interface rests they show the same, or something flows. Where it goes through they show what it bears on
/// its way, which is less, most of all behind a constriction; more only where something flows that was not set.
/// \param allowed  difference that measuring leaves, relative to the value
[[nodiscard]] constexpr hold_end compared(const hold_report& r, double allowed) noexcept {
  const double more = r.measured - r.value;
  const double most = allowed * r.value;
  const bool right = r.end == hold_end::passed ? more <= most : more <= most && -more <= most;
  return right || !(r.end == hold_end::stable || r.end == hold_end::passed) ? r.end : hold_end::flowing;
}

/// Why a search ended.
enum class search_end : std::uint8_t {
  running,      ///< not yet
  converged,    ///< the bracket is as narrow as asked
  unbracketed,  ///< refused: widened as often as allowed, the threshold is not inside
  unbearable,   ///< refused: above the highest stable value, by the width asked, a phase falls apart
  undecided     ///< failed: a hold gave no answer; its end says why
};

[[nodiscard]] constexpr verdict verdict_of(search_end e) noexcept {
  switch (e) {
    case search_end::converged: return verdict::ok;
    case search_end::unbracketed:
    case search_end::unbearable: return verdict::refused;
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
    case search_end::unbearable: return "the threshold lies above what the fluids bear";
    case search_end::undecided: return "a hold gave no answer";
  }
  return "not an end of a search";
}

/// How a threshold is searched. \par Domain  0 < lower < upper, widen > 1, width > 0
struct search_options {
  double lower = 0.7;
  double upper = 1.3;
  double width = 0.03;  ///< of the last bracket, relative to its middle
  double widen = 1.3;  ///< factor by which an end moves on that turned out to lie on the other side; then its square, …
  std::uint32_t most_widenings = 8;
};

/// Bisection from a bracket that need not hold the threshold: an end that turns out to lie on the other side becomes
/// the other end, and a new one is sought beyond. Values go up wherever they can: the first is the lower end. A hold
/// that ends while the fluid still creeps was close to the threshold: values half a width above and below decide.
/// A value at which a phase falls apart is a ceiling: the search goes on below it. A hold whose fluids show another
/// value than was set says nothing of the threshold; while no stable one is known the search goes on above it, since
/// far below a threshold an interface may stand so near to a reservoir that fluid flows between them.
class threshold_search {
 public:
  /// Everything that a search remembers. Plain numbers, to be saved as they are.
  struct memory {
    double lower = 0;
    double upper = 0;
    double measured_lower = quiet_nan<double>;  ///< what the last stable hold showed; NaN where it was not measured
    double position_lower = 0;
    double film_lower = 1;  ///< its film
    double creeping = 0;    ///< a value at which the fluid still moved at the last step allowed; 0: none
    double ceiling = 0;     ///< the least value at which a phase fell apart; 0: none
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
  /// Goes on from a memory with options of its own: a search that had ended goes on where they ask for a narrower
  /// bracket or allow it to be widened more often.
  threshold_search(const search_options& o, const memory& m) : threshold_search(o) {
    memory_ = m;
    if (m.end == search_end::converged || m.end == search_end::unbearable) {
      memory_.end = search_end::running;
    } else if (m.end == search_end::unbracketed && m.widenings < o.most_widenings) {
      memory_.end = search_end::running;
      reach_out();
    }
    settle();
  }

  [[nodiscard]] const memory& now() const noexcept { return memory_; }
  [[nodiscard]] bool running() const noexcept { return memory_.end == search_end::running; }
  [[nodiscard]] double value() const noexcept { return (memory_.lower + memory_.upper) / 2; }

  /// The value to hold next.
  [[nodiscard]] double next() const noexcept {
    if (memory_.creeping > 0) {
      const double above = memory_.creeping * (1 + options_.width / 2);
      const bool room =
          (memory_.upper_known == 0 || memory_.upper > above) && (memory_.ceiling == 0 || memory_.ceiling > above);
      return room ? above : memory_.creeping * (1 - options_.width / 2);
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
    if (lies_below(r.end)) {
      memory_.lower = held;
      memory_.lower_known = 1;
      memory_.measured_lower = r.measured;
      memory_.position_lower = r.position;
      memory_.film_lower = r.film;
      reach_out();
    } else if (r.end == hold_end::passed) {
      memory_.upper = held;
      memory_.upper_known = 1;
      reach_out();
    } else if (r.end == hold_end::step_limit && memory_.creeping == 0) {
      memory_.creeping = held;
      return;
    } else if (r.end == hold_end::dissolved && memory_.upper_known == 0) {
      memory_.ceiling = held;
      if (memory_.lower_known == 0) {
        widen(memory_.lower, held / stride(), search_end::undecided);
      }
    } else if (r.end == hold_end::flowing && memory_.lower_known == 0 &&
               !(memory_.upper_known != 0 && narrow(held, memory_.upper))) {
      memory_.creeping = 0;
      const double next = memory_.upper_known != 0 ? (held + memory_.upper) / 2 : held * stride();
      memory_.upper = std::max(memory_.upper, next);
      widen(memory_.lower, next, search_end::undecided);
    } else {
      memory_.end = search_end::undecided;
    }
    settle();
  }

 private:
  /// Moves the end on that turned out to lie on the other side.
  void reach_out() noexcept {
    if (memory_.lower_known != 0 && !(memory_.upper > memory_.lower)) {
      widen(memory_.upper, memory_.lower * stride());
    } else if (memory_.upper_known != 0 && memory_.lower_known == 0) {
      widen(memory_.lower, memory_.upper / stride());
    }
  }
  /// What is known after a hold: whether the search has ended.
  void settle() noexcept {
    if (running() && memory_.upper_known == 0 && memory_.ceiling > 0 && !(memory_.upper < memory_.ceiling)) {
      memory_.upper = (memory_.lower + memory_.ceiling) / 2;
      if (memory_.lower_known != 0 && narrow(memory_.lower, memory_.ceiling)) {
        memory_.end = search_end::unbearable;
      }
    }
    const bool outside = memory_.lower_known != 0 && memory_.lower >= memory_.creeping;
    memory_.creeping = outside || memory_.upper <= memory_.creeping ? 0 : memory_.creeping;
    if (running() && memory_.lower_known != 0 && memory_.upper_known != 0 && narrow(memory_.lower, memory_.upper)) {
      memory_.end = search_end::converged;
    }
  }
  /// How far an end moves: further each time, at most to twice the value.
  [[nodiscard]] double stride() const noexcept {
    double by = options_.widen;
    for (std::uint32_t k = 0; k < memory_.widenings && by < 2; ++k) {
      by *= by;
    }
    return by < 2 ? by : options_.widen < 2 ? 2 : options_.widen;
  }
  [[nodiscard]] bool narrow(double low, double high) const noexcept {
    return high - low <= options_.width * (low + high) / 2 * (1 + 1e-12);
  }
  void widen(double& end, double to, search_end in_vain = search_end::unbracketed) noexcept {
    if (memory_.widenings == options_.most_widenings) {
      memory_.end = in_vain;
      return;
    }
    ++memory_.widenings;
    end = to;
  }

  search_options options_;
  memory memory_;
};

/// Where an interface is going, from its positions at equal times: it sinks through a constriction, or comes to rest.
///
/// Near a threshold the pressure that would hold the interface has a highest value along the way, and the interface
/// is slowest there. One that has become twice as fast again is past it; one that comes to rest covers less and less
/// way in equal times, each time about the same share of the last or a smaller one.
/// \par Units  any length; positions go down where the fluid goes on
class interface_track {
 public:
  /// \param scale  what counts as a way: about the radius of the constriction
  /// \param stride  positions in a time of which ways are compared
  interface_track(double scale, std::size_t stride) : scale_(scale), stride_(stride) {}

  void add(double position) { at_.push_back(position); }

  /// Past the slowest place by a quarter of the scale, below `level`, and twice as fast.
  [[nodiscard]] bool runs_away(double level) const noexcept {
    const std::size_t n = at_.size();
    if (n <= 2 * stride_ || !(at_.back() < level)) {
      return false;
    }
    double least = std::numeric_limits<double>::infinity();
    double place = 0;
    for (std::size_t k = n; k-- > stride_;) {
      if (at_[k] > at_.back() + scale_) {
        break;
      }
      if (const double way = at_[k - stride_] - at_[k]; way < least) {
        least = way;
        place = at_[k];
      }
    }
    const double last = at_[n - 1 - stride_] - at_.back();
    return last > 0 && last > 2 * least && place > at_.back() + scale_ / 4;
  }

  /// What is left of the way is less than 3 % of the scale, by three ways that shrink like a geometric series.
  [[nodiscard]] bool comes_to_rest() const noexcept {
    const std::size_t n = at_.size();
    if (n < 3 * stride_ + 1) {
      return false;
    }
    const auto way = [&](std::size_t back) { return at_[n - 1 - back * stride_] - at_[n - 1 - (back + 1) * stride_]; };
    const double a = way(2);
    const double b = way(1);
    const double c = way(0);
    const double q = c / b;
    return a * b > 0 && b * c > 0 && q < 0.9 && q <= b / a + 0.03 && std::abs(c * q / (1 - q)) < 0.03 * scale_;
  }

 private:
  double scale_;
  std::size_t stride_;
  std::vector<double> at_;
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
    if (lies_below(r.end)) {
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
