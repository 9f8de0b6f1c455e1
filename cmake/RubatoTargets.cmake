# SPDX-License-Identifier: LGPL-3.0-or-later
# The flags every target of the project shares.
add_library(rubato_flags INTERFACE)
target_compile_options(rubato_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor)
if(RUBATO_SANITIZE)
  target_compile_options(rubato_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined
                                                -fno-omit-frame-pointer)
  target_link_options(rubato_flags INTERFACE -fsanitize=address,undefined)
endif()

# rubato_test(name SOURCES a.cpp … [SHARED filter…] [PARTS n]): one GoogleTest program, known to CTest as n parts of its
# tests: a process for each test would take longer to start than most tests to run. SHARED names the tests that look at
# ../shared, as GoogleTest's filters do. They are parts of their own with the label `shared`; no other test sees that
# folder, so that their results do not depend on what lies beside the sources.
function(rubato_test name)
  cmake_parse_arguments(ARG "" "PARTS" "SOURCES;SHARED" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE rubato_test_support rubato rubato_flags GTest::gtest_main)
  target_compile_options(${name} PRIVATE ${RUBATO_TEST_OPTIONS})
  target_precompile_headers(${name} REUSE_FROM rubato_test_headers)
  set_target_properties(${name} PROPERTIES UNITY_BUILD ${RUBATO_UNITY} UNITY_BUILD_BATCH_SIZE ${RUBATO_TEST_BATCH})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${name} PRIVATE RUBATO_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                                             RUBATO_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared")
  if(NOT ARG_PARTS)
    set(ARG_PARTS 1)
  endif()
  list(JOIN ARG_SHARED ":" shared)
  rubato_test_parts(${name} ${name} "-${shared}" ${ARG_PARTS})
  set_tests_properties(${parts} PROPERTIES ENVIRONMENT_MODIFICATION "RUBATO_SHARED=set:")
  if(shared)
    rubato_test_parts(${name} ${name}_shared "${shared}" ${ARG_PARTS})
    set_tests_properties(${parts} PROPERTIES LABELS shared)
  endif()
endfunction()

# Sets `parts` to the names of the entries.
function(rubato_test_parts program entry filter count)
  set(names)
  foreach(part RANGE 1 ${count})
    math(EXPR index "${part} - 1")
    set(entry_name ${entry})
    if(count GREATER 1)
      string(APPEND entry_name ".${part}")
    endif()
    add_test(NAME ${entry_name} COMMAND ${program} "--gtest_filter=${filter}" WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
    set_tests_properties(${entry_name} PROPERTIES TIMEOUT 1800 ENVIRONMENT
                         "GTEST_TOTAL_SHARDS=${count};GTEST_SHARD_INDEX=${index};RUBATO_THREADS=1")
    list(APPEND names ${entry_name})
  endforeach()
  set(parts ${names} PARENT_SCOPE)
endfunction()
