// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/other_formats.hpp"

#include "rubato/mesh/io/gmsh.hpp"
#include "rubato/mesh/io/inp.hpp"
#include "rubato/mesh/io/mail.hpp"
#include "rubato/mesh/io/msh.hpp"

namespace rubato::mesh {

std::vector<Format> other_formats() {
  namespace fs = std::filesystem;
  return {{{".msh"},
           {"$MeshFormat"},
           [](const fs::path& path, const std::string&) { return read_msh(path); },
           nullptr,
           "Gmsh 2 and 4.1, text and binary, read"},
          {{".mail"},
           {"TITRE", "COOR_2D", "COOR_3D"},
           [](const fs::path& path, const std::string&) { return read_mail(path); },
           [](const fs::path& path, const Mesh& mesh) { write_mail(path, mesh); },
           "Code_Aster, read and written"},
          {{".inp"},
           {"*HEADING", "*Heading", "*NODE", "*Node"},
           [](const fs::path& path, const std::string&) { return read_inp(path); },
           nullptr,
           "Abaqus and CalculiX, read"},
          {{".geo"},
           {},
           [](const fs::path& path, const std::string&) { return read_geo(path); },
           nullptr,
           "Gmsh geometry, meshed by Gmsh's library and read",
           is_gmsh_built_in()}};
}

} // namespace rubato::mesh
