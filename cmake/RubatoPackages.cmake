# SPDX-License-Identifier: LGPL-3.0-or-later
# `make deb`: the Debian packages rubato (the program), librubato-dev (the library) and python3-rubato (the module, with
# the reader of Code_Aster's command files), by CPack.

get_property(rubato_loaded_packages GLOBAL PROPERTY RUBATO_LOADED_PACKAGES)
get_property(rubato_suggested_packages GLOBAL PROPERTY RUBATO_SUGGESTED_PACKAGES)

# The packages that a program with librubato.a is built with are those rubato itself is built with, but for those
# of the command line, the tests and the benchmarks. cmake/install-dependencies has the one list. Libraries that are
# loaded when first used are needed without their headers.
function(rubato_development_packages result)
  file(READ ${PROJECT_SOURCE_DIR}/cmake/install-dependencies script)
  string(REGEX MATCH "\npackages=\\(([^)]*)\\)" unused "${script}")
  string(REGEX MATCHALL "[a-z0-9.+-]+" packages "${CMAKE_MATCH_1}")
  list(FILTER packages INCLUDE REGEX "^(lib.*-dev|zlib1g-dev|pkg-config)$")
  list(FILTER packages EXCLUDE REGEX "^lib(gtest|benchmark|cli11|spdlog|nanoflann|medc|hdf5|rsvg2)-dev$")
  list(APPEND packages ${rubato_loaded_packages})
  list(JOIN packages ", " packages)
  set(${result} "${packages}" PARENT_SCOPE)
endfunction()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME rubato)
set(CPACK_PACKAGE_CONTACT "the developers of rubato")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                                WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME rubato)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
list(JOIN rubato_loaded_packages ", " CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS)
string(APPEND CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS ", fonts-dejavu-core") # letters of pictures
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "rubato computes how elastic bodies move, come into contact, slide and separate, in 2D and 3D. It reads a mesh and a one-page input file, and writes histories, fields and pictures.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS ${rubato_suggested_packages}) # Gmsh's library meshes .geo files

rubato_development_packages(rubato_development_depends)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME librubato-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF) # a static library
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${rubato_development_depends}")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
    "The library of rubato, its headers and the CMake package that finds them.")

# Each package has the licence where Debian's tools look for it.
set(rubato_copyright ${PROJECT_SOURCE_DIR}/cmake/copyright)
install(FILES ${rubato_copyright} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/rubato COMPONENT program)
install(FILES ${rubato_copyright} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/librubato-dev COMPONENT development)

# Where Debian's zsh looks for the completions of packages.
install(FILES ${PROJECT_BINARY_DIR}/share/zsh/site-functions/_rubato DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions
        COMPONENT program EXCLUDE_FROM_ALL)

if(TARGET rubato_petsc)
  list(APPEND CPACK_COMPONENTS_ALL petsc)
  list(APPEND CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS rubato-petsc)
  list(JOIN CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS ", " CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS)
  set(CPACK_DEBIAN_PETSC_PACKAGE_NAME rubato-petsc)
  set(CPACK_DEBIAN_PETSC_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_PETSC_PACKAGE_SHLIBDEPS ON)
  set(CPACK_COMPONENT_PETSC_DESCRIPTION "What rubato solves with where a deck says solver: iterative, by PETSc.")
  install(FILES ${rubato_copyright} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/rubato-petsc COMPONENT petsc)
endif()

if(TARGET rubato_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS python3-rubato) # for rubato aster
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-rubato)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
  list(APPEND CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS ${rubato_loaded_packages})
  list(JOIN CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS ", " CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS libmed-tools) # medimport reads MED files of version 2.3
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
      "The Python module of rubato: studies, meshes, simulations and results as arrays. It also runs Code_Aster studies: rubato aster study.comm.")
  install(FILES ${rubato_copyright} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-rubato COMPONENT python)
endif()

include(CPack)
