// SPDX-License-Identifier: BSD-3-Clause
// The surface tension has no default.
#include "tetrapore/law/bridge/lambert.hpp"

tetrapore::lambert<> law{.surface_tension = 0.072, .contact_angle = 0.3};
