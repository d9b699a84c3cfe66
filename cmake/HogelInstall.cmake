# cmake --install: the library, its headers, the command line, and a package that find_package(hogel) finds.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS hogel EXPORT hogelTargets)
install(TARGETS hogel_cli)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/hogel DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h" PATTERN "*_internal.h" EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/hogel)
install(EXPORT hogelTargets NAMESPACE hogel:: DESTINATION ${package_dir})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/hogelConfig.cmake.in ${PROJECT_BINARY_DIR}/hogelConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/hogelConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/hogelConfig.cmake ${PROJECT_BINARY_DIR}/hogelConfigVersion.cmake
        DESTINATION ${package_dir})
