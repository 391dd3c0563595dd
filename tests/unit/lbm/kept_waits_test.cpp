// SPDX-License-Identifier: BSD-3-Clause
#include "support/killed_waits.hpp"
#include "support/sanitized.hpp"
#include "tetrapore/lbm/contact_angle.hpp"
#include "tetrapore/lbm/laplace.hpp"

#include <doctest/doctest.h>

#include <vector>

using namespace tetrapore;
using namespace tetrapore::lbm;
using namespace killed_waits;

namespace {

std::vector<double> numbers_of(const laplace_result& b) {
  return with_rest({b.tension, b.radius, b.tension_of_one, b.radius_of_one, b.inside[0], b.inside[1], b.outside[0],
                    b.outside[1], b.width, b.spurious, b.out_of_round},
                   b.rest);
}
std::vector<double> numbers_of(const contact_result& c) {
  return with_rest({c.angle, c.curvature, c.cosine, c.tension, c.more, c.residual, c.by_rows, c.driest}, c.rest);
}

// a sanitized build compiles the kernel of `flat` alone
using flat = mixture<d2q9, bgk>;

laplace_set_up disc(kept_waits* kept) {
  return {.radius = 6, .half_box = 12, .tension = 0.0862, .tolerance = 1e-3, .rest = {100, 2e-3, 2, 20000, kept}};
}

contact_set_up between_plates(kept_waits* kept) {
  return {.expected = 1.2, .half_gap = 10, .rest = {100, 1e-3, 2, 20000, kept}};
}

}  // namespace

TEST_CASE("a disc that is killed in any of its waits goes on to the bit") {
  const states all = goes_on_to_the_bit([](kept_waits* kept) { return numbers_of(laplace<flat>(disc(kept))); }, 2);

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
  const states all =
      goes_on_to_the_bit([](kept_waits* kept) { return numbers_of(contact_angle<flat>(between_plates(kept))); }, 2);
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
