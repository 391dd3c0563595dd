// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \file
/// Everything of layer 4: the pore network and its fields.

#include "tetrapore/network/clusters.hpp"
#include "tetrapore/network/connect.hpp"
#include "tetrapore/network/edges.hpp"
#include "tetrapore/network/field.hpp"
#include "tetrapore/network/gather.hpp"
#include "tetrapore/network/gather_opening.hpp"
#include "tetrapore/network/make_network.hpp"
#include "tetrapore/network/measure.hpp"
#include "tetrapore/network/network.hpp"
#include "tetrapore/network/solid.hpp"
#include "tetrapore/network/transfer.hpp"
#include "tetrapore/network/validate.hpp"
