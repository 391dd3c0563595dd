// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/lbm/laplace.hpp"

#include <doctest/doctest.h>

using namespace tetrapore;
using namespace tetrapore::lbm;

TEST_CASE("a disc that rests beside the density asked for says so, and what it is there") {
  laplace_set_up o{.radius = 6, .half_box = 12, .tension = 0.0862, .rest = {100, 1e-2, 1, 20000}};
  o.main = 1.0512345678901;  // between the numbers of a float
  o.tolerance = 1e-2;
  CHECK(laplace<mixture<d2q9, bgk>>(o).rest.end == hold_end::stable);
  o.tolerance = 1e-12;
  const laplace_result b = laplace<mixture<d2q9, bgk>>(o);
  CHECK(b.rest.end == hold_end::missed);
  CHECK(verdict_of(b.rest.end) == verdict::failed);
  CHECK(b.tension > 0.05);
  CHECK(b.width > 1);
}
