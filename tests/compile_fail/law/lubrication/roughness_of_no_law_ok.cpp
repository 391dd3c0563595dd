// SPDX-License-Identifier: BSD-3-Clause
// Asperities are added to a lubrication law; a film in series with a spring is none.
#include "tetrapore/law/lubrication/film.hpp"
#include "tetrapore/law/lubrication/rough.hpp"
#include "tetrapore/law/lubrication/two_spheres.hpp"

static_assert(tetrapore::lubrication_law<tetrapore::rough<tetrapore::two_spheres>>);
