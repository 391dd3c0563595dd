// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \file
/// All conductance laws.
/// \par Source  each header names its own; what they share: Chareyre et al. 2017, §2.2

#include "tetrapore/law/conductance/calibrated.hpp"
#include "tetrapore/law/conductance/concept.hpp"
#include "tetrapore/law/conductance/darcy.hpp"
#include "tetrapore/law/conductance/hydraulic_radius.hpp"
#include "tetrapore/law/conductance/mean_radius.hpp"
