// SPDX-License-Identifier: BSD-3-Clause
// Curved walls correct populations.
// expect: curved_walls: storage::moments keeps no populations
#include "tetrapore/lbm/curved_walls.hpp"
#include "tetrapore/lbm/moments.hpp"

using namespace tetrapore::lbm;
using fluid = mixture<d3q19, bgk, velocity_shift, linear_potential, 1>;
using walls = curved_walls<simulation<fluid, double, storage::moments>>;
static_assert(sizeof(walls) > 0);
