// SPDX-License-Identifier: BSD-3-Clause
// The viscosity has no default.
// expect: use of deleted function .*required|call to deleted constructor of 'required
#include "tetrapore/law/lubrication/two_spheres.hpp"

tetrapore::two_spheres law{};
