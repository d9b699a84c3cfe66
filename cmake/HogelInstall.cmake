# SPDX-License-Identifier: Apache-2.0
# cmake --install: the library, its public headers, the command line, and packages that find_package(hogel) and pkg-config
# find. The components are those of the packages that cpack makes (HogelPackage.cmake).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS hogel EXPORT hogelTargets
        LIBRARY COMPONENT library NAMELINK_COMPONENT development
        ARCHIVE COMPONENT development)
if(TARGET hogel_cli)
  install(TARGETS hogel_cli COMPONENT program)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/share/hogel DESTINATION ${CMAKE_INSTALL_DATADIR} COMPONENT program)
  if(TARGET hogel_view)
    install(TARGETS hogel_view COMPONENT program)
  endif()
  if(TARGET hogel_mpi)
    install(TARGETS hogel_mpi COMPONENT program)
  endif()
  # Manual pages say what the program's help says, so that they need a program that runs here.
  if(NOT CMAKE_CROSSCOMPILING AND NOT HOGEL_SANITIZE)
    set(manual ${PROJECT_BINARY_DIR}/manual)
    add_custom_command(
      OUTPUT ${manual}/hogel.1.gz
      COMMAND python3 ${PROJECT_SOURCE_DIR}/cmake/package/manual.py $<TARGET_FILE:hogel_cli> ${manual}
      DEPENDS hogel_cli ${PROJECT_SOURCE_DIR}/cmake/package/manual.py
      COMMENT "Writing manual pages" VERBATIM)
    add_custom_target(hogel_manual ALL DEPENDS ${manual}/hogel.1.gz)
    install(DIRECTORY ${manual}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
    # So do the completions of shells.
    set(completions ${PROJECT_BINARY_DIR}/completions)
    add_custom_command(
      OUTPUT ${completions}/hogel ${completions}/_hogel ${completions}/hogel.fish
      COMMAND ${CMAKE_COMMAND} -E make_directory ${completions}
      COMMAND hogel_cli completion bash > ${completions}/hogel
      COMMAND hogel_cli completion zsh > ${completions}/_hogel
      COMMAND hogel_cli completion fish > ${completions}/hogel.fish
      DEPENDS hogel_cli COMMENT "Writing completions" VERBATIM)
    add_custom_target(hogel_completions ALL DEPENDS ${completions}/hogel)
    install(FILES ${completions}/hogel DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
    install(FILES ${completions}/_hogel DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
    install(FILES ${completions}/hogel.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)
  endif()
endif()
hogel_install_headers(${CMAKE_INSTALL_INCLUDEDIR})

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/hogel)
install(EXPORT hogelTargets NAMESPACE hogel:: DESTINATION ${package_dir} COMPONENT development)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/hogelConfig.cmake.in ${PROJECT_BINARY_DIR}/hogelConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/hogelConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/hogelConfig.cmake ${PROJECT_BINARY_DIR}/hogelConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/cmake/HogelDependencies.cmake
        DESTINATION ${package_dir} COMPONENT development)

# pkg-config knows the shared library alone: a static one passes on what only CMake can find (assimp, Embree).
if(BUILD_SHARED_LIBS)
  file(RELATIVE_PATH prefix_from_pc /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
  string(REGEX REPLACE "/$" "" prefix_from_pc "${prefix_from_pc}")
  configure_file(${PROJECT_SOURCE_DIR}/cmake/hogel.pc.in ${PROJECT_BINARY_DIR}/hogel.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/hogel.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endif()

if(PROJECT_IS_TOP_LEVEL)
  include(HogelPackage)
endif()
if(NOT HOGEL_PACKAGE STREQUAL "debian")  # whose packages have a folder of their own each
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/cmake/package/copyright ${PROJECT_SOURCE_DIR}/CHANGELOG.md
          DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT library)
endif()
