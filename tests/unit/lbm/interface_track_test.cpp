// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/lbm/experiment.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace tetrapore;
using namespace tetrapore::lbm;

namespace {

enum class told { rest, away, nothing };

/// An interface that sinks by dx/dt = −(excess + (x − place)²) near the slowest place of a constriction of radius 1.
told sink(double excess, double from, double place, double step, int looks) {
  interface_track track(1, 5);
  double x = from;
  for (int k = 0; k < looks; ++k) {
    track.add(x);
    if (track.runs_away(-1)) {
      return told::away;
    }
    if (track.comes_to_rest()) {
      return told::rest;
    }
    for (int part = 0; part < 20; ++part) {
      x -= step / 20 * (excess + (x - place) * (x - place));
    }
  }
  return told::nothing;
}

}  // namespace

TEST_CASE("an interface below its threshold is told to rest, one above to run away, before it has gone all the way") {
  for (const double excess : {0.01, 0.03, 0.1, 0.3}) {
    for (const double place : {-1.3, -1.0}) {
      for (const double from : {1.0, 0.0, place + 0.6}) {
        CAPTURE(excess);
        CAPTURE(place);
        CAPTURE(from);
        CHECK(sink(excess, from, place, 0.1, 4000) == told::away);
        CHECK(sink(-excess, from, place, 0.1, 4000) == told::rest);
      }
    }
  }
}

TEST_CASE("an interface that only slows down in a constriction is not told to rest") {
  CHECK(sink(1e-3, 0, -1.2, 0.1, 4000) != told::rest);
}

TEST_CASE("nothing is told of an interface that stands still, moves evenly or swings") {
  for (const auto& at : {+[](int) { return 0.3; }, +[](int k) { return 1 - 0.01 * k; },
                         +[](int k) { return 0.1 * std::sin(0.7 * k); }}) {
    interface_track track(1, 5);
    for (int k = 0; k < 300; ++k) {
      track.add(at(k));
      CHECK_FALSE(track.runs_away(-1));
      CHECK_FALSE(track.comes_to_rest());
    }
  }
}
