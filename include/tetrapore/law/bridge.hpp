// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \file
/// The exact bridge law and the closed forms. Headers of their own, so that this one stays small: law/bridge/table.hpp
/// and law/bridge/toroid.hpp.

#include "tetrapore/law/bridge/closed_form.hpp"
#include "tetrapore/law/bridge/concept.hpp"
#include "tetrapore/law/bridge/lambert.hpp"
#include "tetrapore/law/bridge/mikami.hpp"
#include "tetrapore/law/bridge/rabinovich.hpp"
#include "tetrapore/law/bridge/rupture_fits.hpp"
#include "tetrapore/law/bridge/soulie.hpp"
#include "tetrapore/law/bridge/weigert_ripperger.hpp"
#include "tetrapore/law/bridge/willett.hpp"
#include "tetrapore/law/bridge/young_laplace.hpp"
