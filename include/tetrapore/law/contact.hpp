// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \file
/// All contact laws.
/// \par Source  each header names its own; what they share: Cundall & Strack 1979; Chareyre et al. 2017, §2.2

#include "tetrapore/law/contact/concept.hpp"
#include "tetrapore/law/contact/dry_contact.hpp"
#include "tetrapore/law/contact/wet_contact.hpp"
