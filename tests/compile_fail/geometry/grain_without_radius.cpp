// SPDX-License-Identifier: BSD-3-Clause
// A grain gives a centre and a radius.
// expect: no operand of the disjunction|no member named 'radius' in 'mine'
#include "tetrapore/geometry/primitives.hpp"

struct mine {
  tetrapore::vec3<double> centre;
  double diameter;
};
static_assert(tetrapore::grain_like<mine>);
