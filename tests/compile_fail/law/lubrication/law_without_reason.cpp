// SPDX-License-Identifier: BSD-3-Clause
// A resistance comes with its reason, never alone.
// expect: resistance\(e\). does not satisfy return-type-requirement|same_as<tetrapore::pair_resistance<double>, outcome<
#include "tetrapore/law/lubrication/concept.hpp"

using answer = tetrapore::outcome<tetrapore::pair_resistance<double>, tetrapore::pair_status>;

struct mine {
  answer all(const tetrapore::edge<double>&) const noexcept { return {{}, tetrapore::pair_status::ok}; }
  auto resistance(const tetrapore::edge<double>& e) const noexcept { return all(e).value; }
};
static_assert(tetrapore::lubrication_law<mine>);
