# cmake --install: the library, its headers, the command line, and a package that find_package(hogel) finds.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS hogel EXPORT hogelTargets)
install(TARGETS hogel_cli)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/src/hogel DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h" PATTERN "*_internal.h" EXCLUDE)
install(FILES ${CMAKE_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/hogel)
install(EXPORT hogelTargets NAMESPACE hogel:: DESTINATION ${package_dir})
configure_package_config_file(${CMAKE_SOURCE_DIR}/cmake/hogelConfig.cmake.in ${CMAKE_BINARY_DIR}/hogelConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${CMAKE_BINARY_DIR}/hogelConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/hogelConfig.cmake ${CMAKE_BINARY_DIR}/hogelConfigVersion.cmake
        DESTINATION ${package_dir})
