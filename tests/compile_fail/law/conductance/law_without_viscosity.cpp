// SPDX-License-Identifier: BSD-3-Clause
// The viscosity has no default.
// expect: use of deleted function .*required|call to deleted constructor of 'required
#include "tetrapore/law/conductance/hydraulic_radius.hpp"

tetrapore::hydraulic_radius law{.factor = 2.0};
