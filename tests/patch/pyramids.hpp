// SPDX-License-Identifier: LGPL-3.0-or-later
/// Blocks of pyramids, made of blocks of hexahedra.
#pragma once

#include "rubato/mesh/builder.hpp"

#include <algorithm>
#include <vector>

namespace rubato::test {

/// Cuts each HEXA8 into three pyramids with their apex in one of its corners, c: the three sides at c become
/// triangles, the other three stay quadrangles. Corners alternate from cell to cell, so that cells fit; of
/// the sides at the height y = 1 all are triangles, or none. `n`: cells of a unit length.
class PyramidCut {
public:
  PyramidCut(const mesh::Mesh& mesh, int n, bool triangles)
      : mesh_(mesh), n_(n), triangles_(triangles), builder_(mesh::MeshBuilder::on_nodes_of(mesh)) {}

  mesh::Mesh cut() && {
    mesh::for_each_cell(mesh_, [&](mesh::CellIndex, const cell::CellTopology& shape, auto nodes) {
      if (shape.type == CellType::hexa8)
        apexes_.push_back(apex_of(nodes));
    });
    std::vector<std::vector<mesh::MeshBuilder::CellHandle>> pieces;
    mesh::for_each_cell(mesh_, [&](mesh::CellIndex, const cell::CellTopology& shape, auto nodes) {
      pieces.push_back(shape.type == CellType::hexa8 ? cut_box(shape, nodes) : cut_face(nodes));
    });
    for (const auto& group : mesh_.cell_groups)
      for (const auto item : group.items)
        builder_.add_to_cell_group(group.name, pieces[static_cast<std::size_t>(item)]);
    return std::move(builder_).build();
  }

private:
  using Nodes = std::span<const mesh::NodeIndex>;
  using Handles = std::vector<mesh::MeshBuilder::CellHandle>;

  const Eigen::Vector3d& point(mesh::NodeIndex node) const {
    return mesh_.points[static_cast<std::size_t>(node)];
  }

  Eigen::Vector3d centre(Nodes nodes) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto node : nodes)
      sum += point(node);
    return sum / static_cast<double>(nodes.size());
  }

  mesh::NodeIndex apex_of(Nodes nodes) const {
    const Eigen::Vector3d middle = centre(nodes);
    const auto layer = [&](double x) { return static_cast<int>(x * n_); };
    const bool nearer = layer(std::abs(middle[1] - 1)) % 2 == 0;
    const bool above = middle[1] > 1;
    const std::array<bool, 3> high{layer(middle[0]) % 2 == 1, (nearer == triangles_) != above,
                                   layer(middle[2]) % 2 == 1};
    return *std::ranges::find_if(nodes, [&](mesh::NodeIndex node) {
      for (int a = 0; a < 3; ++a)
        if ((point(node)[a] > middle[a]) != high[static_cast<std::size_t>(a)])
          return false;
      return true;
    });
  }

  Handles cut_box(const cell::CellTopology& shape, Nodes nodes) {
    const auto apex = apex_of(nodes);
    Handles handles;
    for (const auto& side : shape.sides) {
      std::vector<mesh::NodeIndex> pyramid;
      for (const auto local : side.nodes)
        pyramid.insert(pyramid.begin(), nodes[local]); // reversed: the base is seen from the apex
      if (std::ranges::find(pyramid, apex) != pyramid.end())
        continue;
      pyramid.push_back(apex);
      handles.push_back(builder_.add_cell(CellType::pyra5, pyramid));
    }
    return handles;
  }

  Handles cut_face(Nodes nodes) {
    for (std::size_t i = 0; i < 4; ++i) {
      const auto corner = [&](std::size_t k) { return nodes[(i + k) % 4]; };
      if (std::ranges::find(apexes_, corner(0)) == apexes_.end())
        continue;
      return {builder_.add_cell(CellType::tria3, std::array{corner(0), corner(1), corner(2)}),
              builder_.add_cell(CellType::tria3, std::array{corner(0), corner(2), corner(3)})};
    }
    return {builder_.add_cell(CellType::quad4, nodes)};
  }

  const mesh::Mesh& mesh_;
  int n_;
  bool triangles_;
  mesh::MeshBuilder builder_;
  std::vector<mesh::NodeIndex> apexes_;
};

} // namespace rubato::test
