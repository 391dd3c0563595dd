// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \file
/// Everything of layer 0.

#include "tetrapore/core/contracts.hpp"
#include "tetrapore/core/eliminate.hpp"
#include "tetrapore/core/error.hpp"
#include "tetrapore/core/evaluate.hpp"
#include "tetrapore/core/executor.hpp"
#include "tetrapore/core/ids.hpp"
#include "tetrapore/core/outcome.hpp"
#include "tetrapore/core/real.hpp"
#include "tetrapore/core/required.hpp"
#include "tetrapore/core/vec3.hpp"
#include "tetrapore/core/version.hpp"
