// SPDX-License-Identifier: BSD-3-Clause
// Asperities are added to a lubrication law; a film in series with a spring is none.
// expect: required expression .*resistance\(e\). is invalid|resistance\(e\). would be invalid: no matching
#include "tetrapore/law/lubrication/film.hpp"
#include "tetrapore/law/lubrication/rough.hpp"
#include "tetrapore/law/lubrication/two_spheres.hpp"

static_assert(tetrapore::lubrication_law<tetrapore::rough<tetrapore::film_scheme>>);
