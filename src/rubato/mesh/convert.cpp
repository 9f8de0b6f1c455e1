// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/convert.hpp"

#include "rubato/cell/parts.hpp"
#include "rubato/core/error.hpp"
#include "rubato/mesh/builder.hpp"
#include "rubato/mesh/corner_sets.hpp"
#include "rubato/mesh/interpolation.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/study/study.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::mesh {
namespace {

using Eigen::Vector3d;
using NodeSpan = std::span<const NodeIndex>;

NodeIndex node_at(NodeSpan nodes, int local) {
  return nodes[static_cast<std::size_t>(local)];
}

CornerSet corners_of(NodeSpan nodes, const cell::CellTopology& shape) {
  return corner_set(nodes.first(static_cast<std::size_t>(shape.corner_count)));
}

/// Adds what `cell` becomes, with its number and the name the file gave it.
void add_as(MeshBuilder& builder, const Mesh& mesh, CellIndex cell, CellType type, NodeSpan nodes) {
  const auto [block, index] = mesh.place_of(cell);
  const auto i = static_cast<std::size_t>(index);
  builder.add_cell(type, nodes, block->numbers[i], block->names.empty() ? "" : block->names[i]);
}

void keep_cell_groups(MeshBuilder& builder, const Mesh& mesh) {
  for (const auto& group : mesh.cell_groups)
    builder.add_to_cell_group(group.name, group.items);
}

/// New index of every node, or −1 for those that lose their place with the middles and centres.
std::vector<NodeIndex> kept_nodes(const Mesh& mesh) {
  enum class Role : std::uint8_t { free, middle, corner };
  std::vector<Role> roles(mesh.points.size(), Role::free);
  for_each_cell(mesh, [&](CellIndex, const cell::CellTopology& shape, NodeSpan nodes) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      auto& role = roles[static_cast<std::size_t>(nodes[i])];
      role = std::max(role, static_cast<int>(i) < shape.corner_count ? Role::corner : Role::middle);
    }
  });
  std::vector<NodeIndex> kept(roles.size(), -1);
  NodeIndex count = 0;
  for (std::size_t i = 0; i < roles.size(); ++i)
    if (roles[i] != Role::middle)
      kept[i] = count++;
  return kept;
}

std::vector<NodeIndex> renumbered(NodeSpan nodes, const std::vector<NodeIndex>& kept) {
  std::vector<NodeIndex> result;
  for (const auto node : nodes)
    if (const auto index = kept[static_cast<std::size_t>(node)]; index >= 0)
      result.push_back(index);
  return result;
}

SharedNodes middles_of(const Mesh& mesh) {
  SharedNodes middles;
  for_each_cell(mesh, [&](CellIndex, const cell::CellTopology& shape, NodeSpan nodes) {
    if (shape.order != 2)
      return;
    for (std::size_t e = 0; e < shape.edges.size(); ++e)
      middles[corner_set(nodes, shape.edges[e])] = node_at(nodes, cell::mid_node(shape, e));
  });
  return middles;
}

NodeIndex middle_of_edge(MeshBuilder& builder, SharedNodes& middles, const CornerSet& edge) {
  auto& middle = middles[edge];
  if (middle == SharedNodes::none) {
    const auto& points = builder.points();
    middle = builder.add_node(
        (points[static_cast<std::size_t>(edge[0])] + points[static_cast<std::size_t>(edge[1])]) / 2);
  }
  return middle;
}

/// The centres of quadrangles (faces of full solids, QUAD9 cells) and triangles (TRIA7) that are there
/// already.
SharedNodes centres_of(const Mesh& mesh) {
  SharedNodes centres;
  for_each_cell(mesh, [&](CellIndex, const cell::CellTopology& shape, NodeSpan nodes) {
    for (const auto& side : shape.sides)
      if (const auto centre = cell::centre_node(side))
        centres[corner_set(nodes, side)] = node_at(nodes, *centre);
    if (const auto inner = cell::inner_node(shape); inner && shape.dimension == 2)
      centres[corners_of(nodes, shape)] = node_at(nodes, *inner);
  });
  return centres;
}

Vector3d reference_centre(CellType type) {
  return cell::linear_type(type) == CellType::tria3 ? Vector3d(1. / 3, 1. / 3, 0) : Vector3d(0, 0, 0);
}

bool is_eight_node_wall(const cell::CellTopology& solid, const cell::CellSide& side) {
  return side.type == CellType::quad8 && cell::linear_type(solid.type) != CellType::hexa8;
}

/// The quadrangles of prisms and pyramids: they have no centre, and cells on them must not get one.
CornerSets eight_node_walls(const Mesh& mesh) {
  CornerSets walls;
  for_each_cell(mesh, [&](CellIndex, const cell::CellTopology& shape, NodeSpan nodes) {
    for (const auto& side : shape.sides)
      if (is_eight_node_wall(shape, side))
        walls.insert(corner_set(nodes, side));
  });
  return walls;
}

class FullQuadratic {
public:
  explicit FullQuadratic(const Mesh& quadratic)
      : mesh_(quadratic), builder_(MeshBuilder::on_nodes_of(quadratic)), centres_(centres_of(quadratic)),
        walls_(eight_node_walls(quadratic)) {}

  Mesh build() && {
    for_each_cell(mesh_, [&](CellIndex cell, const cell::CellTopology& shape, NodeSpan nodes) {
      if (stays(shape, nodes))
        add_as(builder_, mesh_, cell, shape.type, nodes);
      else
        add_full_cell(cell, shape, nodes);
    });
    keep_cell_groups(builder_, mesh_);
    return std::move(builder_).build();
  }

private:
  bool stays(const cell::CellTopology& shape, NodeSpan nodes) const {
    if (cell::full_quadratic_type(shape.type, mesh_.dimension) == shape.type)
      return true;
    return shape.type == CellType::quad8 && walls_.find(corners_of(nodes, shape)) != CornerSets::none;
  }

  void add_full_cell(CellIndex cell, const cell::CellTopology& shape, NodeSpan nodes) {
    const auto type = cell::full_quadratic_type(shape.type, mesh_.dimension);
    std::vector<NodeIndex> all(nodes.begin(), nodes.end());
    if (shape.dimension == 2) {
      all.push_back(centre_of_face(shape.type, nodes));
    } else {
      for (const auto& side : shape.sides)
        all.push_back(centre_of_side(cell, nodes, side));
      all.push_back(builder_.add_node(position(shape.type, nodes, builder_.points(), Vector3d::Zero())));
    }
    add_as(builder_, mesh_, cell, type, all);
  }

  NodeIndex centre_of_side(CellIndex cell, NodeSpan nodes, const cell::CellSide& side) {
    if (walls_.find(corner_set(nodes, side)) != CornerSets::none)
      throw InputError(
          fmt::format("cannot make HEXA27 of cell {}: it shares a face with a prism or a pyramid, which "
                      "has no node at the centre of that face",
                      cell_name(mesh_, cell)));
    std::array<NodeIndex, 8> face{};
    for (std::size_t i = 0; i < face.size(); ++i)
      face[i] = nodes[side.nodes[i]];
    return centre_of_face(side.type, face);
  }

  NodeIndex centre_of_face(CellType type, NodeSpan nodes) {
    auto& centre = centres_[corners_of(nodes, cell::topology(type))];
    if (centre == SharedNodes::none)
      centre = builder_.add_node(position(type, nodes, builder_.points(), reference_centre(type)));
    return centre;
  }

  const Mesh& mesh_;
  MeshBuilder builder_;
  SharedNodes centres_;
  CornerSets walls_;
};

} // namespace

Mesh to_linear(const Mesh& mesh) {
  MeshBuilder builder(mesh.dimension);
  const auto kept = kept_nodes(mesh);
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i] >= 0)
      builder.add_node(mesh.points[i], mesh.node_numbers[i],
                       mesh.node_names.empty() ? "" : mesh.node_names[i]);
  for_each_cell(mesh, [&](CellIndex cell, const cell::CellTopology& shape, NodeSpan nodes) {
    const auto corners = nodes.first(static_cast<std::size_t>(shape.corner_count));
    add_as(builder, mesh, cell, cell::linear_type(shape.type), renumbered(corners, kept));
  });
  for (const auto& group : mesh.node_groups)
    builder.add_to_node_group(group.name, renumbered(group.items, kept));
  keep_cell_groups(builder, mesh);
  return std::move(builder).build();
}

Mesh to_quadratic(const Mesh& mesh) {
  auto builder = MeshBuilder::on_nodes_of(mesh);
  auto middles = middles_of(mesh);
  std::vector<NodeIndex> all;
  for_each_cell(mesh, [&](CellIndex cell, const cell::CellTopology& shape, NodeSpan nodes) {
    all.assign(nodes.begin(), nodes.end());
    if (shape.order == 1)
      for (const auto& edge : shape.edges)
        all.push_back(middle_of_edge(builder, middles, corner_set(nodes, edge)));
    add_as(builder, mesh, cell, cell::quadratic_type(shape.type), all);
  });
  keep_cell_groups(builder, mesh);
  return std::move(builder).build();
}

Mesh to_full_quadratic(const Mesh& mesh) {
  const auto quadratic = to_quadratic(mesh);
  return FullQuadratic(quadratic).build();
}

Mesh converted(const Mesh& mesh, study::MeshConversion conversion) {
  switch (conversion) {
  case study::MeshConversion::linear:
    return to_linear(mesh);
  case study::MeshConversion::quadratic:
    return to_quadratic(mesh);
  case study::MeshConversion::full_quadratic:
    return to_full_quadratic(mesh);
  case study::MeshConversion::none:
    break;
  }
  return mesh;
}

} // namespace rubato::mesh
