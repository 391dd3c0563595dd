// SPDX-License-Identifier: BSD-3-Clause
// Gas and liquid are held, no single fluid.
// expect: held_fluids: a gas and a liquid, two components
#include "tetrapore/lbm/held_fluids.hpp"

using namespace tetrapore::lbm;
using held = held_fluids<double, mixture<d3q19, bgk, velocity_shift, linear_potential, 1>, storage::in_place>;
static_assert(sizeof(held) > 0);
