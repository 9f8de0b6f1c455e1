# SPDX-License-Identifier: LGPL-3.0-or-later
# The flags every target of the project shares.
add_library(rubato_flags INTERFACE)
target_compile_options(rubato_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor)
if(RUBATO_SANITIZE)
  target_compile_options(rubato_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined
                                                -fno-omit-frame-pointer)
  target_link_options(rubato_flags INTERFACE -fsanitize=address,undefined)
endif()

# rubato_test(name SOURCES a.cpp …): one GoogleTest program, each of its tests known to CTest.
function(rubato_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE rubato rubato_flags GTest::gtest_main)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${name} PRIVATE RUBATO_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                                             RUBATO_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared")
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  gtest_discover_tests(${name} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} DISCOVERY_TIMEOUT 60
                       PROPERTIES TIMEOUT ${ARG_TIMEOUT})
endfunction()
