// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \file
/// Layer 1: areas, volumes, solid angles, power centres, inscribed circles and spheres.

#include "tetrapore/geometry/area.hpp"
#include "tetrapore/geometry/ball_volume.hpp"
#include "tetrapore/geometry/disc_area.hpp"
#include "tetrapore/geometry/domain.hpp"
#include "tetrapore/geometry/inscribed.hpp"
#include "tetrapore/geometry/polyhedron.hpp"
#include "tetrapore/geometry/power_centre.hpp"
#include "tetrapore/geometry/primitives.hpp"
#include "tetrapore/geometry/solid_angle.hpp"
#include "tetrapore/geometry/status.hpp"
