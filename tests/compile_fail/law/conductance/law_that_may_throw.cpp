// SPDX-License-Identifier: BSD-3-Clause
// A law is noexcept: a driver calls it in the middle of a loop.
// expect: conductance\(t\). (is not .noexcept|may throw)
#include "tetrapore/law/conductance/concept.hpp"

using answer = tetrapore::outcome<double, tetrapore::conductance_status>;

struct mine {
  answer conductance(const tetrapore::throat<double>&) const { return {1.0, tetrapore::conductance_status::ok}; }
};
static_assert(tetrapore::conductance_law<mine>);
