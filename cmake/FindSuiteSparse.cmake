# SPDX-License-Identifier: LGPL-3.0-or-later
# SuiteSparse as Debian ships it, without a CMake package.
#   SuiteSparse::cholmod  sparse Cholesky
#   SuiteSparse::umfpack  sparse LU
include(FindPackageHandleStandardArgs)

find_path(SuiteSparse_INCLUDE_DIR suitesparse/cholmod.h)
set(_SuiteSparse_libraries)
foreach(_part cholmod umfpack)
  find_library(SuiteSparse_${_part}_LIBRARY ${_part})
  list(APPEND _SuiteSparse_libraries SuiteSparse_${_part}_LIBRARY)
endforeach()
if(SuiteSparse_INCLUDE_DIR AND EXISTS ${SuiteSparse_INCLUDE_DIR}/suitesparse/SuiteSparse_config.h)
  file(STRINGS ${SuiteSparse_INCLUDE_DIR}/suitesparse/SuiteSparse_config.h _SuiteSparse_lines
       REGEX "^#define SUITESPARSE_(MAIN|SUB|SUBSUB)_VERSION +[0-9]+")
  string(REGEX REPLACE "[^0-9;]" "" _SuiteSparse_numbers "${_SuiteSparse_lines}")
  string(REPLACE ";" "." SuiteSparse_VERSION "${_SuiteSparse_numbers}")
endif()

find_package_handle_standard_args(
  SuiteSparse
  REQUIRED_VARS ${_SuiteSparse_libraries} SuiteSparse_INCLUDE_DIR
  VERSION_VAR SuiteSparse_VERSION)

if(SuiteSparse_FOUND)
  foreach(_part cholmod umfpack)
    if(NOT TARGET SuiteSparse::${_part})
      add_library(SuiteSparse::${_part} UNKNOWN IMPORTED)
      set_target_properties(SuiteSparse::${_part} PROPERTIES IMPORTED_LOCATION ${SuiteSparse_${_part}_LIBRARY}
                                                             INTERFACE_INCLUDE_DIRECTORIES ${SuiteSparse_INCLUDE_DIR})
    endif()
  endforeach()
endif()
mark_as_advanced(SuiteSparse_INCLUDE_DIR ${_SuiteSparse_libraries})
