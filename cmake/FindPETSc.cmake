# SPDX-License-Identifier: LGPL-3.0-or-later
# PETSc of real numbers, with the MPI it was built with:
#   PETSc::PETSc
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(_PETSc QUIET petsc)
endif()
find_path(PETSc_INCLUDE_DIR petscksp.h HINTS ${_PETSc_INCLUDE_DIRS})
find_library(PETSc_LIBRARY NAMES petsc_real petsc HINTS ${_PETSc_LIBRARY_DIRS})
set(PETSc_VERSION ${_PETSc_VERSION})
find_package(MPI QUIET COMPONENTS C)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  PETSc
  REQUIRED_VARS PETSc_LIBRARY PETSc_INCLUDE_DIR MPI_C_FOUND
  VERSION_VAR PETSc_VERSION)

if(PETSc_FOUND AND NOT TARGET PETSc::PETSc)
  add_library(PETSc::PETSc INTERFACE IMPORTED)
  target_include_directories(PETSc::PETSc SYSTEM INTERFACE ${PETSc_INCLUDE_DIR})
  target_link_libraries(PETSc::PETSc INTERFACE ${PETSc_LIBRARY} MPI::MPI_C)
endif()
mark_as_advanced(PETSc_INCLUDE_DIR PETSc_LIBRARY)
