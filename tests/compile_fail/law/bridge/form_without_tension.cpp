// SPDX-License-Identifier: BSD-3-Clause
// The surface tension has no default.
// expect: use of deleted function .*required|call to deleted constructor of 'required
#include "tetrapore/law/bridge/lambert.hpp"

tetrapore::lambert<> law{.contact_angle = 0.3};
