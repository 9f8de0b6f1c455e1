// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/quality.hpp"

#include "rubato/cell/parts.hpp"
#include "rubato/core/disjoint_sets.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/mesh/orientation.hpp"
#include "rubato/mesh/rounding.hpp"
#include "rubato/mesh/skin.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace rubato::mesh {
namespace {

using Eigen::Vector3d;
using NodeSpan = std::span<const NodeIndex>;

void record(Findings& findings, const std::string& name) {
  ++findings.count;
  if (findings.first.size() < Findings::shown)
    findings.first.push_back(name);
}

void record_cell(Findings& findings, const Mesh& mesh, CellIndex cell) {
  record(findings, cell_name(mesh, cell));
}

void record_node(Findings& findings, const Mesh& mesh, NodeIndex node) {
  const auto i = static_cast<std::size_t>(node);
  record(findings, mesh.node_names.empty() ? std::to_string(mesh.node_numbers[i]) : mesh.node_names[i]);
}

/// Nodes joined by cells.
class ConnectedNodes {
public:
  explicit ConnectedNodes(const Mesh& mesh) : sets_(mesh.points.size()), bulk_(mesh.points.size(), false) {
    for_each_cell(mesh, [this](CellIndex, const cell::CellTopology&, NodeSpan nodes) {
      for (const auto node : nodes)
        sets_.join(static_cast<std::size_t>(nodes.front()), static_cast<std::size_t>(node));
    });
    for_each_cell(mesh, [&](CellIndex, const cell::CellTopology& shape, NodeSpan nodes) {
      if (shape.dimension == mesh.dimension)
        bulk_[root(nodes.front())] = true;
    });
  }

  std::size_t root(NodeIndex node) { return sets_.root(static_cast<std::size_t>(node)); }
  bool in_bulk(NodeIndex node) { return bulk_[root(node)]; }
  int body_count() const { return static_cast<int>(std::ranges::count(bulk_, true)); }

private:
  DisjointSets sets_;
  std::vector<bool> bulk_; ///< of a root: its set has a bulk cell
};

void measure_box(MeshReport& report, const Mesh& mesh) {
  if (mesh.points.empty())
    return;
  report.lower = report.upper = mesh.points.front();
  for (const auto& point : mesh.points) {
    report.lower = report.lower.cwiseMin(point);
    report.upper = report.upper.cwiseMax(point);
  }
}

TypeQuality examine_block(MeshReport& report, const Mesh& mesh, const CellBlock& block,
                          CellIndex first_cell) {
  TypeQuality quality;
  quality.type = block.type;
  quality.count = block.cell_count();
  const bool bulk = cell::topology(block.type).dimension == mesh.dimension;
  for (CellIndex i = 0; i < quality.count; ++i) {
    const auto nodes = block.cell(i);
    if (bulk)
      report.bulk_measure += signed_measure(block.type, nodes, mesh.points, mesh.dimension);
    const auto jacobian = scaled_jacobian(block.type, nodes, mesh.points, mesh.dimension);
    if (!jacobian)
      continue;
    quality.has_jacobian = true;
    quality.mean_jacobian += *jacobian / quality.count;
    if (*jacobian < quality.smallest_jacobian) {
      quality.smallest_jacobian = *jacobian;
      quality.worst_cell = cell_name(mesh, first_cell + i);
    }
    if (bulk && !(*jacobian > 0))
      record_cell(report.inverted_cells, mesh, first_cell + i);
    else if (bulk && *jacobian < least_jacobian)
      record_cell(report.flat_cells, mesh, first_cell + i);
  }
  return quality;
}

void measure_edges(MeshReport& report, const Mesh& mesh) {
  double shortest = std::numeric_limits<double>::infinity();
  for_each_cell(mesh, [&](CellIndex, const cell::CellTopology& shape, NodeSpan nodes) {
    for (const auto& [a, b] : shape.edges) {
      const double length =
          (mesh.points[static_cast<std::size_t>(nodes[a])] - mesh.points[static_cast<std::size_t>(nodes[b])])
              .norm();
      shortest = std::min(shortest, length);
      report.longest_edge = std::max(report.longest_edge, length);
    }
  });
  report.shortest_edge = std::isfinite(shortest) ? shortest : 0;
}

void find_flat_axis(MeshReport& report, const Mesh& mesh) {
  const Vector3d extent = report.upper - report.lower;
  for (int axis = 0; axis < mesh.dimension && !report.has_bulk_cells; ++axis)
    if (extent[axis] <= coordinate_rounding * extent.norm())
      report.flat_axis = axis;
}

GroupSummary summary_of_cells(const Mesh& mesh, const Group& group) {
  GroupSummary summary{.name = group.name, .kind = GroupSummary::Kind::cells, .count = group.items.size()};
  int smallest = 3;
  for (const auto cell : group.items) {
    const int dimension = cell::topology(mesh.type_of(cell)).dimension;
    summary.dimension = std::max(summary.dimension, dimension);
    smallest = std::min(smallest, dimension);
  }
  summary.mixed = !group.items.empty() && smallest != summary.dimension;
  return summary;
}

void list_groups(MeshReport& report, const Mesh& mesh) {
  for (const auto& group : mesh.node_groups)
    report.groups.push_back(
        {.name = group.name, .kind = GroupSummary::Kind::nodes, .count = group.items.size()});
  for (const auto& group : mesh.cell_groups)
    report.groups.push_back(summary_of_cells(mesh, group));
  for (const auto& group : report.groups)
    if (group.count == 0)
      report.empty_groups.push_back(group.name);
}

void find_lost_nodes(MeshReport& report, const Mesh& mesh) {
  for (NodeIndex node = 0; node < mesh.node_count(); ++node)
    if (!mesh.points[static_cast<std::size_t>(node)].allFinite())
      record_node(report.lost_nodes, mesh, node);
}

void find_free_nodes(MeshReport& report, const Mesh& mesh) {
  std::vector<bool> used(mesh.points.size(), false);
  for_each_cell(mesh, [&](CellIndex, const cell::CellTopology&, NodeSpan nodes) {
    for (const auto node : nodes)
      used[static_cast<std::size_t>(node)] = true;
  });
  for (std::size_t i = 0; i < used.size(); ++i)
    if (!used[i])
      record_node(report.free_nodes, mesh, static_cast<NodeIndex>(i));
}

/// Calls visit(node, other) for every two nodes nearer than `distance`. Nodes are sorted along a direction in
/// which no two nodes of a regular grid coincide, so that only neighbours in that order need to be compared.
template <typename Visit>
void for_each_near_pair(const std::vector<Vector3d>& points, double distance, Visit visit) {
  const Vector3d direction = Vector3d(1, std::numbers::sqrt2, std::numbers::pi).normalized();
  std::vector<std::pair<double, NodeIndex>> order;
  order.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].allFinite())
      order.emplace_back(direction.dot(points[i]), static_cast<NodeIndex>(i));
  std::ranges::sort(order);
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && order[j].first - order[i].first <= distance; ++j) {
      const auto a = order[i].second;
      const auto b = order[j].second;
      if ((points[static_cast<std::size_t>(a)] - points[static_cast<std::size_t>(b)]).norm() <= distance)
        visit(std::min(a, b), std::max(a, b));
    }
}

void find_coincident_nodes(MeshReport& report, const Mesh& mesh, ConnectedNodes& connected) {
  std::vector<NodeIndex> duplicates;
  std::vector<NodeIndex> between_bodies;
  const double size = (report.upper - report.lower).stableNorm();
  if (!std::isfinite(size))
    return;
  for_each_near_pair(mesh.points, coordinate_rounding * size, [&](NodeIndex first, NodeIndex second) {
    const bool two_bodies = connected.root(first) != connected.root(second) && connected.in_bulk(first) &&
                            connected.in_bulk(second);
    (two_bodies ? between_bodies : duplicates).push_back(second);
  });
  for (auto* nodes : {&duplicates, &between_bodies}) {
    std::ranges::sort(*nodes);
    nodes->erase(std::unique(nodes->begin(), nodes->end()), nodes->end());
  }
  for (const auto node : duplicates)
    record_node(report.duplicate_nodes, mesh, node);
  report.coincident_between_bodies = static_cast<std::int64_t>(between_bodies.size());
}

void find_stray_cells(MeshReport& report, const Mesh& mesh, ConnectedNodes& connected) {
  std::vector<CellIndex> faces;
  for_each_cell(mesh, [&](CellIndex cell, const cell::CellTopology& shape, NodeSpan nodes) {
    if (!connected.in_bulk(nodes.front()))
      record_cell(report.loose_cells, mesh, cell);
    else if (shape.dimension == mesh.dimension - 1)
      faces.push_back(cell);
  });
  for (const auto cell : oriented_faces(mesh, faces).unowned)
    record_cell(report.unowned_faces, mesh, cell);
}

} // namespace

bool MeshReport::looks_right() const {
  return lost_nodes.count + free_nodes.count + inverted_cells.count + flat_cells.count +
                 duplicate_nodes.count + loose_cells.count + unowned_faces.count ==
             0 &&
         empty_groups.empty() && has_bulk_cells;
}

MeshReport examine(const Mesh& as_read) {
  MeshReport report;
  Mesh mesh = as_read;
  for (const auto cell : mend_orientation(mesh))
    record_cell(report.reversed_cells, mesh, cell);
  report.dimension = mesh.dimension;
  report.nodes = mesh.node_count();
  report.names_nodes = !mesh.node_names.empty();
  measure_box(report, mesh);
  CellIndex first_cell = 0;
  for (const auto& block : mesh.blocks) {
    report.types.push_back(examine_block(report, mesh, block, first_cell));
    first_cell += block.cell_count();
  }
  measure_edges(report, mesh);
  list_groups(report, mesh);

  ConnectedNodes connected(mesh);
  report.connected_bodies = connected.body_count();
  report.has_bulk_cells = report.connected_bodies > 0;
  find_flat_axis(report, mesh);
  find_lost_nodes(report, mesh);
  find_free_nodes(report, mesh);
  find_coincident_nodes(report, mesh, connected);
  find_stray_cells(report, mesh, connected);
  return report;
}

} // namespace rubato::mesh
