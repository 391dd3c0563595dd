// SPDX-License-Identifier: BSD-3-Clause
// There is a fluid.
#include "tetrapore/lbm/mixture.hpp"

using namespace tetrapore::lbm;
using fluid = mixture<d3q19, bgk, velocity_shift, linear_potential, 1>;
static_assert(sizeof(fluid) > 0);
