// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \file
/// Layer 2: edge, throat, opening, pore body.

#include "tetrapore/simplex/edge.hpp"
#include "tetrapore/simplex/make_opening.hpp"
#include "tetrapore/simplex/opening.hpp"
#include "tetrapore/simplex/pair_store.hpp"
#include "tetrapore/simplex/pore_body.hpp"
#include "tetrapore/simplex/pore_volume.hpp"
#include "tetrapore/simplex/throat.hpp"
#include "tetrapore/simplex/throat_geometry.hpp"
#include "tetrapore/simplex/throat_hydraulics.hpp"
