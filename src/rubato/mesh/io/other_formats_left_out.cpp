// SPDX-License-Identifier: LGPL-3.0-or-later
// What a build with RUBATO_RUNS_ONLY has in place of other_formats.cpp.
#include "rubato/core/error.hpp"
#include "rubato/mesh/io/other_formats.hpp"

#include <fmt/format.h>

namespace rubato::mesh {
namespace {

Mesh refuse(const std::filesystem::path& path, const std::string&) {
  throw InputError(fmt::format(
      "mesh file '{}' cannot be read: this program was built with RUBATO_RUNS_ONLY, as `make demo` "
      "does, and reads MED only; `make build` builds all formats",
      path.string()));
}

} // namespace

std::vector<Format> other_formats() {
  return {{{".msh"}, {"$MeshFormat"}, refuse, nullptr, "Gmsh, not built", false},
          {{".mail"}, {"TITRE", "COOR_2D", "COOR_3D"}, refuse, nullptr, "Code_Aster, not built", false},
          {{".inp"},
           {"*HEADING", "*Heading", "*NODE", "*Node"},
           refuse,
           nullptr,
           "Abaqus and CalculiX, not built",
           false},
          {{".geo"}, {}, refuse, nullptr, "Gmsh geometry, not built", false}};
}

} // namespace rubato::mesh
