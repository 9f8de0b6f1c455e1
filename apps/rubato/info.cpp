// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/mesh_file.hpp"
#include "rubato/mesh/quality.hpp"

#include <fmt/format.h>

#include "commands.hpp"

namespace rubato::app {

int info(const InfoArguments& arguments) {
  const auto mesh = rubato::mesh::read_mesh(arguments.file, arguments.mesh_name);
  fmt::print("{}\n{}", arguments.file.string(), rubato::mesh::to_text(rubato::mesh::examine(mesh)));
  return done;
}

} // namespace rubato::app
