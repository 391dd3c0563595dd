// SPDX-License-Identifier: BSD-3-Clause
// Curved walls correct what one component sends into them.
#include "tetrapore/lbm/curved_walls.hpp"
#include "tetrapore/lbm/moments.hpp"

using namespace tetrapore::lbm;
using fluid = mixture<d3q19, trt, guo, linear_potential, 1>;
using walls = curved_walls<simulation<fluid, double>>;
static_assert(sizeof(walls) > 0);
