# SPDX-License-Identifier: Apache-2.0
# What cpack makes of a build: with HOGEL_PACKAGE=debian the packages hogel, libhogelN (N is HOGEL_SOVERSION), libhogel-dev and,
# with HOGEL_PYTHON, python3-hogel, to be configured with -DCMAKE_INSTALL_PREFIX=/usr; with HOGEL_PACKAGE=tarball one archive that runs from any folder and brings
# the libraries that hogel needs. The same sources give the same bytes: every date is SOURCE_DATE_EPOCH, from the environment or
# else of the last commit. cmake/package/make.sh makes both.
set(HOGEL_PACKAGE "tarball" CACHE STRING "What cpack makes: debian or tarball")
set_property(CACHE HOGEL_PACKAGE PROPERTY STRINGS debian tarball)
set(HOGEL_MAINTAINER "The hogel authors <maintainers@hogel.invalid>" CACHE STRING "Whom the Debian packages name")

set(date $ENV{SOURCE_DATE_EPOCH})
if(NOT date)
  execute_process(COMMAND git -C ${PROJECT_SOURCE_DIR} log -1 --format=%ct OUTPUT_VARIABLE date ERROR_QUIET
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
endif()
configure_file(${PROJECT_SOURCE_DIR}/cmake/package/date.cmake.in ${PROJECT_BINARY_DIR}/package_date.cmake @ONLY)
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_BINARY_DIR}/package_date.cmake)

set(CPACK_PACKAGE_NAME hogel)
set(CPACK_PACKAGE_VENDOR "the hogel project")
set(CPACK_PACKAGE_CONTACT ${HOGEL_MAINTAINER})
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_THREADS 0)

# One Debian package a component, in Debian's layout of documentation.
function(hogel_debian_package component package section summary)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${summary}
hogel turns a 3D scene into a full-parallax holographic stereogram and
shows, by wave optics, what an eye in front of that hologram would see.
It renders and compresses light fields, makes holograms of them by several
methods, encodes holograms for light modulators and photographs them.\n\n${ARGN}" PARENT_SCOPE)
  set(folder ${CMAKE_INSTALL_DATAROOTDIR}/doc/${package})
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/package/copyright ${PROJECT_BINARY_DIR}/changelog.gz
                ${PROJECT_BINARY_DIR}/changelog.Debian.gz DESTINATION ${folder} COMPONENT ${component})
endfunction()

if(HOGEL_PACKAGE STREQUAL "debian")
  if(NOT BUILD_SHARED_LIBS)
    message(FATAL_ERROR "the Debian packages hold the shared library; configure with BUILD_SHARED_LIBS=ON or HOGEL_PACKAGE=tarball")
  endif()
  find_program(GZIP gzip REQUIRED)
  string(TIMESTAMP debian_date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # SOURCE_DATE_EPOCH's, where it is set
  configure_file(cmake/package/changelog.Debian.in ${PROJECT_BINARY_DIR}/changelog.Debian @ONLY)
  configure_file(CHANGELOG.md ${PROJECT_BINARY_DIR}/changelog COPYONLY)
  execute_process(COMMAND ${GZIP} -9nkf changelog changelog.Debian WORKING_DIRECTORY ${PROJECT_BINARY_DIR}
                  COMMAND_ERROR_IS_FATAL ANY)

  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each has its own
  set(CPACK_DEB_COMPONENT_INSTALL ON)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
  set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${HOGEL_MAINTAINER})
  set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
  set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
  # What each package needs of others, by their libraries; of each other, this very version.
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
  set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
  set(CPACK_COMPONENT_PROGRAM_DEPENDS library)
  set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS library)
  # Programs that others link with the library need at least this version.
  set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
  set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
  # dpkg renews the system's table of libraries by a trigger, as Debian's policy wants; cpack's own scripts do so at once.
  set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/package/triggers)
  set(CPACK_DEBIAN_LIBRARY_PACKAGE_MULTIARCH same)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_MULTIARCH same)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS ffmpeg)
  set(CPACK_COMPONENTS_ALL library development)
  # The system knows where its libraries are.
  set_target_properties(hogel PROPERTIES INSTALL_RPATH "")
  if(TARGET hogel_cli)
    set_target_properties(hogel_cli PROPERTIES INSTALL_RPATH "")
    if(TARGET hogel_view)
      set_target_properties(hogel_view PROPERTIES INSTALL_RPATH "")
    endif()
    if(TARGET hogel_mpi)
      set_target_properties(hogel_mpi PROPERTIES INSTALL_RPATH "")
    endif()
    list(APPEND CPACK_COMPONENTS_ALL program)
  endif()
  if(TARGET _core)
    set_target_properties(_core PROPERTIES INSTALL_RPATH "")
    list(APPEND CPACK_COMPONENTS_ALL python)
    set(CPACK_COMPONENT_PYTHON_DEPENDS library program)
    # The module is compiled for one version of Python.
    math(EXPR next "${Python_VERSION_MINOR} + 1")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
        "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next}), python3-numpy")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib, python3-tqdm, ffmpeg")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${PROJECT_SOURCE_DIR}/cmake/package/python/postinst"
                                                  "${PROJECT_SOURCE_DIR}/cmake/package/python/prerm")
    hogel_debian_package(python python3-hogel python "full-parallax holographic stereograms, Python module"
                         "This package holds the Python module, hogel.")
  endif()
  hogel_debian_package(program hogel graphics "full-parallax holographic stereograms, command line"
                       "This package holds the command line, hogel.")
  hogel_debian_package(library libhogel${HOGEL_SOVERSION} libs "full-parallax holographic stereograms, shared library"
                       "This package holds the shared library.")
  hogel_debian_package(development libhogel-dev libdevel "full-parallax holographic stereograms, development files"
                       "This package holds the headers, and what CMake and pkg-config need\nto find the library.")
elseif(HOGEL_PACKAGE STREQUAL "tarball")
  set(CPACK_GENERATOR TGZ)
  set(CPACK_PACKAGE_FILE_NAME hogel-${PROJECT_VERSION}-linux-${CMAKE_SYSTEM_PROCESSOR})
  set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/package/carry.cmake)
  set(CPACK_POST_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/package/repack.cmake)
else()
  message(FATAL_ERROR "HOGEL_PACKAGE is debian or tarball, not ${HOGEL_PACKAGE}")
endif()
include(CPack)
