// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \file
/// Everything of one-phase flow: pressure, forces on the grains, permeability, grains that move.

#include "tetrapore/one_phase/cell_size.hpp"
#include "tetrapore/one_phase/conditions.hpp"
#include "tetrapore/one_phase/conductances.hpp"
#include "tetrapore/one_phase/coupling.hpp"
#include "tetrapore/one_phase/drag_bounds.hpp"
#include "tetrapore/one_phase/flow.hpp"
#include "tetrapore/one_phase/flow_system.hpp"
#include "tetrapore/one_phase/forces.hpp"
#include "tetrapore/one_phase/nodes.hpp"
#include "tetrapore/one_phase/permeability.hpp"
#include "tetrapore/one_phase/volume_rates.hpp"
