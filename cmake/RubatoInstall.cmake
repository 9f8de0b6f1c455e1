# SPDX-License-Identifier: LGPL-3.0-or-later
# `cmake --install`: program, man pages, completions, library, headers and the package another project finds.
include(CMakePackageConfigHelpers)

# The package that offers a linked target is named before its `::`. Those that break this rule, or that need more
# said to be found, stand here: one line for each, "<name before the ::> <arguments of find_dependency>".
set(rubato_unusual_packages
    "Eigen3 Eigen3 3.4 NO_MODULE"
    "pthread Threads")

# What a program that links the static library must find: everything `rubato` itself links.
function(rubato_dependency_lines result)
  get_target_property(linked rubato LINK_LIBRARIES)
  set(lines)
  foreach(target ${linked})
    if(target MATCHES "^(\\$<|::@|/)" OR NOT target MATCHES "^([A-Za-z0-9_+.-]+)(::.*)?$")
      continue() # generator expressions, CMake's own scope marks, plain paths
    endif()
    if(target STREQUAL "${CMAKE_DL_LIBS}")
      continue() # belongs to the C library
    endif()
    set(package ${CMAKE_MATCH_1})
    set(line "find_dependency(${package})")
    foreach(entry ${rubato_unusual_packages})
      if(entry MATCHES "^([^ ]+) (.+)$" AND CMAKE_MATCH_1 STREQUAL package)
        set(line "find_dependency(${CMAKE_MATCH_2})")
      endif()
    endforeach()
    list(APPEND lines "${line}")
  endforeach()
  list(REMOVE_DUPLICATES lines)
  list(JOIN lines "\n" lines)
  set(${result} "${lines}" PARENT_SCOPE)
endfunction()

set(rubato_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/rubato)
rubato_dependency_lines(rubato_dependencies)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/rubatoConfig.cmake.in ${PROJECT_BINARY_DIR}/rubatoConfig.cmake
                              INSTALL_DESTINATION ${rubato_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/rubatoConfigVersion.cmake COMPATIBILITY SameMinorVersion)

# Two components, as packages have them: the program with its pages, and what programs are built with.
install(TARGETS rubato_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(DIRECTORY ${PROJECT_BINARY_DIR}/share/ DESTINATION ${CMAKE_INSTALL_DATADIR} COMPONENT program OPTIONAL) # man pages and completions
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/COPYING.LESSER
              ${PROJECT_SOURCE_DIR}/COPYING
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs ${PROJECT_SOURCE_DIR}/cases DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program
        FILES_MATCHING PATTERN "*.md" PATTERN "*.svg" PATTERN "*.png" PATTERN "*.yaml")
install(TARGETS rubato EXPORT rubatoTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(EXPORT rubatoTargets NAMESPACE rubato:: DESTINATION ${rubato_package_dir} COMPONENT development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/rubato DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
        FILES_MATCHING PATTERN "*.hpp")
install(FILES ${PROJECT_BINARY_DIR}/generated/rubato/version.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rubato
        COMPONENT development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/cmake/ DESTINATION ${rubato_package_dir} COMPONENT development
        FILES_MATCHING PATTERN "Find*.cmake")
install(FILES ${PROJECT_BINARY_DIR}/rubatoConfig.cmake ${PROJECT_BINARY_DIR}/rubatoConfigVersion.cmake
        DESTINATION ${rubato_package_dir} COMPONENT development)
