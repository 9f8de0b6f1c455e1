# SPDX-License-Identifier: LGPL-3.0-or-later
# `cmake --install`: program, library, headers and the package another project finds.
include(CMakePackageConfigHelpers)

install(TARGETS rubato_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/rubato DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.hpp")
