# SPDX-License-Identifier: BSD-3-Clause
#
# cmake -D case=… -D source=… -D build=… -D scratch=… -D compiler=… -D generator=… -P check.cmake
#
# `install` puts a copy into scratch/prefix; every other case is a user's project that takes tetrapore in one way. What a
# case may not see is hidden from find_package.

set(prefix "${scratch}/prefix")
set(hidden -D CMAKE_DISABLE_FIND_PACKAGE_CGAL=TRUE -D CMAKE_DISABLE_FIND_PACKAGE_Eigen3=TRUE
  -D CMAKE_DISABLE_FIND_PACKAGE_CHOLMOD=TRUE)
set(installed -D CMAKE_PREFIX_PATH=${prefix} -D way=find_package)
set(in_tree -D TETRAPORE_SOURCE=${source})

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

function(configure)
  file(REMOVE_RECURSE "${scratch}/${case}")
  run("${CMAKE_COMMAND}" -S "${source}/tests/consumer" -B "${scratch}/${case}" -G "${generator}"
    -D CMAKE_CXX_COMPILER=${compiler} -D CMAKE_BUILD_TYPE=Debug ${ARGN})
endfunction()

function(consume)
  configure(${ARGN})
  run("${CMAKE_COMMAND}" --build "${scratch}/${case}")
  run("${scratch}/${case}/consumer")
endfunction()

function(refuse expected)
  file(REMOVE_RECURSE "${scratch}/${case}")
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -S "${source}/tests/consumer" -B "${scratch}/${case}" -G "${generator}"
      -D CMAKE_CXX_COMPILER=${compiler} ${ARGN}
    RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
  string(REGEX REPLACE "[ \n]+" " " said "${said}")
  if(result EQUAL 0)
    message(FATAL_ERROR "the configuration was accepted")
  elseif(NOT said MATCHES "${expected}")
    message(FATAL_ERROR "the message does not say '${expected}' but: ${said}")
  endif()
endfunction()

if(case STREQUAL "install")
  file(REMOVE_RECURSE "${prefix}")
  run("${CMAKE_COMMAND}" --install "${build}" --prefix "${prefix}")
elseif(case STREQUAL "core")
  consume(${installed} ${hidden} -D components=core)
elseif(case STREQUAL "no_list")
  consume(${installed} ${hidden})
elseif(case STREQUAL "cgal")
  consume(${installed} -D components=cgal)
elseif(case STREQUAL "cgal_absent")
  refuse("component 'cgal' needs CGAL.*apt-get install libcgal-dev|there is no component 'cgal'"
    ${installed} ${hidden} -D components=cgal)
elseif(case STREQUAL "eigen")
  consume(${installed} -D components=eigen)
elseif(case STREQUAL "eigen_absent")
  refuse("component 'eigen' needs Eigen3.*apt-get install libeigen3-dev" ${installed} ${hidden} -D components=eigen)
elseif(case STREQUAL "cholmod")
  consume(${installed} -D components=cholmod)
elseif(case STREQUAL "cholmod_absent")
  refuse("component 'cholmod' needs CHOLMOD.*apt-get install libsuitesparse-dev libopenblas-dev"
    ${installed} ${hidden} -D components=cholmod)
elseif(case STREQUAL "subdirectory_cholmod")
  consume(${in_tree} -D way=add_subdirectory -D components=cholmod)
elseif(case STREQUAL "unknown_component")
  refuse("there is no component 'alchemy'" ${installed} -D components=alchemy)
elseif(case STREQUAL "subdirectory")
  consume(${in_tree} ${hidden} -D way=add_subdirectory)
elseif(case STREQUAL "subdirectory_cgal")
  configure(${in_tree} -D way=add_subdirectory -D components=cgal)
elseif(case STREQUAL "fetch_content")
  consume(${in_tree} ${hidden} -D way=FetchContent)
else()
  message(FATAL_ERROR "no case '${case}'")
endif()
