# SPDX-License-Identifier: LGPL-3.0-or-later
# librsvg, which draws SVG documents, with the cairo that it draws on, for a program that loads it while it runs:
#   Rsvg_LIBRARY                 the library
#   rsvg_sources(target file…)   lets these files of a target include librsvg/rsvg.h
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(Rsvg_PC QUIET librsvg-2.0)
endif()
set(Rsvg_VERSION ${Rsvg_PC_VERSION})
find_library(Rsvg_LIBRARY NAMES rsvg-2 HINTS ${Rsvg_PC_LIBRARY_DIRS})

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  Rsvg
  REQUIRED_VARS Rsvg_LIBRARY Rsvg_PC_INCLUDE_DIRS
  VERSION_VAR Rsvg_VERSION)
mark_as_advanced(Rsvg_LIBRARY)

function(rsvg_sources target)
  list(TRANSFORM Rsvg_PC_INCLUDE_DIRS PREPEND "-isystem;" OUTPUT_VARIABLE options)
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  set_source_files_properties(${ARGN} TARGET_DIRECTORY ${target} PROPERTIES COMPILE_OPTIONS "${options}")
endfunction()
