// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \file
/// All lubrication laws.
/// \par Source  each header names its own; what they share: Chareyre et al. 2017, §2.2, Eq. (2) and (3)

#include "tetrapore/law/lubrication/apply.hpp"
#include "tetrapore/law/lubrication/concept.hpp"
#include "tetrapore/law/lubrication/film.hpp"
#include "tetrapore/law/lubrication/leading_order.hpp"
#include "tetrapore/law/lubrication/rough.hpp"
#include "tetrapore/law/lubrication/sphere_plane.hpp"
#include "tetrapore/law/lubrication/two_spheres.hpp"
