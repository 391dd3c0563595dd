// SPDX-License-Identifier: BSD-3-Clause
// Moments tell what a node sends where its collision ends at the equilibrium, without a source.
#include "tetrapore/lbm/moments.hpp"

using namespace tetrapore::lbm;
using fluids = mixture<d3q19, bgk, velocity_shift>;
using kept = simulation<fluids, double, storage::moments>;
static_assert(sizeof(kept) > 0);
