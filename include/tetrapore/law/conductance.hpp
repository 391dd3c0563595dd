// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \file
/// All conductance laws.

#include "tetrapore/law/conductance/calibrated.hpp"
#include "tetrapore/law/conductance/concept.hpp"
#include "tetrapore/law/conductance/darcy.hpp"
#include "tetrapore/law/conductance/hydraulic_radius.hpp"
#include "tetrapore/law/conductance/mean_radius.hpp"
