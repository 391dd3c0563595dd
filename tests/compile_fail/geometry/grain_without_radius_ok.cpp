// SPDX-License-Identifier: BSD-3-Clause
// A grain gives a centre and a radius.
#include "tetrapore/geometry/primitives.hpp"

struct mine {
  tetrapore::vec3<double> centre;
  double radius;
};
static_assert(tetrapore::grain_like<mine>);
