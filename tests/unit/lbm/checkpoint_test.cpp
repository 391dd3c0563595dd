// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/lbm/checkpoint.hpp"
#include "tetrapore/lbm/entry_experiment.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace tetrapore;
using namespace tetrapore::lbm;

namespace {

std::vector<std::byte> small_state() {
  checkpoint_writer out(7);
  out.append(3.5);
  out.append(std::uint64_t{9});
  return std::move(out).finish();
}

/// Three equal spheres with wide gaps, coarse: 1,400 fluid nodes.
entry_set_up wide_throat() {
  entry_set_up s;
  const double d = 2.4;
  s.throat.add_disc({0, 0}, 1);
  s.throat.add_disc({d, 0}, 1);
  s.throat.add_disc({d / 2, d * std::sqrt(3.0) / 2}, 1);
  s.nodes_per_length = 6;
  return s;
}

}  // namespace

TEST_CASE("a state is read back as it was written") {
  const auto bytes = small_state();
  checkpoint_reader in(bytes, 7, "state");
  double x = 0;
  std::uint64_t n = 0;
  in.take(x);
  CHECK_THROWS_AS(in.finish(), input_error);
  in.take(n);
  CHECK(x == 3.5);
  CHECK(n == 9);
  CHECK_NOTHROW(in.finish());
  CHECK_THROWS_AS(in.take(n), input_error);
}

TEST_CASE("a state with any byte changed, cut short, prolonged or of other parameters is refused") {
  const auto bytes = small_state();
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    auto bad = bytes;
    bad[k] ^= std::byte{0x10};
    CHECK_THROWS_AS(checkpoint_reader(bad, 7, "state"), input_error);
  }
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    CHECK_THROWS_AS(checkpoint_reader(std::span(bytes).first(n), 7, "state"), input_error);
  }
  auto longer = bytes;
  longer.push_back(std::byte{0});
  CHECK_THROWS_AS(checkpoint_reader(longer, 7, "state"), input_error);
  CHECK_THROWS_WITH_AS(checkpoint_reader(bytes, 8, "state"),
                       "state: found the state of another experiment, expected one of the same geometry, lattice "
                       "and fluids",
                       input_error);
}

TEST_CASE("an experiment that is killed between holds goes on to the bit") {
  const entry_set_up s = wide_throat();
  entry_experiment<float> first(s);
  const double p = first.lattice_pressure(first.plane().best);
  const search_options options{.lower = 0.6 * p, .upper = 1.2 * p};
  threshold_search search(options);
  const hold_report lower = first.hold(search.next());
  REQUIRE(lower.end == hold_end::stable);
  first.keep();
  search.take(lower);
  const auto saved = first.save(search);

  const hold_report whole = first.hold(search.next());
  entry_experiment<float> second(s);
  threshold_search resumed = second.restore(saved, options);
  CHECK(resumed.next() == search.next());
  CHECK(resumed.now().steps == lower.steps);
  const hold_report again = second.hold(resumed.next());
  CHECK(again.end == hold_end::passed);
  CHECK(again.end == whole.end);
  CHECK(again.steps == whole.steps);
  CHECK(again.position == whole.position);
  CHECK(again.measured == whole.measured);

  auto damaged = saved;
  damaged[damaged.size() / 2] ^= std::byte{1};
  CHECK_THROWS_AS(static_cast<void>(second.restore(damaged, options)), input_error);
  entry_set_up other = s;
  other.retraction = 1;
  entry_experiment<float> stranger(other);
  CHECK_THROWS_AS(static_cast<void>(stranger.restore(saved, options)), input_error);
  other = s;
  other.fitted = false;
  entry_experiment<float> unfitted(other);
  CHECK_THROWS_AS(static_cast<void>(unfitted.restore(saved, options)), input_error);
  CHECK(second.result(resumed).correction == entry_correction(second.inscribed()));
  other.fitted = true;
  other.gas_share = 0.6;
  entry_experiment<float> shared(other);
  CHECK(shared.correction() == 1);
  CHECK(std::isnan(shared.result(resumed).discretisation));
  entry_experiment<double> finer(s);
  CHECK_THROWS_WITH_AS(static_cast<void>(finer.restore(saved, options)),
                       "state: found moments in numbers of 4 bytes, expected moments in numbers of 8 bytes",
                       input_error);
  entry_experiment<float, mixture<d3q19, bgk>, storage::in_place> elsewhere(s);
  CHECK_THROWS_WITH_AS(static_cast<void>(elsewhere.restore(saved, options)),
                       "state: found moments in numbers of 4 bytes, expected populations in numbers of 4 bytes",
                       input_error);
}

TEST_CASE("a hold at a pressure that no fluid bears says that a phase dissolves, without a step") {
  entry_experiment<float> e(wide_throat());
  const hold_report r = e.hold(1.0);
  CHECK(r.end == hold_end::dissolved);
  CHECK(r.steps == 0);
  CHECK(std::isnan(r.measured));
}
