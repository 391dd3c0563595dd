// SPDX-License-Identifier: BSD-3-Clause
// The viscosity has no default.
#include "tetrapore/law/conductance/hydraulic_radius.hpp"

tetrapore::hydraulic_radius law{.viscosity = 1e-3, .factor = 2.0};
