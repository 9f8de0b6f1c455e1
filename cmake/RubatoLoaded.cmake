# SPDX-License-Identifier: LGPL-3.0-or-later
# Libraries that rubato loads when it first uses them (core/dynamic_library.hpp), because each library that a program is
# linked with costs time at every start.

# rubato_loads(NAME library source [OPTIONAL]): compiles `source`, a file of the target rubato, with RUBATO_<NAME>_LIBRARY,
# the SONAME of `library`, and RUBATO_<NAME>_PACKAGE, the Debian package that contains it, or "" if dpkg finds none.
# Both are cache variables, too. The packages of rubato depend on that package, or suggest it if it is OPTIONAL:
# dpkg-shlibdeps sees linked libraries only.
function(rubato_loads name library source)
  cmake_parse_arguments(ARG "OPTIONAL" "" "" ${ARGN})
  execute_process(COMMAND ${CMAKE_OBJDUMP} -p ${library} OUTPUT_VARIABLE headers COMMAND_ERROR_IS_FATAL ANY)
  if(NOT headers MATCHES "SONAME +([^ \n]+)")
    message(FATAL_ERROR "${library} has no SONAME: a shared library was expected")
  endif()
  set(soname ${CMAKE_MATCH_1})
  rubato_package_of(${library} package)
  set(RUBATO_${name}_LIBRARY ${soname} CACHE INTERNAL "")
  set(RUBATO_${name}_PACKAGE "${package}" CACHE INTERNAL "")
  set_property(
    SOURCE ${CMAKE_CURRENT_SOURCE_DIR}/${source} TARGET_DIRECTORY rubato
    APPEND PROPERTY COMPILE_DEFINITIONS RUBATO_${name}_LIBRARY="${soname}" RUBATO_${name}_PACKAGE="${package}")
  if(ARG_OPTIONAL)
    set_property(GLOBAL APPEND PROPERTY RUBATO_SUGGESTED_PACKAGES ${package})
  else()
    set_property(GLOBAL APPEND PROPERTY RUBATO_LOADED_PACKAGES ${package})
  endif()
endfunction()

# Sets `result` to the Debian package that installed the file, or to "" on other systems and for files of no package.
function(rubato_package_of file result)
  file(REAL_PATH ${file} path)
  execute_process(COMMAND dpkg-query -S ${path} OUTPUT_VARIABLE owner RESULT_VARIABLE failed ERROR_QUIET)
  set(${result} "" PARENT_SCOPE)
  if(failed EQUAL 0 AND owner MATCHES "^([a-z0-9.+-]+)[:,]")
    set(${result} ${CMAKE_MATCH_1} PARENT_SCOPE)
  endif()
endfunction()
