// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/names.hpp"

#include "rubato/core/naming.hpp"
#include "rubato/model/build.hpp"

#include <fmt/format.h>

namespace rubato::model {
namespace {

std::string unknown_group(const mesh::Mesh& mesh, const Mention& name) {
  const auto names = mesh::group_names(mesh);
  const auto nearest = nearest_word(name.name, names);
  const auto text = fmt::format("found '{}', expected a group of cells of the mesh", name.name);
  if (!nearest.empty())
    return text + fmt::format("; did you mean '{}'?", nearest);
  return text + (names.empty() ? std::string("; the mesh has no groups")
                               : fmt::format("; the mesh has the groups {}", joined(names, ", ")));
}

} // namespace

const mesh::Group* cells_named(const mesh::Mesh& mesh, const Mention& name, std::vector<Fault>& faults) {
  const auto* group = mesh.cell_group(name.name);
  if (group == nullptr) {
    if (mesh.node_group(name.name) != nullptr)
      faults.push_back(
          fault_at(name.path, fmt::format("group '{}' holds nodes, expected a group of cells", name.name)));
    else
      faults.push_back(fault_at(name.path, unknown_group(mesh, name)));
  } else if (group->items.empty()) {
    faults.push_back(
        fault_at(name.path, fmt::format("group '{}' is empty, expected cells in it", name.name)));
    group = nullptr;
  }
  return group;
}

std::vector<mesh::NodeIndex> nodes_or_fault(const mesh::Mesh& mesh, const Mention& name,
                                            std::vector<Fault>& faults) {
  auto found = mesh::find_nodes(mesh, name.name);
  if (found.nodes.empty())
    faults.push_back(fault_at(name.path, found.fault));
  return found.nodes;
}

std::vector<mesh::NodeIndex> body_nodes_or_fault(const mesh::Mesh& mesh, const domain::DofMap& dofs,
                                                 const Mention& name, std::string_view use,
                                                 std::vector<Fault>& faults) {
  auto nodes = nodes_or_fault(mesh, name, faults);
  if (nodes.empty())
    return nodes;
  std::erase_if(nodes, [&](auto node) { return !dofs.has(node); });
  if (nodes.empty())
    faults.push_back(
        fault_at(name.path, fmt::format("found '{}', none of whose nodes belongs to a cell that deforms, "
                                        "expected a part of a body {}",
                                        name.name, use)));
  return nodes;
}

std::optional<Function> function_named(const study::Study& study, const std::string& name) {
  if (name.empty())
    return std::nullopt;
  return study.functions.at(name);
}

} // namespace rubato::model
