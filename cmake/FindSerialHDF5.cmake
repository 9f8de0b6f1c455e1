# SPDX-License-Identifier: LGPL-3.0-or-later
# HDF5 without MPI, for a program that loads it while it runs:
#   SerialHDF5_LIBRARY                  the library
#   SerialHDF5_ARCHIVE                  the same as a static library, where there is one
#   SerialHDF5_COMPRESSION_LIBRARY      libsz, which the archive needs beside zlib
#   serial_hdf5_sources(target file…)   lets these files of a target include hdf5.h
# Only these files see its header: others of the same target may use the HDF5 that MED was built with.
find_path(SerialHDF5_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/serial)
find_library(SerialHDF5_LIBRARY NAMES hdf5_serial hdf5)
find_library(SerialHDF5_ARCHIVE NAMES libhdf5_serial.a)
find_library(SerialHDF5_COMPRESSION_LIBRARY NAMES sz libsz.so.2)
if(SerialHDF5_INCLUDE_DIR)
  foreach(header H5public.h H5pubconf.h)
    file(STRINGS ${SerialHDF5_INCLUDE_DIR}/${header} SerialHDF5_line REGEX "^#define (H5_VERS_INFO|H5_VERSION) ")
    string(REGEX MATCH "[0-9]+\\.[0-9]+\\.[0-9]+" SerialHDF5_number "${SerialHDF5_line}")
    if(SerialHDF5_number)
      set(SerialHDF5_VERSION ${SerialHDF5_number})
    endif()
  endforeach()
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  SerialHDF5
  REQUIRED_VARS SerialHDF5_LIBRARY SerialHDF5_INCLUDE_DIR
  VERSION_VAR SerialHDF5_VERSION)
mark_as_advanced(SerialHDF5_INCLUDE_DIR SerialHDF5_LIBRARY SerialHDF5_ARCHIVE SerialHDF5_COMPRESSION_LIBRARY)

function(serial_hdf5_sources target)
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  set_source_files_properties(${ARGN} TARGET_DIRECTORY ${target}
                              PROPERTIES COMPILE_OPTIONS "-isystem;${SerialHDF5_INCLUDE_DIR}")
endfunction()
