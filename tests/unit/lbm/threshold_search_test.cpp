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

  hold_report hold(double value) {
    held.push_back(value);
    hold_report r{.value = value, .measured = 0.99 * value, .steps = 10, .updates = 100};
    r.end = failure != hold_end::stable ? failure : value > threshold ? hold_end::passed : hold_end::stable;
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

TEST_CASE("a hold without an answer ends the search and is named") {
  for (const hold_end why : {hold_end::not_finite, hold_end::dissolved, hold_end::drifting}) {
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

TEST_CASE("a bracket that is none is refused") {
  CHECK_THROWS_AS(threshold_search({.lower = 0}), parameter_error);
  CHECK_THROWS_AS(threshold_search({.lower = 2, .upper = 1}), parameter_error);
  CHECK_THROWS_AS(threshold_search({.width = 0}), parameter_error);
  CHECK_THROWS_AS(threshold_search({.widen = 1}), parameter_error);
}
