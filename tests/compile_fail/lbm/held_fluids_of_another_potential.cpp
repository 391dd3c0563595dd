// SPDX-License-Identifier: BSD-3-Clause
// Densities of reservoirs are known for one pseudopotential.
// expect: held_fluids: reservoirs are known for psi = rho
#include "tetrapore/lbm/held_fluids.hpp"

using namespace tetrapore::lbm;
using held = held_fluids<double, mixture<d3q19, bgk, velocity_shift, exponential_potential>, storage::in_place>;
static_assert(sizeof(held) > 0);
