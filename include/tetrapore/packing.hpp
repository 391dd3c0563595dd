// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \file
/// Layer 5, packings: what holds them, what they must satisfy, how they are made and measured.

#include "tetrapore/packing/check.hpp"
#include "tetrapore/packing/close_edges.hpp"
#include "tetrapore/packing/lattice.hpp"
#include "tetrapore/packing/neighbours.hpp"
#include "tetrapore/packing/packing.hpp"
#include "tetrapore/packing/random.hpp"
#include "tetrapore/packing/random_packing.hpp"
#include "tetrapore/packing/sizes.hpp"
#include "tetrapore/packing/statistics.hpp"
#include "tetrapore/packing/tile.hpp"
#include "tetrapore/packing/wrap.hpp"
