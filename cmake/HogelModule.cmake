# SPDX-License-Identifier: Apache-2.0
# hogel_module(NAME [FOLDER path] [USES module...] [PUBLIC header...] [LINKS target...] [COMPLETED_BY module] [TESTED_WITH module])
#   Compiles FOLDER (src/hogel/NAME) and the folders in it, tests aside, into an object library, and records which modules
#   it may include and which public headers (include/hogel/HEADER.h) it implements. Its tests are linked with the modules
#   that it uses; with COMPLETED_BY, a module above it which defines functions that it declares and calls; and with
#   TESTED_WITH, one that implements a public header which the tests use.
function(hogel_module name)
  hogel_record_module(${ARGV})
  if(HOGEL_MINIMAL AND NOT name IN_LIST HOGEL_MINIMAL_MODULES)
    return()
  endif()
  cmake_parse_arguments(arg "" "FOLDER;COMPLETED_BY;TESTED_WITH" "USES;LINKS;PUBLIC" ${ARGN})
  if(NOT arg_FOLDER)
    set(arg_FOLDER src/hogel/${name})
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${arg_FOLDER}/*.cpp ${PROJECT_SOURCE_DIR}/${arg_FOLDER}/*.h)
  get_property(left_out GLOBAL PROPERTY HOGEL_LEFT_OUT)
  foreach(path ${left_out})
    list(FILTER sources EXCLUDE REGEX "/(src/hogel/)?${path}(/|\\.cpp$)")
  endforeach()
  set(tests ${sources})
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
  # Highway includes a source with SIMD code again for each target. The others have names of their own for the same things.
  set(alone ${sources} ${tests})
  list(FILTER alone INCLUDE REGEX "(_simd|/simd_test|/stb|/layouts/[a-z_]+|/showpieces/[a-z_]+|/(render|stereogram|hogel_spectra|exchange|simplex)/[a-z_/]*_test)\\.cpp$")
  set_source_files_properties(${alone} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  # With a precompiled header g++ 12 takes the immediates of AVX-512 for variables where nothing is optimised; and with the
  # address sanitizer it needs minutes to see where each of a hundred vectors ends.
  list(FILTER alone INCLUDE REGEX "(_simd|/simd_test)\\.cpp$")
  set_source_files_properties(${alone} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
  foreach(source ${alone})
    file(RELATIVE_PATH path ${PROJECT_SOURCE_DIR} ${source})
    set_property(SOURCE ${source} APPEND PROPERTY COMPILE_DEFINITIONS HWY_TARGET_INCLUDE="${path}")
  endforeach()
  if(HOGEL_SANITIZE MATCHES "address" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    set_source_files_properties(${alone} PROPERTIES COMPILE_OPTIONS -fno-sanitize-address-use-after-scope)
  endif()
  add_library(hogel_${name} OBJECT ${sources})
  set_target_properties(hogel_${name} PROPERTIES LINKER_LANGUAGE CXX)
  hogel_compile_options(hogel_${name})
  hogel_private_includes(hogel_${name})
  target_link_libraries(hogel_${name} PRIVATE ${arg_LINKS} ${HOGEL_FMT})
  hogel_precompile(hogel_${name} library)
  # For the module's own tests, which then need no module above it to be compiled.
  add_library(hogel_${name}_archive STATIC EXCLUDE_FROM_ALL $<TARGET_OBJECTS:hogel_${name}>)
  set_target_properties(hogel_${name}_archive PROPERTIES LINKER_LANGUAGE CXX)
  target_link_libraries(hogel_${name}_archive PUBLIC ${arg_LINKS} ${HOGEL_FMT})
  # Static libraries may need each other.
  foreach(used ${arg_USES} ${arg_COMPLETED_BY})
    target_link_libraries(hogel_${name}_archive PUBLIC hogel_${used}_archive)
  endforeach()
  set_property(GLOBAL APPEND PROPERTY HOGEL_MODULES ${name})
  set_property(GLOBAL APPEND PROPERTY HOGEL_LINKS ${arg_LINKS})
  set_property(GLOBAL PROPERTY HOGEL_TESTS_${name} ${tests})
  set_property(GLOBAL PROPERTY HOGEL_TESTED_WITH_${name} ${arg_TESTED_WITH})
  set_property(GLOBAL APPEND PROPERTY HOGEL_BUILT_HEADERS ${arg_PUBLIC})
endfunction()

# The row of a module in the table that cmake/check_includes.py reads, which holds those too that are not built.
function(hogel_record_module name)
  cmake_parse_arguments(arg "" "FOLDER;COMPLETED_BY;TESTED_WITH" "USES;LINKS;PUBLIC" ${ARGN})
  if(NOT arg_FOLDER)
    set(arg_FOLDER src/hogel/${name})
  endif()
  list(JOIN arg_USES "," uses)
  list(JOIN arg_PUBLIC "," public)
  set_property(GLOBAL APPEND_STRING PROPERTY HOGEL_MODULE_TABLE "${name}:${arg_FOLDER}:${uses}:${public}\n")
endfunction()

# hogel_part(NAME path... [INSTEAD path...])
#   Compiles the sources or folders of these names only if HOGEL_NAME is on, and the others only if it is off. A name is a
#   regular expression, below src/hogel or the project's folder, and without .cpp. Comes before the modules.
function(hogel_part name)
  cmake_parse_arguments(arg "" "" "INSTEAD" ${ARGN})
  if(HOGEL_${name})
    set_property(GLOBAL APPEND PROPERTY HOGEL_LEFT_OUT ${arg_INSTEAD})
  else()
    set_property(GLOBAL APPEND PROPERTY HOGEL_LEFT_OUT ${arg_UNPARSED_ARGUMENTS})
  endif()
endfunction()

# Compiles the device profiles of share/hogel/devices into a module, by the header own_profiles.h.
function(hogel_embed_profiles target)
  file(GLOB files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/share/hogel/devices/*.json)
  foreach(file ${files})
    file(READ ${file} text)
    cmake_path(GET file FILENAME name)
    string(REGEX REPLACE "\\.json$" "" name ${name})
    string(APPEND profiles "    {\"${name}\", R\"json(${text})json\"},\n")
  endforeach()
  set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${files})
  configure_file(${PROJECT_SOURCE_DIR}/src/hogel/core/own_profiles.h.in ${PROJECT_BINARY_DIR}/embedded/own_profiles.h @ONLY)
  target_include_directories(${target} PRIVATE ${PROJECT_BINARY_DIR}/embedded)
endfunction()

# Tells a source by macros, 1 or 0, which parts there are.
function(hogel_tell_parts source)
  foreach(part ASSIMP DRACO MESHOPT EMBREE HDF5 PICTURES ZLIB TIFF WEBP)
    set_property(SOURCE ${source} APPEND PROPERTY COMPILE_DEFINITIONS HOGEL_${part}=$<BOOL:${HOGEL_${part}}>)
  endforeach()
  set_property(SOURCE ${source} APPEND PROPERTY COMPILE_DEFINITIONS HOGEL_FFTW=$<STREQUAL:${HOGEL_FFT},fftw>)
endfunction()

# What the modules link for text, and what the library links for it. A minimal library contains the compiled part of fmt:
# its objects see the headers as those of a full library do, and core/own_fmt.cpp, which hides what it defines, has the rest.
# Headers of other versions than 9 are used by themselves.
if(HOGEL_MINIMAL)
  find_path(HOGEL_FMT_HEADERS fmt/format-inl.h REQUIRED)
  file(STRINGS ${HOGEL_FMT_HEADERS}/fmt/core.h fmt_9 REGEX "define FMT_VERSION 9")
  add_library(hogel_fmt INTERFACE)
  target_include_directories(hogel_fmt SYSTEM INTERFACE ${HOGEL_FMT_HEADERS})
  if(fmt_9)
    target_compile_definitions(hogel_fmt INTERFACE FMT_SHARED)
    set_source_files_properties(${PROJECT_SOURCE_DIR}/src/hogel/core/own_fmt.cpp PROPERTIES
                                COMPILE_OPTIONS -UFMT_SHARED SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
  else()
    target_compile_definitions(hogel_fmt INTERFACE FMT_HEADER_ONLY)
    set_property(GLOBAL APPEND PROPERTY HOGEL_LEFT_OUT core/own_fmt)
  endif()
  set(HOGEL_FMT hogel_fmt)
  set(HOGEL_LINKED_FMT)
else()
  set(HOGEL_FMT fmt::fmt)
  set(HOGEL_LINKED_FMT fmt::fmt)
endif()

# Installs the public headers that the built modules implement, and a hogel/hogel.h that includes these alone.
function(hogel_install_headers destination)
  if(NOT HOGEL_MINIMAL)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/hogel ${PROJECT_BINARY_DIR}/include/hogel DESTINATION ${destination}
            COMPONENT development FILES_MATCHING PATTERN "*.h")
    return()
  endif()
  get_property(built GLOBAL PROPERTY HOGEL_BUILT_HEADERS)
  list(JOIN built "|" built)
  file(STRINGS ${PROJECT_SOURCE_DIR}/include/hogel/hogel.h lines)
  set(all "")
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "^#include" OR line MATCHES "\"hogel/(version|${built})\\.h\"")
      string(APPEND all "${line}\n")
    endif()
  endforeach()
  file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/installed/hogel.h CONTENT "${all}")
  file(GLOB headers ${PROJECT_SOURCE_DIR}/include/hogel/*.h ${PROJECT_BINARY_DIR}/include/hogel/*.h)
  list(FILTER headers INCLUDE REGEX "/(export|version|${built})\\.h$")
  install(FILES ${headers} ${PROJECT_BINARY_DIR}/installed/hogel.h DESTINATION ${destination}/hogel
          COMPONENT development)
endfunction()

# The compile options of every target of the project.
#   -ffp-contract=off  a product and a sum stay two roundings, so that results do not depend on whether the processor has
#                      fused multiply-add: the same bytes on every machine, and .hgl streams decode alike everywhere
#   on ARM             one SIMD target, NEON, which every 64-bit ARM has. With several, chosen at run time, Highway compiles
#                      NEON for processors with AES, and gcc then inlines no implicit constructor of a struct of vectors;
#                      and vectors of SVE, whose size is known at run time alone, cannot be members of a struct.
#                      TOOLCHAIN_MISS_SYS_AUXV_H is what Highway calls a compiler that cannot choose at run time
#   -Wno-psabi         silences g++'s note that passing SIMD vectors by value changed in GCC 4.6; no such call leaves a file
#   -Wshadow=local     where sources are compiled together, names of one source are no global names of the others; and g++ 12
#                      takes values for uninitialized, and vectors for empty, that are not
function(hogel_compile_options target)
  set(shadow -Wshadow)
  if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    set(shadow -Wshadow=local -Wno-subobject-linkage -Wno-maybe-uninitialized -Wno-stringop-overflow)
  elseif(CMAKE_UNITY_BUILD)
    set(shadow)
  endif()
  target_compile_features(${target} PRIVATE cxx_std_20)
  target_compile_options(${target} PRIVATE -Wall -Wextra ${shadow} -Wnon-virtual-dtor -Wno-psabi -ffp-contract=off
                                           $<$<BOOL:${HOGEL_WERROR}>:-Werror>)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
    target_compile_definitions(${target} PRIVATE TOOLCHAIN_MISS_SYS_AUXV_H
                               "HWY_DISABLED_TARGETS=(HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128)")
  endif()
  # In the build's own folders libraries are found by relative paths, so that no file holds the name of the folder.
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON BUILD_RPATH_USE_ORIGIN ON
                                             CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  hogel_hardening(${target})
  if(HOGEL_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${HOGEL_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    target_link_options(${target} PUBLIC -fsanitize=${HOGEL_SANITIZE})
  endif()
endfunction()

# What dpkg-buildflags gives Debian's packages, and immediate binding. Sanitizers bring checks of their own.
function(hogel_hardening target)
  if(HOGEL_HARDENING AND NOT HOGEL_SANITIZE)
    target_compile_options(${target} PRIVATE -fstack-protector-strong -Wformat -Werror=format-security
                                             $<$<CONFIG:Release,RelWithDebInfo,MinSizeRel>:-U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2>)
    target_link_options(${target} PRIVATE -Wl,-z,relro -Wl,-z,now)
  endif()
endfunction()

# The include path of all modules' headers, for the library itself, its tests and its benchmarks.
function(hogel_private_includes target)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}
                                               ${PROJECT_BINARY_DIR}/include)
endfunction()

# The library that users link, hogel::hogel: all modules together, static or shared by BUILD_SHARED_LIBS, with the public
# headers alone. And hogel_internal, the same objects for the project's own tests and benchmarks, which see every header.
function(hogel_library)
  get_property(modules GLOBAL PROPERTY HOGEL_MODULES)
  get_property(links GLOBAL PROPERTY HOGEL_LINKS)
  list(REMOVE_DUPLICATES links)
  set(objects ${modules})
  list(TRANSFORM objects REPLACE "(.+)" "$<TARGET_OBJECTS:hogel_\\1>")

  add_library(hogel ${objects})
  add_library(hogel::hogel ALIAS hogel)
  set_target_properties(hogel PROPERTIES LINKER_LANGUAGE CXX VERSION ${PROJECT_VERSION}
                                         SOVERSION ${HOGEL_SOVERSION} BUILD_RPATH_USE_ORIGIN ON INSTALL_RPATH "$ORIGIN")
  hogel_hardening(hogel)
  target_compile_features(hogel PUBLIC cxx_std_20)
  target_include_directories(hogel PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                          $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include> $<INSTALL_INTERFACE:include>)
  target_link_libraries(hogel PRIVATE ${links} ${HOGEL_LINKED_FMT})
  if(HOGEL_SANITIZE)
    target_link_options(hogel PUBLIC -fsanitize=${HOGEL_SANITIZE})
  endif()

  add_library(hogel_internal STATIC EXCLUDE_FROM_ALL ${objects})
  set_target_properties(hogel_internal PROPERTIES LINKER_LANGUAGE CXX)
  target_link_libraries(hogel_internal PUBLIC ${links} ${HOGEL_FMT})

  get_property(table GLOBAL PROPERTY HOGEL_MODULE_TABLE)
  file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/module_table.txt CONTENT "${table}")
  add_custom_target(check_includes ALL
    COMMAND python3 ${PROJECT_SOURCE_DIR}/cmake/check_includes.py ${PROJECT_BINARY_DIR}/module_table.txt ${PROJECT_SOURCE_DIR}
    COMMENT "Checking includes against the module table" VERBATIM)
  add_dependencies(hogel check_includes)
endfunction()

# For what runs for moments or only in tests: compiling it takes longer than -O3 would ever save. The library's own objects,
# which the tests are about, are optimised as ever.
function(hogel_compile_quickly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# Compiles the larger headers of other projects once for all targets of a KIND, and TARGET's sources with the result:
#   library  the modules of the library
#   app      the libraries of programs
#   test     tests, which are programs: code for programs and for libraries is compiled with different options
# A header of hogel's own is in none of them, so that a change compiles what includes it and no more; nor one that brings code
# into every source, as CLI11's does with its virtual functions. Sources include what they use all the same: ./dev lint
# compiles each of them by itself.
function(hogel_precompile target kind)
  set(shared hogel_precompiled_${kind})
  if(NOT TARGET ${shared})
    set(headers <algorithm> <array> <cmath> <complex> <filesystem> <functional> <map> <memory> <optional> <span> <string>
                <thread> <variant> <vector>)
    set(links ${HOGEL_FMT})
    file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/${shared}.cpp CONTENT "int main() {}\n")
    if(kind STREQUAL "test")
      add_executable(${shared} EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/${shared}.cpp)
      list(APPEND headers <fstream> <random> <sstream> <gtest/gtest.h>)
      list(APPEND links GTest::gtest)
    else()
      add_library(${shared} OBJECT EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/${shared}.cpp)
      list(APPEND headers <fmt/format.h> <fmt/ranges.h>)
    endif()
    hogel_compile_options(${shared})
    if(NOT kind STREQUAL "library")
      hogel_compile_quickly(${shared})
    endif()
    target_link_libraries(${shared} PRIVATE ${links})
    target_precompile_headers(${shared} PRIVATE ${headers})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${shared})
endfunction()

# A program of the project's own that may use every header: a benchmark, or a test of what crosses modules.
function(hogel_internal_program name)
  add_executable(${name} ${ARGN})
  hogel_compile_options(${name})
  hogel_private_includes(${name})
  target_link_libraries(${name} PRIVATE hogel_internal)
endfunction()

# A program beside hogel, of main.cpp in this folder: hogel_<name>, installed as hogel-<name>, thin over the library
# <library>, with what else it links. Its tests, <name>_tests, see that library.
function(hogel_program_beside name library)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "" "LINKS;TESTS")
  add_executable(hogel_${name} main.cpp)
  set_target_properties(hogel_${name} PROPERTIES OUTPUT_NAME hogel-${name} INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
  hogel_compile_options(hogel_${name})
  hogel_compile_quickly(hogel_${name})
  target_link_libraries(hogel_${name} PRIVATE ${library} ${arg_LINKS})
  if(HOGEL_TESTS)
    add_executable(${name}_tests ${arg_TESTS})
    hogel_compile_options(${name}_tests)
    hogel_compile_quickly(${name}_tests)
    hogel_precompile(${name}_tests test)
    target_link_libraries(${name}_tests PRIVATE ${library} GTest::gtest_main)
    hogel_discover_tests(${name})
  endif()
endfunction()

# The tests of the program <name>_tests. Those whose names begin with SLOW_ get the label slow. Names hold the name or number of
# a test's parameter, not its value, which gtest may print as an address.
function(hogel_discover_tests name)
  include(GoogleTest)
  set(options TEST_PREFIX ${name}. NO_PRETTY_VALUES DISCOVERY_TIMEOUT 60)
  gtest_discover_tests(${name}_tests ${options} TEST_FILTER "-*.SLOW_*")
  gtest_discover_tests(${name}_tests ${options} TEST_FILTER "*.SLOW_*" TEST_LIST ${name}_slow_tests PROPERTIES LABELS slow)
endfunction()

# One test program a module: <module>_tests, from its *_test.cpp.
function(hogel_module_tests)
  get_property(modules GLOBAL PROPERTY HOGEL_MODULES)
  foreach(module ${modules})
    get_property(tests GLOBAL PROPERTY HOGEL_TESTS_${module})
    if(tests)
      add_executable(${module}_tests ${tests})
      hogel_compile_options(${module}_tests)
      hogel_private_includes(${module}_tests)
      hogel_compile_quickly(${module}_tests)
      hogel_precompile(${module}_tests test)
      get_property(other GLOBAL PROPERTY HOGEL_TESTED_WITH_${module})
      if(other)
        target_link_libraries(${module}_tests PRIVATE hogel_${other}_archive)
      endif()
      target_link_libraries(${module}_tests PRIVATE hogel_${module}_archive GTest::gtest_main)
      hogel_discover_tests(${module})
    endif()
  endforeach()
endfunction()
