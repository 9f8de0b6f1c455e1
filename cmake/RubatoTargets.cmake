# SPDX-License-Identifier: LGPL-3.0-or-later
# The flags every target of the project shares.
add_library(rubato_flags INTERFACE)
target_compile_options(rubato_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor)
if(RUBATO_SANITIZE)
  target_compile_options(rubato_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined
                                                -fno-omit-frame-pointer)
  target_link_options(rubato_flags INTERFACE -fsanitize=address,undefined)
endif()

# rubato_test(name SOURCES a.cpp … [SHARED filter…]): one GoogleTest program, each of its tests known to CTest.
# SHARED names the tests that look at ../shared, as GoogleTest's filters do. They have the label `shared`; no other
# test sees that folder, so that their results do not depend on what lies beside the sources.
function(rubato_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;SHARED" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE rubato rubato_flags GTest::gtest_main)
  target_compile_options(${name} PRIVATE ${RUBATO_TEST_OPTIONS})
  target_precompile_headers(${name} REUSE_FROM rubato_test_headers)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${name} PRIVATE RUBATO_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                                             RUBATO_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared")
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  set(discovery WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} DISCOVERY_TIMEOUT 60)
  list(JOIN ARG_SHARED ":" shared)
  set(others)
  if(shared)
    set(others TEST_FILTER "-${shared}")
  endif()
  gtest_discover_tests(${name} ${others} ${discovery} PROPERTIES TIMEOUT ${ARG_TIMEOUT} ENVIRONMENT "RUBATO_SHARED=")
  if(shared)
    gtest_discover_tests(${name} TEST_FILTER "${shared}" TEST_LIST ${name}_SHARED_TESTS ${discovery}
                         PROPERTIES TIMEOUT ${ARG_TIMEOUT} LABELS shared)
  endif()
endfunction()
