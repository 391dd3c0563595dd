// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/core.hpp"
#include "tetrapore/simplex/opening.hpp"

static_assert(TETRAPORE_CONTRACTS == 0);

bool unchecked_half_counts();
bool unchecked_half_is_unchecked();

bool unchecked_half_counts() {
  tetrapore::opening<double> ring;
  for (int k = 0; k < 8; ++k) {
    ring.add_disc({double(k), 0.0}, 1.0);
  }
  return ring.count == 8 && ring.next(7) == 0;
}

bool unchecked_half_is_unchecked() {
  TETRAPORE_EXPECTS(false, "a contract that is off is never reached");
  return true;
}
