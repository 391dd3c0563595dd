// SPDX-License-Identifier: BSD-3-Clause
#include "support/sanitized.hpp"
#include "tetrapore/lbm/contact_angle.hpp"
#include "tetrapore/lbm/kept_waits.hpp"
#include "tetrapore/lbm/laplace.hpp"
#include "tetrapore/lbm/pendular_experiment.hpp"
#include "tetrapore/lbm/permeability.hpp"
#include "tetrapore/lbm/tube_experiment.hpp"

#include <doctest/doctest.h>

#include <map>
#include <vector>

using namespace tetrapore;
using namespace tetrapore::lbm;

namespace {

using states = std::map<std::size_t, std::vector<std::byte>>;
struct killed {};

/// Keeps states in memory and throws `killed` in place of the save behind so many.
class memory final : public kept_waits {
 public:
  explicit memory(states& all, std::size_t lives = 1000000) : all_(&all), lives_(lives) {}
  [[nodiscard]] std::optional<std::vector<std::byte>> load(std::size_t wait) override {
    const auto found = all_->find(wait);
    return found == all_->end() ? std::nullopt : std::optional(found->second);
  }
  void save(std::size_t wait, const std::vector<std::byte>& state) override {
    if (saves_ == lives_) {
      throw killed{};
    }
    (*all_)[wait] = state;
    ++saves_;
  }
  [[nodiscard]] std::size_t saves() const noexcept { return saves_; }

 private:
  states* all_;
  std::size_t lives_;
  std::size_t saves_ = 0;
};

std::vector<double> numbers_of(const rest_report& r) {
  return {r.change, static_cast<double>(r.steps), static_cast<double>(r.updates), static_cast<double>(r.end)};
}
std::vector<double> numbers_of(std::vector<double> own, const rest_report& r) {
  const auto rest = numbers_of(r);
  own.insert(own.end(), rest.begin(), rest.end());
  return own;
}
std::vector<double> numbers_of(const laplace_result& b) {
  return numbers_of({b.tension, b.radius, b.tension_of_one, b.radius_of_one, b.inside[0], b.inside[1], b.outside[0],
                     b.outside[1], b.width, b.spurious, b.out_of_round},
                    b.rest);
}
std::vector<double> numbers_of(const contact_result& c) {
  return numbers_of({c.angle, c.curvature, c.cosine, c.tension, c.more, c.residual, c.by_rows, c.driest}, c.rest);
}
[[maybe_unused]] std::vector<double> numbers_of(const pendular_result& b) {
  return numbers_of({b.suction, b.force, b.volume, b.neck, b.law_force, b.law_volume, b.law_neck, b.retraction,
                     b.tension, b.dry, static_cast<double>(b.law)},
                    b.rest);
}
[[maybe_unused]] std::vector<double> numbers_of(const tube_result& t) {
  return numbers_of({t.pressure, t.entry, t.law, t.tension, t.shift, t.retraction, t.flow}, t.rest);
}
[[maybe_unused]] std::vector<double> numbers_of(const outcome<lattice_permeability, flow_status>& k) {
  return {k.value.permeability, k.value.porosity, static_cast<double>(k.value.steps), static_cast<double>(k.reason)};
}

/// An experiment that is killed at its first save, its last or between goes on to what it would have been, and runs
/// nothing twice.
/// \param experiment  (kept_waits*) → its result
/// \param waits       that it has at least
/// \return the states of the whole one
template <class Experiment>
states goes_on_to_the_bit(Experiment experiment, std::size_t waits) {
  const auto whole = numbers_of(experiment(nullptr));
  states all;
  memory watched(all);
  CHECK(numbers_of(experiment(&watched)) == whole);
  CHECK(all.size() >= waits);
  CHECK(watched.saves() > waits);
  const std::size_t last = watched.saves() - 1;
  for (const std::size_t lives : {std::size_t{0}, last / 4, last / 2, last * 3 / 4, last}) {
    states some;
    memory first(some, lives);
    CHECK_THROWS_AS(static_cast<void>(experiment(&first)), killed);
    memory second(some);
    CHECK(numbers_of(experiment(&second)) == whole);
    CHECK(lives + second.saves() == watched.saves());
  }
  memory finished(all);
  CHECK(numbers_of(experiment(&finished)) == whole);
  CHECK(finished.saves() == 0);
  return all;
}

template <class Experiment>
void refuses(states all, Experiment experiment) {
  const states before = all;
  memory kept(all);
  CHECK_THROWS_AS(static_cast<void>(experiment(&kept)), input_error);
  CHECK(all == before);
}

// a sanitized build compiles the kernel of `flat` alone
using flat = mixture<d2q9, bgk>;

laplace_set_up disc(kept_waits* kept) {
  return {.radius = 6, .half_box = 12, .tension = 0.0862, .tolerance = 1e-3, .rest = {100, 2e-3, 2, 20000, kept}};
}

contact_set_up between_plates(kept_waits* kept) {
  return {.expected = 1.2, .half_gap = 10, .rest = {100, 1e-3, 2, 20000, kept}};
}

template <class T = double>
outcome<lattice_permeability, flow_status> cubic(kept_waits* kept, double radius = 0.4, double tau = 1) {
  permeability_options how{.tau = tau, .steady = 1e-3};
  how.kept = kept;
  return measure_permeability<d3q19, T>({{1, 1, 1}, {{{0.5, 0.5, 0.5}, radius}}, {false, true, true}}, 8, 0, how);
}

}  // namespace

TEST_CASE("a disc that is killed in any of its waits goes on to the bit") {
  const states all = goes_on_to_the_bit([](kept_waits* kept) { return laplace<flat>(disc(kept)); }, 2);

  states bad = all;
  bad[0][bad[0].size() / 2] ^= std::byte{1};
  const auto again = [](kept_waits* kept) { return laplace<flat>(disc(kept)); };
  refuses(bad, again);
  bad = all;
  bad[1].resize(bad[1].size() - 1);
  refuses(bad, again);
  bad = all;
  bad[1].clear();
  refuses(bad, again);
  bad = all;
  std::swap(bad[0], bad[1]);
  refuses(bad, again);
  const auto other = [&](auto change) {
    refuses(all, [&](kept_waits* kept) {
      laplace_set_up o = disc(kept);
      change(o);
      return laplace<flat>(o);
    });
  };
  other([](laplace_set_up& o) { o.radius = 6.01; });
  other([](laplace_set_up& o) { o.half_box = 13; });
  other([](laplace_set_up& o) { o.attraction = 1.801; });
  other([](laplace_set_up& o) { o.tau = 1.001; });
  other([](laplace_set_up& o) { o.rest.window = 102; });
  other([](laplace_set_up& o) { o.rest.still = 2.1e-3; });
  other([](laplace_set_up& o) { o.rest.looks = 3; });
  other([](laplace_set_up& o) { o.rest.most_steps = 30000; });
  if constexpr (!sanitized) {
    refuses(all, [](kept_waits* kept) { return laplace<flat, double>(disc(kept)); });
  }
}

TEST_CASE("a meniscus that is killed goes on to the bit; that of another wall or another fit is refused") {
  const states all = goes_on_to_the_bit([](kept_waits* kept) { return contact_angle<flat>(between_plates(kept)); }, 2);
  for (const bool wall : {true, false}) {
    refuses(all, [&](kept_waits* kept) {
      contact_set_up o = between_plates(kept);
      (wall ? o.wettability : o.main) *= 1.001;
      return contact_angle<flat>(o);
    });
  }
  refuses(all, [&](kept_waits* kept) {
    contact_set_up o = between_plates(kept);
    o.skipped = 3;
    return contact_angle<flat>(o);
  });
}

TEST_CASE("a bridge and a tube that are killed go on to the bit") {
  if constexpr (!sanitized) {
    const auto row = calibrated(forcing_kind::velocity_shift, 1, 1.8);
    REQUIRE(row.ok());
    const auto bridge = [&](kept_waits* kept) {
      return pendular_bridge<>({.mixture = row.value,
                                .radius = 6,
                                .gap = 0.2,
                                .suction = 0.2,
                                .margin = 4,
                                .rest = {100, 1e-2, 1, 3000, kept}});
    };
    const auto square_tube = [&](kept_waits* kept) {
      tube_set_up o{};
      o.nodes_per_length = 5;
      o.gas = 2;
      o.liquid = 1.5;
      o.mixture = row.value;
      o.kept = kept;
      for (const vec2<double> out : {vec2<double>{0, -1}, {1, 0}, {0, 1}, {-1, 0}}) {
        o.section.add_line(out, out * -1.0);
      }
      return tube_at_rest<>(o);
    };
    goes_on_to_the_bit(bridge, 2);
    goes_on_to_the_bit(square_tube, 3);
  }
}

TEST_CASE("a permeability that is killed goes on to the bit") {
  if constexpr (!sanitized) {
    const states all = goes_on_to_the_bit([](kept_waits* kept) { return cubic<>(kept); }, 1);
    refuses(all, [](kept_waits* kept) { return cubic<>(kept, 0.401); });
    refuses(all, [](kept_waits* kept) { return cubic<>(kept, 0.4, 1.001); });
    const double tau = 0.8;  // an odd number of steps between two looks
    goes_on_to_the_bit([&](kept_waits* kept) { return cubic<>(kept, 0.4, tau); }, 1);
  }
}
