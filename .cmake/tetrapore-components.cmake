# SPDX-License-Identifier: BSD-3-Clause
#
# The components: each adds one dependency to tetrapore::core. One row per component, read by the build of the project
# and, installed beside tetrapore-config.cmake, by whoever uses it:
#
#   tetrapore_component_<name>  header  package  target  Debian-package  licence
#
# `header`, below include/tetrapore/, is the only file that includes the dependency. A component whose header is not
# there does not exist.
#
# tetrapore::cgal carries exactly what CGAL's own target exports, and on g++ that is -frounding-math: CGAL switches the
# rounding mode of the processor for its interval arithmetic, and code compiled without the flag may move operations
# across the switch and return wrong signs. The flag also slows every other loop of a translation unit (by 22 % in a
# lattice-Boltzmann collision), so link tetrapore::cgal to the one source file that builds the network (an object
# library, say) and the rest of a program to tetrapore::core.

set(tetrapore_component_cgal "tessellation/cgal.hpp" CGAL CGAL::CGAL libcgal-dev "GPL-3.0-or-later (or commercial)")
set(tetrapore_component_eigen "solver/eigen.hpp" Eigen3 Eigen3::Eigen libeigen3-dev "MPL-2.0")
set(tetrapore_component_cholmod "solver/cholmod.hpp" CHOLMOD SuiteSparse::CHOLMOD "libsuitesparse-dev libopenblas-dev"
  "GPL-2.0-or-later (CHOLMOD's Supernodal and Modify modules)")

set(tetrapore_known_components cgal eigen cholmod)

# Our find modules lie beside this file, in the sources and where it is installed.
set(tetrapore_module_dir "${CMAKE_CURRENT_LIST_DIR}")

# Keeps the components whose header exists below `include_dir`.
function(tetrapore_list_components include_dir out)
  set(found "")
  foreach(name IN LISTS tetrapore_known_components)
    list(GET tetrapore_component_${name} 0 header)
    if(EXISTS "${include_dir}/tetrapore/${header}")
      list(APPEND found ${name})
    endif()
  endforeach()
  set(${out} "${found}" PARENT_SCOPE)
endfunction()

# Finds the package of a component. A macro, so that what the package sets reaches the caller; `error` is empty, or says
# what is missing and how to get it.
macro(tetrapore_find_component name available error)
  set(${error} "")
  if(NOT "${name}" IN_LIST ${available})
    set(${error} "there is no component '${name}'; there are: core;${${available}}")
  else()
    list(GET tetrapore_component_${name} 1 _tetrapore_package)
    list(GET tetrapore_component_${name} 2 _tetrapore_target)
    list(GET tetrapore_component_${name} 3 _tetrapore_debian)
    if(NOT TARGET ${_tetrapore_target})
      list(APPEND CMAKE_MODULE_PATH "${tetrapore_module_dir}")
      find_package(${_tetrapore_package} QUIET)
      list(POP_BACK CMAKE_MODULE_PATH)
    endif()
    if(NOT TARGET ${_tetrapore_target})
      set(${error} "component '${name}' needs ${_tetrapore_package}, which was not found. On Debian: apt-get install ${_tetrapore_debian}. Elsewhere: name its prefix in CMAKE_PREFIX_PATH. Without the component, ask for COMPONENTS core.")
    endif()
    unset(_tetrapore_package)
    unset(_tetrapore_target)
    unset(_tetrapore_debian)
  endif()
endmacro()
