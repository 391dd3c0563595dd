// SPDX-License-Identifier: BSD-3-Clause
// A law is noexcept: a step of a simulator calls it in the middle of a loop.
// expect: noexcept.*l\.bridge\(e, g\)|nested requirement .*noexcept
#include "tetrapore/law/bridge/concept.hpp"

using answer = tetrapore::outcome<tetrapore::bridge_pull<double>, tetrapore::bridge_status>;

struct mine {
  answer bridge(const tetrapore::edge<double>&, tetrapore::given_volume<double>) const {
    return {{1.0}, tetrapore::bridge_status::ok};
  }
};
static_assert(tetrapore::bridge_law<mine>);
