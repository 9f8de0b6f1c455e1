# SPDX-License-Identifier: LGPL-3.0-or-later
# MED, the exchange format of Salome and Code_Aster, through its C library.
#   MEDFile_LIBRARY    the library, for a program that loads it while it runs
#   MEDFile::MEDFile   to link with
#   MEDFile::HDF5      the HDF5 library it was built with, for who calls that too
#   medfile_sources(target file…)   lets these files of a target include med.h
# med.h includes hdf5.h and, where MED was built with MPI, mpi.h. Only the files that need it see these headers, so
# that the rest of a target may use another HDF5.
find_path(MEDFile_INCLUDE_DIR med.h)
find_library(MEDFile_LIBRARY NAMES medC med)

set(MEDFile_DEPENDENT_DIRS)
set(MEDFile_WANTED MEDFile_HDF5_INCLUDE_DIR)
if(MEDFile_INCLUDE_DIR)
  file(STRINGS ${MEDFile_INCLUDE_DIR}/med.h MEDFile_with_mpi REGEX "^#define MED_HAVE_MPI")
  file(STRINGS ${MEDFile_INCLUDE_DIR}/med.h MEDFile_numbers REGEX "^#define MED_NUM_(MAJEUR|MINEUR|RELEASE) ")
  string(REGEX REPLACE "[^0-9;]" "" MEDFile_VERSION "${MEDFile_numbers}")
  string(REPLACE ";" "." MEDFile_VERSION "${MEDFile_VERSION}")
  if(MEDFile_with_mpi)
    find_path(MEDFile_HDF5_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/openmpi hdf5/mpich openmpi-x86_64)
    find_library(MEDFile_HDF5_LIBRARY NAMES hdf5_openmpi hdf5_mpich hdf5)
    find_package(MPI QUIET COMPONENTS C)
    set(MEDFile_DEPENDENT_DIRS ${MPI_C_INCLUDE_DIRS})
    list(APPEND MEDFile_WANTED MPI_C_FOUND)
  else()
    find_path(MEDFile_HDF5_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/serial)
    find_library(MEDFile_HDF5_LIBRARY NAMES hdf5_serial hdf5)
  endif()
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  MEDFile
  REQUIRED_VARS MEDFile_LIBRARY MEDFile_INCLUDE_DIR ${MEDFile_WANTED}
  VERSION_VAR MEDFile_VERSION)
mark_as_advanced(MEDFile_INCLUDE_DIR MEDFile_LIBRARY MEDFile_HDF5_INCLUDE_DIR MEDFile_HDF5_LIBRARY)

if(MEDFile_FOUND AND NOT TARGET MEDFile::MEDFile)
  add_library(MEDFile::MEDFile UNKNOWN IMPORTED GLOBAL)
  set_target_properties(MEDFile::MEDFile PROPERTIES IMPORTED_LOCATION ${MEDFile_LIBRARY})
  if(MEDFile_HDF5_LIBRARY)
    add_library(MEDFile::HDF5 UNKNOWN IMPORTED GLOBAL)
    set_target_properties(MEDFile::HDF5 PROPERTIES IMPORTED_LOCATION ${MEDFile_HDF5_LIBRARY})
  endif()
endif()

function(medfile_sources target)
  set(options)
  foreach(folder ${MEDFile_INCLUDE_DIR} ${MEDFile_HDF5_INCLUDE_DIR} ${MEDFile_DEPENDENT_DIRS})
    if(NOT folder STREQUAL "/usr/include")
      list(APPEND options -isystem ${folder})
    endif()
  endforeach()
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  set_source_files_properties(
    ${ARGN} TARGET_DIRECTORY ${target}
    PROPERTIES COMPILE_OPTIONS "${options}" COMPILE_DEFINITIONS "OMPI_SKIP_MPICXX;MPICH_SKIP_MPICXX")
endfunction()
