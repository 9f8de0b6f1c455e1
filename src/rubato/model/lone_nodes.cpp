// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/lone_nodes.hpp"

#include "rubato/contact/zone.hpp"
#include "rubato/mesh/index_lists.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/model/bodies.hpp"
#include "rubato/model/build.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/node_label.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>

namespace rubato::model {
namespace {

using mesh::NodeIndex;

/// Names of single nodes that may have no cells.
std::set<std::string> point_names(const study::Study& study) {
  std::set<std::string> names;
  for (const auto& relation : study.relations)
    for (const auto& term : relation.terms)
      names.insert(term.on);
  for (const auto& connector : study.connectors) {
    names.insert(connector.on);
    if (!connector.to.empty())
      names.insert(connector.to);
  }
  for (const auto& mass : study.masses)
    names.insert(mass.on);
  return names;
}

/// By unknown: whether it moves something that has mass.
std::vector<char> moves_mass(const Model& model, const Bodies& bodies) {
  std::vector<char> moves(static_cast<std::size_t>(model.reduction.unknown_count()), 0);
  const auto enter = [&](int dof) {
    model.reduction.for_each_unknown(
        dof, [&](int unknown, double) { moves[static_cast<std::size_t>(unknown)] = 1; });
  };
  const auto enter_node = [&](NodeIndex node) {
    for (int i = 0; i < model.dofs.components; ++i)
      enter(model.dofs.dof(node, i));
  };
  for (const auto node : model.dofs.nodes)
    if (bodies.of(node) >= 0)
      enter_node(node);
  for (const auto& mass : model.point_masses)
    if (mass.mass > 0)
      enter_node(mass.node);
  for (const auto& connector : model.connectors)
    if (connector.mass > 0)
      for (const auto& term : connector.row)
        enter(term.dof);
  return moves;
}

} // namespace

std::vector<NodeIndex> lone_nodes(const study::Study& study, const mesh::Mesh& mesh,
                                  const domain::DofMap& dofs) {
  std::vector<NodeIndex> nodes;
  if (static_cast<NodeIndex>(dofs.nodes.size()) == mesh.node_count())
    return nodes;
  for (const auto& name : point_names(study)) {
    const auto found = mesh::find_nodes(mesh, name).nodes;
    if (found.size() == 1 && !dofs.has(found.front()))
      nodes.push_back(found.front());
  }
  mesh::sort_without_repeats(nodes);
  return nodes;
}

void add_nodes(std::span<const NodeIndex> nodes, domain::DofMap& dofs) {
  if (nodes.empty())
    return;
  dofs.nodes.insert(dofs.nodes.end(), nodes.begin(), nodes.end());
  std::ranges::sort(dofs.nodes);
  dofs.dof_count = 0;
  for (const auto node : dofs.nodes) {
    dofs.first_dof[static_cast<std::size_t>(node)] = dofs.dof_count;
    dofs.dof_count += dofs.components;
  }
}

std::vector<NodeIndex> lone_nodes_of(const Model& model) {
  const Bodies bodies(model.mesh, model.bulk);
  std::vector<NodeIndex> nodes;
  std::ranges::copy_if(model.dofs.nodes, std::back_inserter(nodes),
                       [&](NodeIndex node) { return bodies.of(node) < 0; });
  if (nodes.empty())
    return nodes;
  std::set<NodeIndex> of_faces;
  for (const auto face : rigid_faces(model.study, model.mesh))
    for (const auto node : model.mesh.nodes_of(face))
      of_faces.insert(node);
  std::erase_if(nodes, [&](NodeIndex node) { return of_faces.contains(node); });
  return nodes;
}

void check_lone_masses(const Model& model, std::vector<Fault>& faults) {
  const auto nodes = lone_nodes_of(model);
  if (nodes.empty())
    return;
  const auto moves = moves_mass(model, Bodies(model.mesh, model.bulk));
  for (const auto node : nodes)
    for (int i = 0; i < model.dofs.components; ++i) {
      bool lacks = false;
      model.reduction.for_each_unknown(model.dofs.dof(node, i), [&](int unknown, double) {
        lacks = lacks || moves[static_cast<std::size_t>(unknown)] == 0;
      });
      if (lacks)
        return faults.push_back(fault_at(
            "masses", fmt::format("node {}, which belongs to no cell, can move in {} and has no mass; "
                                  "expected a mass, a support, or a static run",
                                  node_label(model.mesh, node), "xyz"[i])));
    }
}

} // namespace rubato::model
