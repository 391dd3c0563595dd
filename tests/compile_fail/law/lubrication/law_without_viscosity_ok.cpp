// SPDX-License-Identifier: BSD-3-Clause
// The viscosity has no default.
#include "tetrapore/law/lubrication/two_spheres.hpp"

tetrapore::two_spheres law{1e-3};
