// SPDX-License-Identifier: BSD-3-Clause
// What runs a loop has a member blocks.
#include "tetrapore/core.hpp"

struct mine {
  template <class F>
  void blocks(std::size_t n, F&& f) const {
    f(std::size_t{0}, n);
  }
};
static_assert(tetrapore::executor<mine>);
