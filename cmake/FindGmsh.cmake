# SPDX-License-Identifier: LGPL-3.0-or-later
# Gmsh, the mesh generator, through its C interface, for a program that loads it while it runs:
#   Gmsh_INCLUDE_DIR   where gmshc.h is
#   Gmsh_LIBRARY       the library
find_path(Gmsh_INCLUDE_DIR gmshc.h)
find_library(Gmsh_LIBRARY NAMES gmsh)

if(Gmsh_INCLUDE_DIR)
  file(STRINGS ${Gmsh_INCLUDE_DIR}/gmshc.h Gmsh_version_line REGEX "^#define GMSH_API_VERSION ")
  string(REGEX MATCH "[0-9.]+" Gmsh_VERSION "${Gmsh_version_line}")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  Gmsh
  REQUIRED_VARS Gmsh_LIBRARY Gmsh_INCLUDE_DIR
  VERSION_VAR Gmsh_VERSION)
mark_as_advanced(Gmsh_INCLUDE_DIR Gmsh_LIBRARY)
