// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/naming.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/model/build.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/node_label.hpp"
#include "rubato/model/rigid_motions.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::model {
namespace {

/// The smallest group of cells that holds all of a body and nothing of another one; empty when there is none.
std::string group_of(const Model& model, const Bodies& bodies, int body) {
  const auto body_of = [&](mesh::CellIndex cell) { return bodies.of(model.mesh.nodes_of(cell).front()); };
  const auto size = std::ranges::count(model.bulk.cells, body, body_of);
  for (const auto& group : model.mesh.cell_groups)
    if (static_cast<std::ptrdiff_t>(group.items.size()) == size &&
        std::ranges::all_of(group.items, [&](auto cell) {
          return std::ranges::binary_search(model.bulk.cells, cell) && body_of(cell) == body;
        }))
      return group.name;
  return {};
}

} // namespace

std::string body_text(const Model& model, const Bodies& bodies, int body) {
  const auto node = node_label(model.mesh, bodies.first_node(body));
  const auto group = group_of(model, bodies, body);
  return group.empty() ? fmt::format("the body of node {}", node)
                       : fmt::format("the body '{}' (of node {})", group, node);
}

void check_supported(const Model& model, std::vector<Fault>& faults) {
  RigidMotions motions(model);
  motions.add_supports();
  motions.add_contact();
  const auto loose = motions.loose();
  if (loose.empty()) {
    for (const auto node : motions.loose_nodes())
      faults.push_back(fault_at(
          "time", fmt::format("node {}, which belongs to no cell, is not held; expected a support, or an "
                              "equation or a connector that ties it to something that is held",
                              node_label(model.mesh, node))));
    return;
  }
  std::vector<std::string> directions;
  std::ranges::transform(loose, std::back_inserter(directions), &direction_text);
  faults.push_back(fault_at(
      "time",
      fmt::format("{} is not held: it can move as a rigid body {}, and a static run has no inertia; "
                  "expected supports, springs, or contact with something that is held (frictionless contact "
                  "holds across the surface only)",
                  body_text(model, motions.bodies(), loose.front().body), joined(directions, ", "))));
}

} // namespace rubato::model
