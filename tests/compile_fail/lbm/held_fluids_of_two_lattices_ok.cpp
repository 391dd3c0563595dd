// SPDX-License-Identifier: BSD-3-Clause
// The state of fluids that are held is kept, which two lattices would double.
#include "tetrapore/lbm/held_fluids.hpp"

using namespace tetrapore::lbm;
using held = held_fluids<double, mixture<d3q19, bgk>, storage::in_place>;
static_assert(sizeof(held) > 0);
