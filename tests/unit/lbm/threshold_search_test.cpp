// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/lbm/experiment.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace tetrapore;
using namespace tetrapore::lbm;

namespace {

/// What passes above a threshold, without a fluid.
struct gate {
  double threshold;
  std::vector<double> held{};
  int kept = 0;
  int returned = 0;
  hold_end failure = hold_end::stable;
  double bears = 1e300;
  double flows_below = 0;

  hold_report hold(double value) {
    held.push_back(value);
    hold_report r{.value = value, .measured = 0.99 * value, .steps = 10, .updates = 100};
    r.end = failure != hold_end::stable ? failure
            : value > bears             ? hold_end::dissolved
            : value < flows_below       ? hold_end::flowing
            : value > threshold         ? hold_end::passed
                                        : hold_end::stable;
    return r;
  }
  void keep() { ++kept; }
  void back() { ++returned; }
};
static_assert(held_experiment<gate>);

}  // namespace

TEST_CASE("a bracket ends around the threshold, as narrow as asked, wherever it starts") {
  for (const double threshold : {0.2, 0.55, 0.7, 0.9, 1.0, 1.29, 1.7, 4.0}) {
    CAPTURE(threshold);
    gate g{threshold};
    threshold_search s({.lower = 0.7, .upper = 1.3, .width = 0.02});
    run(g, s);
    CHECK(s.now().end == search_end::converged);
    CHECK(s.now().lower <= threshold);
    CHECK(s.now().upper > threshold);
    CHECK(s.now().upper - s.now().lower <= 0.02 * s.value());
    CHECK(s.now().measured_lower == doctest::Approx(0.99 * s.now().lower));
    CHECK(s.now().holds == g.held.size());
    CHECK(s.now().steps == 10 * g.held.size());
    CHECK(s.now().updates == 100 * g.held.size());
    CHECK(g.kept + g.returned == static_cast<int>(g.held.size()));
  }
}

TEST_CASE("brackets that start 30 % too low and 30 % too high end overlapping") {
  gate g{1};
  threshold_search low({.lower = 0.49, .upper = 0.91});
  threshold_search high({.lower = 0.91, .upper = 1.69});
  run(g, low);
  run(g, high);
  CHECK(low.now().lower < high.now().upper);
  CHECK(high.now().lower < low.now().upper);
}

TEST_CASE("a threshold that no widening reaches is refused, not guessed") {
  for (const double threshold : {1e-9, 1e9}) {
    gate g{threshold};
    threshold_search s({.most_widenings = 3});
    run(g, s);
    CHECK(s.now().end == search_end::unbracketed);
    CHECK(s.now().widenings == 3);
    CHECK(verdict_of(s.now().end) == verdict::refused);
  }
}

TEST_CASE("a hold that creeps at the threshold is decided by its neighbours") {
  for (const double threshold : {0.704, 0.9964, 1.003, 1.297}) {
    CAPTURE(threshold);
    struct slow_gate : gate {
      hold_report hold(double value) {
        hold_report r = gate::hold(value);
        r.end = std::abs(value - threshold) < 0.005 ? hold_end::step_limit : r.end;
        return r;
      }
    };
    slow_gate g{{threshold}};
    threshold_search s({});
    run(g, s);
    CHECK(s.now().end == search_end::converged);
    CHECK(s.now().lower <= threshold);
    CHECK(s.now().upper > threshold);
    CHECK(s.now().upper - s.now().lower <= 0.03 * s.value() * (1 + 1e-9));
  }
}

TEST_CASE("a search in which every hold creeps ends undecided") {
  gate g{1};
  g.failure = hold_end::step_limit;
  threshold_search s({});
  run(g, s);
  CHECK(s.now().end == search_end::undecided);
  CHECK(s.now().last == hold_end::step_limit);
  CHECK(s.now().holds == 2);
}

TEST_CASE("what no hold has measured is no number") {
  CHECK(std::isnan(hold_report{}.measured));
  gate g{1};
  g.failure = hold_end::drifting;
  threshold_search s({});
  run(g, s);
  CHECK(std::isnan(s.now().measured_lower));
  g.failure = hold_end::stable;
  threshold_search found({});
  run(g, found);
  CHECK(found.now().measured_lower == 0.99 * found.now().lower);
}

TEST_CASE("a hold without an answer ends the search and is named") {
  for (const hold_end why : {hold_end::not_finite, hold_end::drifting}) {
    gate g{1};
    g.failure = why;
    threshold_search s({});
    run(g, s);
    CHECK(s.now().end == search_end::undecided);
    CHECK(s.now().last == why);
    CHECK(s.now().holds == 1);
    CHECK(verdict_of(why) == verdict::failed);
    CHECK(verdict_of(s.now().end) == verdict::failed);
  }
}

TEST_CASE("a search goes on above values at which something flows, until it has a stable one") {
  for (const double start : {0.4, 0.6, 0.7, 0.85}) {
    gate g{1};
    g.flows_below = 0.8;
    threshold_search s({.lower = start * 0.7, .upper = start * 1.3, .width = 0.03});
    run(g, s);
    CAPTURE(start);
    CHECK(s.now().end == search_end::converged);
    CHECK(s.now().lower <= 1);
    CHECK(s.now().upper > 1);
    CHECK(s.now().lower >= 0.8);
  }
  gate closed{1};
  closed.flows_below = 1;  // passes or flows: no stable value anywhere
  threshold_search vain({.lower = 0.5, .upper = 1.2});
  run(closed, vain);
  CHECK(verdict_of(vain.now().end) != verdict::ok);
  gate g{1};
  g.failure = hold_end::flowing;
  threshold_search s({});
  run(g, s);
  CHECK(s.now().end == search_end::undecided);
  CHECK(s.now().last == hold_end::flowing);
  CHECK(s.now().holds <= 9);
}

TEST_CASE("fluids that show another value than was set are named, but for what an interface spends on its way") {
  const auto end = [](hold_end e, double measured) {
    hold_report r{.value = 2, .measured = measured};
    r.end = e;
    return compared(r, 0.05);
  };
  CHECK(end(hold_end::stable, 2.09) == hold_end::stable);
  CHECK(end(hold_end::stable, 1.91) == hold_end::stable);
  CHECK(end(hold_end::stable, 2.11) == hold_end::flowing);
  CHECK(end(hold_end::stable, 1.89) == hold_end::flowing);
  CHECK(end(hold_end::passed, 1.5) == hold_end::passed);
  CHECK(end(hold_end::passed, 2.11) == hold_end::flowing);
  CHECK(end(hold_end::passed, std::nan("")) == hold_end::flowing);
  CHECK(end(hold_end::stable, std::nan("")) == hold_end::flowing);
  CHECK(end(hold_end::step_limit, 9) == hold_end::step_limit);
  CHECK(end(hold_end::drifting, 9) == hold_end::drifting);
}

TEST_CASE("a search goes on below values at which a phase falls apart") {
  for (const double threshold : {0.4, 0.6, 0.75, 0.85}) {
    for (const double bears : {0.9, 1.0, 1.29}) {
      CAPTURE(threshold);
      CAPTURE(bears);
      gate g{threshold};
      g.bears = bears;
      for (const double start : {0.7, 1.0, 1.4}) {
        threshold_search s({.lower = 0.7 * start, .upper = 1.3 * start});
        run(g, s);
        CHECK(s.now().end == search_end::converged);
        CHECK(s.now().lower <= threshold);
        CHECK(s.now().upper > threshold);
      }
    }
  }
}

TEST_CASE("a threshold above what the fluids bear is named, and how far they bore") {
  for (const double start : {0.5, 1.0, 2.0}) {
    CAPTURE(start);
    gate g{5};
    g.bears = 0.9;
    threshold_search s({.lower = 0.7 * start, .upper = 1.3 * start});
    run(g, s);
    CHECK(s.now().end == search_end::unbearable);
    CHECK(verdict_of(s.now().end) == verdict::refused);
    CHECK(s.now().lower <= 0.9);
    CHECK(s.now().ceiling > 0.9);
    CHECK(s.now().ceiling - s.now().lower <= 0.03 * 0.9 * 1.02);
  }
}

TEST_CASE("fluids that fall apart at every value end a search that went down in vain") {
  gate g{1};
  g.bears = 0;
  threshold_search s({.most_widenings = 3});
  run(g, s);
  CHECK(s.now().end == search_end::undecided);
  CHECK(s.now().last == hold_end::dissolved);
  CHECK(s.now().holds == 4);
}

TEST_CASE("a search that is taken up from its memory goes on as if it had never stopped") {
  for (std::size_t stop = 1; stop < 7; ++stop) {
    gate whole{1.1};
    threshold_search one({});
    run(whole, one);
    gate broken{1.1};
    threshold_search two({});
    for (std::size_t k = 0; k < stop; ++k) {
      two.take(broken.hold(two.next()));
    }
    threshold_search three({}, two.now());
    run(broken, three);
    CHECK(broken.held == whole.held);
    CHECK(three.now().lower == one.now().lower);
    CHECK(three.now().upper == one.now().upper);
    CHECK(three.now().steps == one.now().steps);
  }
}

TEST_CASE("a search that had ended and is taken up with a narrower bracket goes on to it") {
  gate g{1.1};
  threshold_search wide({.width = 0.1});
  run(g, wide);
  REQUIRE(wide.now().end == search_end::converged);
  threshold_search narrow({.width = 0.01}, wide.now());
  CHECK(narrow.running());
  run(g, narrow);
  CHECK(narrow.now().end == search_end::converged);
  CHECK(narrow.now().lower <= 1.1);
  CHECK(narrow.now().upper > 1.1);
  CHECK(narrow.now().upper - narrow.now().lower <= 0.01 * narrow.value());
  const auto holds = g.held.size();
  threshold_search same({.width = 0.01}, narrow.now());
  CHECK(!same.running());
  threshold_search wider({.width = 0.1}, narrow.now());
  CHECK(!wider.running());
  CHECK(g.held.size() == holds);
}

TEST_CASE("a search that was stopped is over at once where a wider bracket is asked for and known") {
  gate g{1.1};
  threshold_search s({.width = 0.01});
  while (s.now().lower_known == 0 || s.now().upper_known == 0) {
    s.take(g.hold(s.next()));
  }
  REQUIRE(s.running());
  const threshold_search wide({.width = 1}, s.now());
  CHECK(wide.now().end == search_end::converged);
}

TEST_CASE("a search that ended for its options goes on when these allow it, and one without an answer does not") {
  for (const double threshold : {0.01, 40.0}) {
    gate g{threshold};
    threshold_search short_of({.most_widenings = 1});
    run(g, short_of);
    REQUIRE(short_of.now().end == search_end::unbracketed);
    const threshold_search again({.most_widenings = 1}, short_of.now());
    CHECK(again.now().end == search_end::unbracketed);
    threshold_search more({}, short_of.now());
    run(g, more);
    CHECK(more.now().end == search_end::converged);
    CHECK(more.now().lower <= threshold);
    CHECK(more.now().upper > threshold);
  }
  gate fragile{5};
  fragile.bears = 0.9;
  threshold_search coarse({.width = 0.1});
  run(fragile, coarse);
  REQUIRE(coarse.now().end == search_end::unbearable);
  threshold_search fine({.width = 0.01}, coarse.now());
  CHECK(fine.running());
  run(fragile, fine);
  CHECK(fine.now().end == search_end::unbearable);
  CHECK(fine.now().ceiling - fine.now().lower <= 0.0101 * 0.9);

  gate silent{1};
  silent.failure = hold_end::missed;
  threshold_search failed({});
  run(silent, failed);
  CHECK(verdict_of(hold_end::missed) == verdict::failed);
  CHECK(threshold_search({.width = 0.001}, failed.now()).now().end == search_end::undecided);
}

TEST_CASE("a bracket that is none is refused") {
  CHECK_THROWS_AS(threshold_search({.lower = 0}), parameter_error);
  CHECK_THROWS_AS(threshold_search({.lower = 2, .upper = 1}), parameter_error);
  CHECK_THROWS_AS(threshold_search({.width = 0}), parameter_error);
  CHECK_THROWS_AS(threshold_search({.widen = 1}), parameter_error);
}
