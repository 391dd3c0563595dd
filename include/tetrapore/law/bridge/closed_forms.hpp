// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \file
/// All closed forms of a bridge. \par Source  each names its own

#include "tetrapore/law/bridge/closed_form.hpp"
#include "tetrapore/law/bridge/lambert.hpp"
#include "tetrapore/law/bridge/mikami.hpp"
#include "tetrapore/law/bridge/rabinovich.hpp"
#include "tetrapore/law/bridge/rupture_fits.hpp"
#include "tetrapore/law/bridge/soulie.hpp"
#include "tetrapore/law/bridge/toroid.hpp"
#include "tetrapore/law/bridge/weigert_ripperger.hpp"
#include "tetrapore/law/bridge/willett.hpp"
