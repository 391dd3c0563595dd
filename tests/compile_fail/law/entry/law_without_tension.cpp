// SPDX-License-Identifier: BSD-3-Clause
// The surface tension has no default.
// expect: use of deleted function .*required|call to deleted constructor of 'required
#include "tetrapore/law/entry/mayer_stowe_princen.hpp"

tetrapore::mayer_stowe_princen law{.contact_angle = 0.3};
