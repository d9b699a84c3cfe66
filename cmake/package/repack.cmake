# SPDX-License-Identifier: Apache-2.0
# Run by cpack after it has packed the tarball: packs it again, because cpack takes files in the order of the file system.
set(dates)
if(DEFINED ENV{SOURCE_DATE_EPOCH})
  set(dates --mtime=@$ENV{SOURCE_DATE_EPOCH})
endif()
cmake_path(GET CPACK_TEMPORARY_INSTALL_DIRECTORY PARENT_PATH parent)
cmake_path(GET CPACK_TEMPORARY_INSTALL_DIRECTORY FILENAME name)
execute_process(COMMAND tar --create --sort=name --format=gnu --owner=root:0 --group=root:0 --mode=u+rw,go+r,go-w ${dates} -C ${parent} ${name}
                COMMAND gzip -9n OUTPUT_FILE ${CPACK_PACKAGE_FILES} COMMAND_ERROR_IS_FATAL ANY)
