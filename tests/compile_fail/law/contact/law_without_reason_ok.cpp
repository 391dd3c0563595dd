// SPDX-License-Identifier: BSD-3-Clause
// Forces come with their reason, never alone.
#include "tetrapore/law/contact/concept.hpp"

using answer = tetrapore::outcome<tetrapore::contact_forces<double>, tetrapore::contact_status>;
using motion = tetrapore::pair_motion<double>;

struct mine {
  double start(const tetrapore::edge<double>& e) const noexcept { return e.gap; }
  answer all() const noexcept { return {{}, tetrapore::contact_status::ok}; }
  auto step(const tetrapore::edge<double>&, const motion&, double, double&) const noexcept { return all(); }
};
static_assert(tetrapore::contact_law<mine>);
