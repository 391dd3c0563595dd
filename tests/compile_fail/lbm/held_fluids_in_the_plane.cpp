// SPDX-License-Identifier: BSD-3-Clause
// A meniscus is looked for along z.
// expect: held_fluids: a meniscus is seen along z
#include "tetrapore/lbm/held_fluids.hpp"

using namespace tetrapore::lbm;
using held = held_fluids<double, mixture<d2q9, bgk>, storage::in_place>;
static_assert(sizeof(held) > 0);
