// SPDX-License-Identifier: LGPL-3.0-or-later
// The physics, and the mesh that is read or generated.
#include "rubato/study/rules/rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rubato::study {
namespace {

/// Beyond it neither local numbers nor memory hold.
constexpr double most_cells = 1e8;

void check_extent(Rules& rules, const Body& body, const std::string& path) {
  const auto shape = path + (body.dimension == 3 ? ".box" : ".rectangle");
  if (dimension_of(rules.study.physics) != body.dimension)
    rules.broken({shape, "physics"},
                 fmt::format("found a {} in {}, expected a {}", body.dimension == 3 ? "box" : "rectangle",
                             word_of(physics_words, rules.study.physics),
                             body.dimension == 3 ? "rectangle" : "box"));
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(body.dimension); ++axis) {
    if (!(body.to[axis] > body.from[axis]) || !std::isfinite(body.to[axis] - body.from[axis]))
      rules.broken({fmt::format("{}.to.{}", shape, axis), shape + ".to", shape + ".from"},
                   fmt::format("found {} for {}, expected more than the {} of 'from'", body.to[axis],
                               axis_words.at(axis), body.from[axis]));
    rules.whole_number(fmt::format("{}.divisions.{}", path, axis), body.divisions[axis], bounds::divisions);
  }
}

double cells_of(const MeshSource& mesh) {
  double cells = 0;
  for (const auto& body : mesh.bodies) {
    double of_body = 1;
    for (int axis = 0; axis < body.dimension; ++axis)
      of_body *= static_cast<double>(body.divisions[static_cast<std::size_t>(axis)]) * mesh.refine;
    cells += of_body;
  }
  return cells;
}

} // namespace

void check_physics(Rules& rules) {
  rules.number("thickness", rules.study.thickness, bounds::thickness);
}

void check_mesh(Rules& rules) {
  const auto& mesh = rules.study.mesh;
  if (mesh.file.empty() == mesh.bodies.empty())
    rules.broken({"mesh"}, mesh.file.empty() ? "'file' or 'generate' is missing"
                                             : "found both 'file' and 'generate', expected one of them");
  std::vector<std::string> names;
  for (std::size_t i = 0; i < mesh.bodies.size(); ++i) {
    const auto path = fmt::format("mesh.generate.{}", i);
    const auto& body = mesh.bodies[i];
    check_extent(rules, body, path);
    rules.name(path + ".name", body.name);
    if (!body.name.empty() && std::ranges::find(names, body.name) != names.end())
      rules.broken({path, path + ".name"}, fmt::format("found a second body named {}", shown(body.name)));
    names.push_back(body.name);
  }
  rules.whole_number("mesh.refine", mesh.refine, bounds::refine);
  if (const double cells = cells_of(mesh); cells > most_cells)
    rules.broken(
        {"mesh.generate", "mesh.refine"},
        fmt::format("found {:.3g} cells (divisions and refine), expected at most {:.3g}", cells, most_cells));
}

} // namespace rubato::study
