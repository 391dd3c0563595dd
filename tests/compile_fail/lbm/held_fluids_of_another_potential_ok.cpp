// SPDX-License-Identifier: BSD-3-Clause
// Densities of reservoirs are known for one pseudopotential.
#include "tetrapore/lbm/held_fluids.hpp"

using namespace tetrapore::lbm;
using held = held_fluids<double, mixture<d3q19, bgk, velocity_shift, linear_potential>, storage::in_place>;
static_assert(sizeof(held) > 0);
