# SPDX-License-Identifier: Apache-2.0
# Run by cpack between installing into its own folder and packing that: puts the libraries that hogel needs there too.
execute_process(COMMAND python3 ${CMAKE_CURRENT_LIST_DIR}/carry_libraries.py ${CPACK_TEMPORARY_INSTALL_DIRECTORY}
                COMMAND_ERROR_IS_FATAL ANY)
