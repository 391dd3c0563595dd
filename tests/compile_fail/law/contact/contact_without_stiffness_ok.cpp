// SPDX-License-Identifier: BSD-3-Clause
// The stiffnesses have no default.
#include "tetrapore/law/contact/dry_contact.hpp"

tetrapore::dry_contact law{.normal_stiffness = 1e5, .shear_stiffness = 1e5, .friction = 0.5};
