# SPDX-License-Identifier: Apache-2.0
# Installs the build into a fresh prefix, then configures, builds and runs the project beside this file against it, and
# builds the examples, which are run as tests of their own.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed with ${status}: ${ARGV}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(build_project source binary)
  run(${CMAKE_COMMAND} -S ${source} -B ${binary} -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${CXX}
      -D CMAKE_PREFIX_PATH=${WORK_DIR}/prefix ${flags})
  run(${CMAKE_COMMAND} --build ${binary} --parallel 2)
endfunction()

if(SANITIZE)
  set(flags -D CMAKE_CXX_FLAGS=-fsanitize=${SANITIZE})
endif()
file(REMOVE_RECURSE ${WORK_DIR})
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/prefix)
build_project(${PROJECT_DIR} ${WORK_DIR}/build)
run(${WORK_DIR}/build/uses_hogel)
build_project(${EXAMPLES_DIR} ${WORK_DIR}/examples)

# The installed program finds the installed library.
run(${WORK_DIR}/prefix/bin/hogel --version)
if(NOT output MATCHES "^hogel [0-9]+\\.[0-9]+\\.[0-9]+\n$")
  message(FATAL_ERROR "hogel --version printed '${output}'")
endif()
# Only public headers are installed, in one flat folder.
file(GLOB_RECURSE headers RELATIVE ${WORK_DIR}/prefix/include ${WORK_DIR}/prefix/include/*)
foreach(header ${headers})
  if(NOT header MATCHES "^hogel/[a-z_]+\\.h$")
    message(FATAL_ERROR "installed a file that is no public header: ${header}")
  endif()
endforeach()
