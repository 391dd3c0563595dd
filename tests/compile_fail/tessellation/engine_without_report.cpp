// SPDX-License-Identifier: BSD-3-Clause
// An engine answers with the network and what was hidden on the way, not with a network alone.
// expect: does not satisfy return-type-requirement|same_as<.*network, .*tessellation>
#include "tetrapore/tessellation/tessellation.hpp"

struct mine {
  tetrapore::network operator()(std::span<const tetrapore::sphere<double>>, const tetrapore::domain&) const {
    return {};
  }
};
static_assert(tetrapore::tessellation_engine<mine>);
