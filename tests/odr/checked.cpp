// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/core.hpp"
#include "tetrapore/simplex/opening.hpp"

static_assert(TETRAPORE_CONTRACTS == 1);

bool checked_half_counts();
void checked_half_violates();

bool checked_half_counts() {
  tetrapore::opening<double> ring;
  for (int k = 0; k < 8; ++k) {
    ring.add_disc({double(k), 0.0}, 1.0);
  }
  return ring.count == 8 && ring.next(7) == 0;
}

void checked_half_violates() {
  tetrapore::opening<double> ring;
  for (int k = 0; k < 9; ++k) {
    ring.add_disc({double(k), 0.0}, 1.0);
  }
}
