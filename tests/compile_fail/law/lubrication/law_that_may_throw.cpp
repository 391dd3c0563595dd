// SPDX-License-Identifier: BSD-3-Clause
// A law is noexcept: a step of a simulator calls it in the middle of a loop.
// expect: resistance\(e\). (is not .noexcept|may throw)
#include "tetrapore/law/lubrication/concept.hpp"

using answer = tetrapore::outcome<tetrapore::pair_resistance<double>, tetrapore::pair_status>;

struct mine {
  answer resistance(const tetrapore::edge<double>&) const { return {{}, tetrapore::pair_status::ok}; }
};
static_assert(tetrapore::lubrication_law<mine>);
