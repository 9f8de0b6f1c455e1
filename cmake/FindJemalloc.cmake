# SPDX-License-Identifier: LGPL-3.0-or-later
# jemalloc, in place of the system's malloc.
#   Jemalloc::Jemalloc   to link a program with
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(Jemalloc_PC QUIET jemalloc)
endif()
set(Jemalloc_VERSION ${Jemalloc_PC_VERSION})

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  Jemalloc
  REQUIRED_VARS Jemalloc_PC_LINK_LIBRARIES
  VERSION_VAR Jemalloc_VERSION)

if(Jemalloc_FOUND AND NOT TARGET Jemalloc::Jemalloc)
  add_library(Jemalloc::Jemalloc INTERFACE IMPORTED GLOBAL)
  set_target_properties(Jemalloc::Jemalloc PROPERTIES INTERFACE_LINK_LIBRARIES "${Jemalloc_PC_LINK_LIBRARIES}")
endif()
