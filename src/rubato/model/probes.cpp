// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/small_vectors.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/model/build.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/node_label.hpp"
#include "rubato/study/table_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <span>

namespace rubato::model {
namespace {

using mesh::NodeIndex;

using Nodes = std::vector<NodeIndex>;

/// Distances that differ by less than this part of the mesh's size are the same.
constexpr double same_distance = 1e-6;
constexpr std::size_t named_nodes = 5;

double size_of(const mesh::Mesh& mesh, const domain::DofMap& dofs) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Eigen::Vector3d low(infinity, infinity, infinity);
  Eigen::Vector3d high(-infinity, -infinity, -infinity);
  for (const auto node : dofs.nodes) {
    const auto& place = mesh.points[static_cast<std::size_t>(node)];
    for (Eigen::Index i = 0; i < place.size(); ++i) {
      low[i] = std::min(low[i], place[i]);
      high[i] = std::max(high[i], place[i]);
    }
  }
  return contact::length_of(contact::difference_of(high, low));
}

/// The nodes that no other one is nearer than.
Nodes nearest_nodes(const mesh::Mesh& mesh, const domain::DofMap& dofs, const std::array<double, 3>& point) {
  const Eigen::Vector3d x(point[0], point[1], point[2]);
  const auto distance = [&](NodeIndex node) {
    return contact::length_of(contact::difference_of(mesh.points[static_cast<std::size_t>(node)], x));
  };
  double least = std::numeric_limits<double>::infinity();
  for (const auto node : dofs.nodes)
    least = std::min(least, distance(node));
  const double limit = least + same_distance * size_of(mesh, dofs);
  Nodes nodes;
  std::ranges::copy_if(dofs.nodes, std::back_inserter(nodes),
                       [&](NodeIndex node) { return distance(node) <= limit; });
  return nodes;
}

std::string ambiguity(const study::Probe& probe, const mesh::Mesh& mesh, const Nodes& nodes,
                      NodeIndex taken) {
  std::vector<std::string> labels;
  for (const auto node : std::span(nodes).first(std::min(nodes.size(), named_nodes)))
    labels.push_back(node_label(mesh, node));
  const auto more = nodes.size() > named_nodes ? fmt::format(" and {} more", nodes.size() - named_nodes) : "";
  return fmt::format(
      "probe '{}': {} nodes are equally near to its point, {}{}; {} is taken, 'node: {}' instead "
      "of the point, or another one of them, says which is meant",
      probe.name, nodes.size(), joined(labels, ", "), more, mesh::node_name(mesh, taken),
      mesh::node_name(mesh, taken));
}

/// The node nearest to a point, and a note when it is not the only one.
Nodes node_at(const study::Probe& probe, const mesh::Mesh& mesh, const domain::DofMap& dofs,
              std::vector<std::string>& notes) {
  const auto nodes = nearest_nodes(mesh, dofs, *probe.point);
  const Eigen::Vector3d x(probe.point->at(0), probe.point->at(1), probe.point->at(2));
  const auto taken = *std::ranges::min_element(nodes, {}, [&](NodeIndex node) {
    const auto apart = contact::difference_of(mesh.points[static_cast<std::size_t>(node)], x);
    return contact::dot(apart, apart);
  });
  if (nodes.size() > 1)
    notes.push_back(ambiguity(probe, mesh, nodes, taken));
  return {taken};
}

std::string path_of(const study::Probe& probe) {
  return fmt::format("probes.{}.{}", probe.name, probe.take == study::ProbeTake::node ? "node" : "on");
}

/// The nodes a name means; node 0 and a fault when it means none, or several where one is wanted.
Nodes named_nodes_of(const study::Probe& probe, const mesh::Mesh& mesh, const domain::DofMap& dofs,
                     std::vector<Fault>& faults) {
  const Mention on{probe.node, path_of(probe)};
  auto nodes = nodes_or_fault(mesh, on, faults);
  const auto fault = [&](const std::string& text) {
    faults.push_back(fault_at(on.path, fmt::format("probe '{}': {}", probe.name, text)));
    return Nodes{0};
  };
  if (nodes.empty())
    return {0};
  const auto first = nodes.front();
  const auto count = nodes.size();
  std::erase_if(nodes, [&](NodeIndex node) { return !dofs.has(node); });
  if (probe.take == study::ProbeTake::node && count > 1)
    return fault(
        fmt::format("group '{}' has {} nodes, expected one, or what is taken of them: {{on: {}, take: "
                    "sum}}, mean, min or max",
                    probe.node, count, probe.node));
  if (nodes.empty())
    return fault(count == 1
                     ? fmt::format("node {} belongs to no cell that deforms", node_label(mesh, first))
                     : fmt::format("no node of group '{}' belongs to a cell that deforms", probe.node));
  return nodes;
}

} // namespace

std::vector<Nodes> make_probe_nodes(const study::Study& study, const mesh::Mesh& mesh,
                                    const domain::DofMap& dofs, std::span<const Reference> references,
                                    std::vector<Fault>& faults, std::vector<std::string>& notes) {
  std::vector<Nodes> nodes;
  for (const auto& probe : study.probes)
    if (probe.section || probe.contact || !probe.minus.empty() || probe.place != study::ProbePlace::nodes ||
        reference_named(references, probe.node) != nullptr)
      nodes.emplace_back();
    else
      nodes.push_back(probe.point ? node_at(probe, mesh, dofs, notes)
                                  : named_nodes_of(probe, mesh, dofs, faults));
  return nodes;
}

namespace {

void check_zone_of_table(const study::PrintedTable& table, const std::string& path,
                         const std::vector<std::string>& zones, std::vector<Fault>& faults) {
  if (std::ranges::find(zones, table.on) == zones.end())
    faults.push_back(fault_at(
        path, fmt::format("no contact zone is called {}{}", shown(table.on), suggestion(table.on, zones))));
}

void check_tables(const Model& model, const std::vector<std::string>& zones, std::vector<Fault>& faults) {
  const auto& tables = model.study.fields.tables;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const auto& table = tables[i];
    const auto path = fmt::format("fields.tables.{}.{}", i, study::word_of(study::table_of_words, table.of));
    if (table.on.empty())
      continue;
    if (table.of == study::TableOf::zones)
      check_zone_of_table(table, path, zones, faults);
    else if (table.of != study::TableOf::nodes)
      cells_named(model.mesh, {table.on, path}, faults);
    else if (reference_named(model.references, table.on) == nullptr)
      nodes_or_fault(model.mesh, {table.on, path}, faults);
  }
}

} // namespace

void check_probed_zones(const Model& model, std::vector<Fault>& faults) {
  std::vector<std::string> names;
  for (const auto& zone : model.zones)
    names.push_back(zone.settings.name);
  for (const auto& probe : model.study.probes)
    if (probe.contact && std::ranges::find(names, probe.contact->zone) == names.end())
      faults.push_back(fault_at(fmt::format("probes.{}.contact.zone", probe.name),
                                fmt::format("no contact zone is called {}{}", shown(probe.contact->zone),
                                            suggestion(probe.contact->zone, names))));
  check_tables(model, names, faults);
}

void check_compared_places(const study::Study& study, const mesh::Mesh& mesh, std::vector<Fault>& faults) {
  for (std::size_t i = 0; i < study.checks.size(); ++i)
    if (const auto& field = study.checks[i].field; field && !field->on.empty())
      nodes_or_fault(mesh, {field->on, fmt::format("checks.{}.on", i)}, faults);
}

} // namespace rubato::model
