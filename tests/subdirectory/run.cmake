# SPDX-License-Identifier: Apache-2.0
# Configures the project beside this file. With HOGEL_BUILD_SUBDIRECTORY=1 in the environment, as in `./dev ci`, it is
# also built with the minimal library, without optimisation, and run; with HOGEL_THOROUGH=1 too, with the whole library.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed with ${status}: ${ARGV}\n${output}")
  endif()
endfunction()

set(launcher)
find_program(CCACHE ccache)
if(CCACHE)
  set(ENV{CCACHE_BASEDIR} ${SOURCE_DIR})
  set(ENV{CCACHE_SLOPPINESS} pch_defines,time_macros)
  set(launcher -D CMAKE_CXX_COMPILER_LAUNCHER=${CCACHE})
endif()
set(configure ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK_DIR} -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${CXX} ${launcher}
    -D "CMAKE_CXX_FLAGS=-O0 -g0" -D CMAKE_UNITY_BUILD=ON -D HOGEL_SOURCE_DIR=${SOURCE_DIR} -D BUILD_SHARED_LIBS=OFF)
run(${configure} -D HOGEL_MINIMAL=OFF)
if(NOT "$ENV{HOGEL_BUILD_SUBDIRECTORY}" STREQUAL "1")
  return()
endif()
if(NOT "$ENV{HOGEL_THOROUGH}" STREQUAL "1")
  run(${configure} -D HOGEL_MINIMAL=ON)
endif()
run(${CMAKE_COMMAND} --build ${WORK_DIR} --parallel 2 --target contains_hogel)
run(${WORK_DIR}/contains_hogel)
