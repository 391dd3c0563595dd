// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \file
/// All entry laws.
/// \par Source  each header names its own; what they share: Chareyre et al. 2017, §2.3

#include "tetrapore/law/entry/concept.hpp"
#include "tetrapore/law/entry/inscribed_circle.hpp"
#include "tetrapore/law/entry/lost_arc.hpp"
#include "tetrapore/law/entry/mayer_stowe_princen.hpp"
#include "tetrapore/law/entry/mirror_sided.hpp"
