# SPDX-License-Identifier: BSD-3-Clause
#
# What tests, examples and benchmarks share. Nothing here reaches a user of the library.

# Warnings, as errors.
add_library(tetrapore_developer INTERFACE)
target_compile_options(tetrapore_developer INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # g++ 12 sees an overlap in std::string's operator+ that is not there (GCC bug 105651, mended in 13).
  target_compile_options(tetrapore_developer INTERFACE -Wno-restrict)
endif()
target_link_libraries(tetrapore_developer INTERFACE tetrapore::core)

# Finds a package or says which Debian package has it.
macro(tetrapore_require_package package target debian)
  if(NOT TARGET ${target})
    find_package(${package} QUIET)
  endif()
  if(NOT TARGET ${target})
    message(FATAL_ERROR
      "tetrapore: ${package} was not found. On Debian: apt-get install ${debian}. "
      "Needed by ${CMAKE_CURRENT_SOURCE_DIR}; turn that part off with TETRAPORE_BUILD_TESTS, TETRAPORE_BUILD_EXAMPLES "
      "or TETRAPORE_BUILD_BENCHMARKS, or let tests/run.sh install what is missing.")
  endif()
endmacro()

# What a program links follows from what its sources include, through our own headers: one row per dependency, the start
# of the included name (a regular expression), then nothing for a component of tetrapore; a package, its target and its
# Debian package; or a target of our own, with the function tetrapore_add_<target> that makes it.
set(tetrapore_dependency_rows cgal eigen cholmod cli png eigen_oracle compiled_triangulation)
set(tetrapore_dependency_cgal "tetrapore/tessellation/cgal\\.hpp")
set(tetrapore_dependency_eigen "tetrapore/solver/eigen\\.hpp")
set(tetrapore_dependency_cholmod "tetrapore/solver/cholmod\\.hpp")
set(tetrapore_dependency_cli "CLI/" CLI11 CLI11::CLI11 libcli11-dev)
set(tetrapore_dependency_png "png\\.h" PNG PNG::PNG libpng-dev)
set(tetrapore_dependency_eigen_oracle "Eigen/" Eigen3 Eigen3::Eigen libeigen3-dev)
set(tetrapore_dependency_compiled_triangulation "support/compiled_triangulation\\.hpp" compiled_triangulation)

# CGAL compiled once for all tests and benchmarks that only want a network.
function(tetrapore_add_compiled_triangulation)
  if(NOT TARGET compiled_triangulation)
    tetrapore_require_component(cgal)
    add_library(compiled_triangulation STATIC "${PROJECT_SOURCE_DIR}/tests/support/compiled_triangulation.cpp")
    target_link_libraries(compiled_triangulation PRIVATE tetrapore_developer tetrapore::cgal)
    target_include_directories(compiled_triangulation PRIVATE "${PROJECT_SOURCE_DIR}/tests")
  endif()
endfunction()

function(tetrapore_collect_includes file out seen_out)
  set(names "${${out}}")
  set(seen "${${seen_out}}")
  if(NOT file IN_LIST seen)
    list(APPEND seen "${file}")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
    cmake_path(GET file PARENT_PATH folder)
    file(STRINGS "${file}" lines REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "^[^<\"]*[<\"]([^>\"]*)[>\"].*" "\\1" name "${line}")
      list(APPEND names "${name}")
      foreach(base "${folder}" "${PROJECT_SOURCE_DIR}" "${PROJECT_SOURCE_DIR}/tests" "${PROJECT_SOURCE_DIR}/benchmarks"
                   "${PROJECT_SOURCE_DIR}/examples")
        if(EXISTS "${base}/${name}" AND NOT IS_DIRECTORY "${base}/${name}")
          cmake_path(ABSOLUTE_PATH name BASE_DIRECTORY "${base}" NORMALIZE OUTPUT_VARIABLE path)
          tetrapore_collect_includes("${path}" names seen)
          break()
        endif()
      endforeach()
    endforeach()
  endif()
  set(${out} "${names}" PARENT_SCOPE)
  set(${seen_out} "${seen}" PARENT_SCOPE)
endfunction()

# Our own program: warnings as errors, and the dependencies that its sources include.
function(tetrapore_program target)
  target_link_libraries(${target} PRIVATE tetrapore_developer)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  get_target_property(sources ${target} SOURCES)
  set(names "")
  set(seen "")
  foreach(source IN LISTS sources)
    if(NOT source MATCHES "^\\$")
      cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
      tetrapore_collect_includes("${source}" names seen)
    endif()
  endforeach()
  foreach(row IN LISTS tetrapore_dependency_rows)
    set(rule ${tetrapore_dependency_${row}})
    list(POP_FRONT rule pattern)
    if(NOT "${names}" MATCHES "(^|;)${pattern}")
      continue()
    endif()
    list(LENGTH rule parts)
    if(parts EQUAL 1)
      cmake_language(CALL tetrapore_add_${rule})
      target_link_libraries(${target} PRIVATE ${rule})
    elseif(parts EQUAL 3)
      list(GET rule 0 package)
      list(GET rule 1 library)
      list(GET rule 2 debian)
      tetrapore_require_package(${package} ${library} ${debian})
      target_link_libraries(${target} PRIVATE ${library})
    else()
      tetrapore_require_component(${row})
      target_link_libraries(${target} PRIVATE tetrapore::${row})
    endif()
  endforeach()
endfunction()
