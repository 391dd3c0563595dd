# SPDX-License-Identifier: BSD-3-Clause
#
# CHOLMOD of SuiteSparse as the target SuiteSparse::CHOLMOD, the name that SuiteSparse ≥ 7 gives it. Older releases, Debian
# 12's among them, install no CMake configuration: there, the header and the library.

find_package(CHOLMOD CONFIG QUIET)
if(TARGET SuiteSparse::CHOLMOD)
  set(CHOLMOD_FOUND TRUE)
  return()
endif()

find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(CHOLMOD_LIBRARY cholmod)
find_library(CHOLMOD_CONFIG_LIBRARY suitesparseconfig)  # whose settings a program may reach
mark_as_advanced(CHOLMOD_INCLUDE_DIR CHOLMOD_LIBRARY CHOLMOD_CONFIG_LIBRARY)
if(CHOLMOD_INCLUDE_DIR AND EXISTS "${CHOLMOD_INCLUDE_DIR}/cholmod_core.h")
  foreach(part MAIN SUB SUBSUB)
    file(STRINGS "${CHOLMOD_INCLUDE_DIR}/cholmod_core.h" line REGEX "^#define CHOLMOD_${part}_VERSION +[0-9]+")
    string(REGEX REPLACE ".* " "" version_${part} "${line}")
  endforeach()
  set(CHOLMOD_VERSION "${version_MAIN}.${version_SUB}.${version_SUBSUB}")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CHOLMOD
  REQUIRED_VARS CHOLMOD_LIBRARY CHOLMOD_CONFIG_LIBRARY CHOLMOD_INCLUDE_DIR VERSION_VAR CHOLMOD_VERSION)
if(CHOLMOD_FOUND)
  add_library(SuiteSparse::CHOLMOD UNKNOWN IMPORTED)
  set_target_properties(SuiteSparse::CHOLMOD PROPERTIES
    IMPORTED_LOCATION "${CHOLMOD_LIBRARY}"
    INTERFACE_LINK_LIBRARIES "${CHOLMOD_CONFIG_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${CHOLMOD_INCLUDE_DIR}")
endif()
