// SPDX-License-Identifier: BSD-3-Clause
// The stiffnesses have no default.
// expect: use of deleted function .*required|call to deleted constructor of 'required
#include "tetrapore/law/contact/dry_contact.hpp"

tetrapore::dry_contact law{.normal_stiffness = 1e5, .friction = 0.5};
