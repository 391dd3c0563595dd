// SPDX-License-Identifier: BSD-3-Clause
// An engine answers with the network and what was hidden on the way, not with a network alone.
#include "tetrapore/tessellation/tessellation.hpp"

struct mine {
  tetrapore::tessellation operator()(std::span<const tetrapore::sphere<double>>, const tetrapore::domain&) const {
    return {};
  }
};
static_assert(tetrapore::tessellation_engine<mine>);
