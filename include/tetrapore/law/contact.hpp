// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \file
/// All contact laws.

#include "tetrapore/law/contact/concept.hpp"
#include "tetrapore/law/contact/dry_contact.hpp"
#include "tetrapore/law/contact/wet_contact.hpp"
