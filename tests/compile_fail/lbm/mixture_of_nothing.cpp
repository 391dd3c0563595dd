// SPDX-License-Identifier: BSD-3-Clause
// There is a fluid.
// expect: a mixture has at least one component
#include "tetrapore/lbm/mixture.hpp"

using namespace tetrapore::lbm;
using fluid = mixture<d3q19, bgk, velocity_shift, linear_potential, 0>;
static_assert(sizeof(fluid) > 0);
