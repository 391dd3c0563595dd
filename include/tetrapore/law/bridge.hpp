// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \file
/// What a bridge law is, and the exact one. Headers of their own, so that this one stays small:
/// law/bridge/closed_forms.hpp and law/bridge/table.hpp.
/// \par Source  each header names its own; what they share: Chareyre et al. 2017, §2.3, Eq. (4)

#include "tetrapore/law/bridge/concept.hpp"
#include "tetrapore/law/bridge/young_laplace.hpp"
