# SPDX-License-Identifier: LGPL-3.0-or-later
# METIS::METIS, the graph partitioner that orders CHOLMOD's factors.
find_path(METIS_INCLUDE_DIR metis.h)
find_library(METIS_LIBRARY metis)
mark_as_advanced(METIS_INCLUDE_DIR METIS_LIBRARY)

if(METIS_INCLUDE_DIR AND EXISTS ${METIS_INCLUDE_DIR}/metis.h)
  file(STRINGS ${METIS_INCLUDE_DIR}/metis.h metis_version_lines REGEX "#define METIS_VER_[A-Z]+[ \t]+[0-9]+")
  string(REGEX REPLACE "[^;0-9]+" "" metis_version_numbers "${metis_version_lines}")
  string(REPLACE ";" "." METIS_VERSION "${metis_version_numbers}")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(METIS REQUIRED_VARS METIS_LIBRARY METIS_INCLUDE_DIR VERSION_VAR METIS_VERSION)

if(METIS_FOUND AND NOT TARGET METIS::METIS)
  add_library(METIS::METIS UNKNOWN IMPORTED)
  set_target_properties(METIS::METIS PROPERTIES IMPORTED_LOCATION ${METIS_LIBRARY}
                                                INTERFACE_INCLUDE_DIRECTORIES ${METIS_INCLUDE_DIR})
endif()
