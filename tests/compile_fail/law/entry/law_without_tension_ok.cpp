// SPDX-License-Identifier: BSD-3-Clause
// The surface tension has no default.
#include "tetrapore/law/entry/mayer_stowe_princen.hpp"

tetrapore::mayer_stowe_princen law{.surface_tension = 0.072, .contact_angle = 0.3};
