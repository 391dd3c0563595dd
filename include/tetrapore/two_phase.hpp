// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \file
/// Everything of two-phase flow: drainage, trapping, retention curves.

#include "tetrapore/two_phase/drainage.hpp"
#include "tetrapore/two_phase/entry_rule.hpp"
#include "tetrapore/two_phase/face_set.hpp"
#include "tetrapore/two_phase/facet_rule.hpp"
#include "tetrapore/two_phase/interfacial_area.hpp"
#include "tetrapore/two_phase/retention_curve.hpp"
#include "tetrapore/two_phase/state.hpp"
#include "tetrapore/two_phase/state_file.hpp"
#include "tetrapore/two_phase/trapping.hpp"
#include "tetrapore/two_phase/van_genuchten.hpp"
