// SPDX-License-Identifier: BSD-3-Clause
// The storage of moments has a header of its own.
// expect: storage::moments takes #include <tetrapore/lbm/moments\.hpp>
#include "tetrapore/lbm/simulation.hpp"

using namespace tetrapore::lbm;
using kept = simulation<mixture<d3q19, bgk>, double, storage::moments>;
static_assert(sizeof(kept) > 0);
