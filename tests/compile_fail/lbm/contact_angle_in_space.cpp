// SPDX-License-Identifier: BSD-3-Clause
// A meniscus between plates is computed in the plane.
// expect: a meniscus between plates is computed in the plane
#include "tetrapore/lbm/contact_angle.hpp"

using namespace tetrapore::lbm;
const auto measure = contact_angle<mixture<d3q19, bgk>>;
