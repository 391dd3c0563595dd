// SPDX-License-Identifier: BSD-3-Clause
// A pair has a past: a law says how it begins.
#include "tetrapore/law/contact/concept.hpp"

using answer = tetrapore::outcome<tetrapore::contact_forces<double>, tetrapore::contact_status>;
using motion = tetrapore::pair_motion<double>;

struct mine {
  double start(const tetrapore::edge<double>& e) const noexcept { return e.gap; }
  answer step(const tetrapore::edge<double>&, const motion&, double, double&) const noexcept {
    return {{}, tetrapore::contact_status::ok};
  }
};
static_assert(tetrapore::contact_law<mine>);
