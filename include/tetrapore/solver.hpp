// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \file
/// Everything of the solvers that needs the standard library alone.

#include "tetrapore/solver/concept.hpp"
#include "tetrapore/solver/direct.hpp"
#include "tetrapore/solver/graph.hpp"
#include "tetrapore/solver/hierarchy.hpp"
#include "tetrapore/solver/ldlt.hpp"
#include "tetrapore/solver/multigrid.hpp"
#include "tetrapore/solver/pressure_system.hpp"
#include "tetrapore/solver/rows.hpp"
#include "tetrapore/solver/solve_report.hpp"
