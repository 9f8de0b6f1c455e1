# SPDX-License-Identifier: LGPL-3.0-or-later
# Sequential MUMPS, kept apart from every MPI.
#
# Sequential MUMPS comes with a stub of MPI (libmpiseq) whose functions bear the names of the real ones, and the real
# ones come into our processes with libmedC. So its static archives are folded into one object, in which everything
# but the C door is made local: neither the stub nor MUMPS's own names can meet another library's, and whoever
# links the object needs no linker option for it.
#   MUMPS::runtime                        what the folded object needs when a program is linked
#   mumps_add_folded_object(target name)  adds that object to `target`; its one visible function is `name`
include(FindPackageHandleStandardArgs)

find_path(MUMPS_INCLUDE_DIR dmumps_c.h)
set(_MUMPS_archives)
foreach(_part dmumps mumps_common pord mpiseq)
  find_library(MUMPS_${_part}_ARCHIVE NAMES lib${_part}_seq.a)
  list(APPEND _MUMPS_archives MUMPS_${_part}_ARCHIVE)
endforeach()
# The shared libraries alone are enough to link, so no Fortran compiler and no Scotch headers need be installed.
find_library(MUMPS_gfortran_LIBRARY NAMES gfortran libgfortran.so.5)
find_library(MUMPS_esmumps_LIBRARY NAMES esmumps esmumps-7.0)
find_library(MUMPS_scotch_LIBRARY NAMES scotch scotch-7.0)
find_library(MUMPS_scotcherr_LIBRARY NAMES scotcherr scotcherr-7.0)
set(_MUMPS_runtime MUMPS_esmumps_LIBRARY MUMPS_scotch_LIBRARY MUMPS_scotcherr_LIBRARY MUMPS_gfortran_LIBRARY)
if(MUMPS_INCLUDE_DIR)
  file(STRINGS ${MUMPS_INCLUDE_DIR}/dmumps_c.h _MUMPS_line REGEX "define MUMPS_VERSION \"")
  string(REGEX REPLACE ".*\"([0-9.]+)\".*" "\\1" MUMPS_VERSION "${_MUMPS_line}")
endif()

find_package_handle_standard_args(
  MUMPS
  REQUIRED_VARS ${_MUMPS_archives} ${_MUMPS_runtime} MUMPS_INCLUDE_DIR
  VERSION_VAR MUMPS_VERSION)

if(MUMPS_FOUND AND NOT TARGET MUMPS::runtime)
  find_package(Threads REQUIRED)
  add_library(MUMPS::runtime INTERFACE IMPORTED)
  foreach(_library ${_MUMPS_runtime})
    set_property(TARGET MUMPS::runtime APPEND PROPERTY INTERFACE_LINK_LIBRARIES ${${_library}})
  endforeach()
  set_property(TARGET MUMPS::runtime APPEND PROPERTY INTERFACE_LINK_LIBRARIES Threads::Threads)
endif()
mark_as_advanced(MUMPS_INCLUDE_DIR ${_MUMPS_archives} ${_MUMPS_runtime})

function(mumps_add_folded_object target name)
  set(object ${CMAKE_CURRENT_BINARY_DIR}/${name}.o)
  set(archives)
  foreach(part dmumps mumps_common pord mpiseq)
    list(APPEND archives ${MUMPS_${part}_ARCHIVE})
  endforeach()
  add_custom_command(
    OUTPUT ${object}
    COMMAND ${CMAKE_LINKER} -r -d -u dmumps_c -o ${object}.all --start-group ${archives} --end-group
    COMMAND ${CMAKE_OBJCOPY} --keep-global-symbol=dmumps_c ${object}.all ${object}.local
    COMMAND ${CMAKE_OBJCOPY} --redefine-sym dmumps_c=${name} ${object}.local ${object}
    COMMAND ${CMAKE_COMMAND} -E rm ${object}.all ${object}.local
    DEPENDS ${archives}
    COMMENT "Folding sequential MUMPS into one object"
    VERBATIM)
  # A target of its own, because `target` may belong to another folder than the command.
  add_custom_target(${name} DEPENDS ${object})
  add_dependencies(${target} ${name})
  get_target_property(folder ${target} SOURCE_DIR)
  set_source_files_properties(${object} DIRECTORY ${folder} PROPERTIES EXTERNAL_OBJECT TRUE GENERATED TRUE)
  target_sources(${target} PRIVATE ${object})
  target_include_directories(${target} SYSTEM PRIVATE ${MUMPS_INCLUDE_DIR})
  target_link_libraries(${target} PRIVATE MUMPS::runtime)
endfunction()
