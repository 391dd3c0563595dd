// SPDX-License-Identifier: BSD-3-Clause
// A position gives three coordinates.
#include "tetrapore/core/vec3.hpp"

struct mine {
  double x, y, z;
};
static_assert(tetrapore::position<mine>);
