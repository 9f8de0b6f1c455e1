// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/build.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::model {
namespace {

using mesh::NodeIndex;

NodeIndex nearest_node(const mesh::Mesh& mesh, const fem::DofMap& dofs, const std::array<double, 3>& point) {
  const Eigen::Vector3d x(point[0], point[1], point[2]);
  return *std::ranges::min_element(dofs.nodes, {}, [&](NodeIndex node) {
    return (mesh.points[static_cast<std::size_t>(node)] - x).squaredNorm();
  });
}

/// The node a name means; 0 and a fault when it means none or several.
NodeIndex named_node(const deck::Probe& probe, const mesh::Mesh& mesh, const fem::DofMap& dofs,
                     std::vector<Fault>& faults) {
  const auto nodes = nodes_or_fault(mesh, probe.node, faults);
  const auto fault = [&](const std::string& text) {
    faults.push_back({probe.node.at, fmt::format("probe '{}': {}", probe.name, text)});
    return NodeIndex{0};
  };
  if (nodes.empty())
    return 0;
  if (nodes.size() > 1)
    return fault(fmt::format("group '{}' has {} nodes, expected one", probe.node.text, nodes.size()));
  if (!dofs.has(nodes.front()))
    return fault(fmt::format("node {} belongs to no cell that deforms", node_label(mesh, nodes.front())));
  return nodes.front();
}

} // namespace

std::vector<NodeIndex> make_probe_nodes(const deck::Study& study, const mesh::Mesh& mesh,
                                        const fem::DofMap& dofs, std::vector<Fault>& faults) {
  std::vector<NodeIndex> nodes;
  for (const auto& probe : study.probes)
    nodes.push_back(probe.point ? nearest_node(mesh, dofs, *probe.point)
                                : named_node(probe, mesh, dofs, faults));
  return nodes;
}

void check_compared_places(const deck::Study& study, const mesh::Mesh& mesh, std::vector<Fault>& faults) {
  for (const auto& check : study.checks)
    if (check.field && !check.field->on.text.empty())
      nodes_or_fault(mesh, check.field->on, faults);
}

} // namespace rubato::model
