// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \file
/// All conductance laws.

#include "tetrapore/law/conductance/concept.hpp"
#include "tetrapore/law/conductance/hydraulic_radius.hpp"
