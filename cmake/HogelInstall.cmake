# SPDX-License-Identifier: Apache-2.0
# cmake --install: the library, its public headers, the command line, and a package that find_package(hogel) finds.
# cpack makes a Debian package of the same.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS hogel EXPORT hogelTargets)
if(TARGET hogel_cli)
  install(TARGETS hogel_cli)
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/hogel ${PROJECT_BINARY_DIR}/include/hogel
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/hogel)
install(EXPORT hogelTargets NAMESPACE hogel:: DESTINATION ${package_dir})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/hogelConfig.cmake.in ${PROJECT_BINARY_DIR}/hogelConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/hogelConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/hogelConfig.cmake ${PROJECT_BINARY_DIR}/hogelConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/cmake/HogelDependencies.cmake
        DESTINATION ${package_dir})

if(PROJECT_IS_TOP_LEVEL)
  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGE_NAME hogel)
  set(CPACK_PACKAGE_VENDOR "the hogel project")
  set(CPACK_PACKAGE_CONTACT "the hogel project")
  set(CPACK_DEBIAN_PACKAGE_MAINTAINER "the hogel project")
  set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
  include(CPack)
endif()
