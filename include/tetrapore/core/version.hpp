// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \file
/// The version of tetrapore. These three macros are its only source: CMake reads them from here.

#define TETRAPORE_VERSION_MAJOR 0
#define TETRAPORE_VERSION_MINOR 1
#define TETRAPORE_VERSION_PATCH 0
