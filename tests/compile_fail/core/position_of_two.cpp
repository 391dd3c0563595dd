// SPDX-License-Identifier: BSD-3-Clause
// A position gives three coordinates.
// expect: no operand of the disjunction|no member named 'z' in 'mine'
#include "tetrapore/core/vec3.hpp"

struct mine {
  double x, y, height;
};
static_assert(tetrapore::position<mine>);
