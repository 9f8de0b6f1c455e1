# SPDX-License-Identifier: LGPL-3.0-or-later
# Gmsh, the mesh generator, through its C++ interface: Gmsh::Gmsh.
find_path(Gmsh_INCLUDE_DIR gmsh.h)
find_library(Gmsh_LIBRARY NAMES gmsh)

if(Gmsh_INCLUDE_DIR)
  file(STRINGS ${Gmsh_INCLUDE_DIR}/gmsh.h Gmsh_version_line REGEX "^#define GMSH_API_VERSION ")
  string(REGEX MATCH "[0-9.]+" Gmsh_VERSION "${Gmsh_version_line}")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  Gmsh
  REQUIRED_VARS Gmsh_LIBRARY Gmsh_INCLUDE_DIR
  VERSION_VAR Gmsh_VERSION)
mark_as_advanced(Gmsh_INCLUDE_DIR Gmsh_LIBRARY)

if(Gmsh_FOUND AND NOT TARGET Gmsh::Gmsh)
  add_library(Gmsh::Gmsh UNKNOWN IMPORTED GLOBAL)
  set_target_properties(Gmsh::Gmsh PROPERTIES IMPORTED_LOCATION ${Gmsh_LIBRARY}
                                              INTERFACE_INCLUDE_DIRECTORIES ${Gmsh_INCLUDE_DIR})
endif()
