// SPDX-License-Identifier: LGPL-3.0-or-later
// A halving sees each cell as a lattice of reference points at half a cell: exactly the nodes of the full
// quadratic cell of its shape. They are the corners of the children; the children's own middles and centres
// follow from those.
#include "rubato/mesh/refine.hpp"

#include "rubato/cell/parts.hpp"
#include "rubato/cell/reference_nodes.hpp"
#include "rubato/core/error.hpp"
#include "rubato/mesh/builder.hpp"
#include "rubato/mesh/corner_sets.hpp"
#include "rubato/mesh/interpolation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace rubato::mesh {
namespace {

using Eigen::Vector3d;
using NodeSpan = std::span<const NodeIndex>;
/// The corners of a child as lattice nodes.
using Child = std::array<std::uint8_t, 8>;

CellType lattice_of(CellType type) {
  switch (cell::linear_type(type)) {
  case CellType::seg2:
    return CellType::seg3;
  case CellType::tria3:
    return CellType::tria6;
  case CellType::quad4:
    return CellType::quad9;
  case CellType::tetra4:
    return CellType::tetra10;
  case CellType::penta6:
    return CellType::penta18;
  case CellType::hexa8:
    return CellType::hexa27;
  default:
    return CellType::point1;
  }
}

std::uint8_t lattice_node_at(CellType lattice, const Vector3d& xi) {
  std::uint8_t node = 0;
  while ((cell::reference_node(lattice, node) - xi).squaredNorm() > 1e-12)
    ++node;
  return node;
}

/// The children that keep a corner of the parent: the parent shrunk to half its size towards that corner.
std::vector<Child> corner_children(CellType lattice) {
  const int corners = cell::topology(lattice).corner_count;
  std::vector<Child> children(static_cast<std::size_t>(corners));
  for (int k = 0; k < corners; ++k)
    for (int c = 0; c < corners; ++c)
      children[static_cast<std::size_t>(k)][static_cast<std::size_t>(c)] =
          lattice_node_at(lattice, (cell::reference_node(lattice, k) + cell::reference_node(lattice, c)) / 2);
  return children;
}

std::vector<Child> with(std::vector<Child> children, std::initializer_list<Child> inner) {
  children.insert(children.end(), inner);
  return children;
}

/// The children of every shape; of the tetrahedron three variants, by the inner diagonal they turn around.
struct Children {
  std::vector<Child> point = corner_children(CellType::point1);
  std::vector<Child> segment = corner_children(CellType::seg3);
  std::vector<Child> triangle = with(corner_children(CellType::tria6), {{3, 4, 5}});
  std::vector<Child> quadrangle = corner_children(CellType::quad9);
  std::vector<Child> prism =
      with(corner_children(CellType::penta18), {{6, 7, 8, 15, 16, 17}, {15, 16, 17, 9, 10, 11}});
  std::vector<Child> hexahedron = corner_children(CellType::hexa27);
  std::array<std::array<std::uint8_t, 2>, 3> diagonals{{{4, 9}, {5, 7}, {6, 8}}};
  std::array<std::vector<Child>, 3> tetrahedron{
      with(corner_children(CellType::tetra10), {{4, 9, 5, 6}, {4, 9, 6, 7}, {4, 9, 7, 8}, {4, 9, 8, 5}}),
      with(corner_children(CellType::tetra10), {{7, 5, 4, 6}, {7, 5, 6, 9}, {7, 5, 9, 8}, {7, 5, 8, 4}}),
      with(corner_children(CellType::tetra10), {{6, 8, 4, 5}, {6, 8, 5, 9}, {6, 8, 9, 7}, {6, 8, 7, 4}})};
};

const Children& children_tables() {
  static const Children tables;
  return tables;
}

class Halving {
public:
  explicit Halving(const Mesh& mesh) : mesh_(mesh), builder_(MeshBuilder::on_nodes_of(mesh)) {}

  Mesh build() && {
    first_child_.reserve(static_cast<std::size_t>(mesh_.cell_count()) + 1);
    for_each_cell(mesh_, [this](CellIndex, const cell::CellTopology& shape, NodeSpan nodes) {
      first_child_.push_back(builder_.cell_count());
      split(shape, nodes);
    });
    first_child_.push_back(builder_.cell_count());
    for (const auto& group : mesh_.cell_groups)
      builder_.add_to_cell_group(group.name, children_of(group.items));
    return std::move(builder_).build();
  }

private:
  void split(const cell::CellTopology& shape, NodeSpan nodes) {
    const auto lattice = lattice_nodes(shape, nodes);
    if (shape.type == CellType::tria7)
      keep_inner_node(nodes);
    for (const auto& child : children_for(shape, lattice))
      add_child(shape, nodes, lattice, child);
  }

  std::vector<NodeIndex> lattice_nodes(const cell::CellTopology& shape, NodeSpan nodes) {
    const auto& lattice = cell::topology(lattice_of(shape.type));
    const auto corners = static_cast<std::size_t>(shape.corner_count);
    std::vector<NodeIndex> result(nodes.begin(), nodes.begin() + shape.corner_count);
    const auto next_xi = [&] { return cell::reference_node(lattice.type, static_cast<int>(result.size())); };

    for (std::size_t e = 0; e < shape.edges.size(); ++e)
      result.push_back(shape.order == 2
                           ? nodes[corners + e]
                           : shared(middles_, corner_set(nodes, shape.edges[e]), shape, nodes, next_xi()));
    for (std::size_t s = 0; s < lattice.sides.size(); ++s) {
      if (!cell::centre_node(lattice.sides[s]))
        continue;
      const auto own = cell::centre_node(shape.sides[s]);
      result.push_back(own ? nodes[static_cast<std::size_t>(*own)]
                           : shared(centres_, corner_set(nodes, shape.sides[s]), shape, nodes, next_xi()));
    }
    if (cell::inner_node(lattice))
      result.push_back(inner_lattice_node(shape, nodes));
    return result;
  }

  NodeIndex inner_lattice_node(const cell::CellTopology& shape, NodeSpan nodes) {
    if (const auto own = cell::inner_node(shape))
      return nodes[static_cast<std::size_t>(*own)];
    const Vector3d xi = Vector3d::Zero();
    if (shape.dimension == 3)
      return new_node(shape, nodes, xi);
    return shared(centres_, corner_set(nodes.first(static_cast<std::size_t>(shape.corner_count))), shape,
                  nodes, xi);
  }

  /// The node at the centroid of TRIA7 becomes that of its middle child.
  void keep_inner_node(NodeSpan nodes) { centres_[corner_set(nodes.subspan(3, 3))] = nodes[6]; }

  std::span<const Child> children_for(const cell::CellTopology& shape, NodeSpan lattice) const {
    const auto& tables = children_tables();
    switch (cell::linear_type(shape.type)) {
    case CellType::seg2:
      return tables.segment;
    case CellType::tria3:
      return tables.triangle;
    case CellType::quad4:
      return tables.quadrangle;
    case CellType::tetra4:
      return tables.tetrahedron[shortest_diagonal(lattice)];
    case CellType::penta6:
      return tables.prism;
    case CellType::hexa8:
      return tables.hexahedron;
    default:
      return tables.point;
    }
  }

  std::size_t shortest_diagonal(NodeSpan lattice) const {
    const auto& diagonals = children_tables().diagonals;
    const auto length = [&](std::size_t d) {
      return (point(lattice[diagonals[d][0]]) - point(lattice[diagonals[d][1]])).squaredNorm();
    };
    std::size_t shortest = 0;
    for (std::size_t d = 1; d < diagonals.size(); ++d)
      // Equal lengths must not be told apart by rounding.
      if (length(d) < (1 - 1e-9) * length(shortest))
        shortest = d;
    return shortest;
  }

  void add_child(const cell::CellTopology& shape, NodeSpan parent, NodeSpan lattice, const Child& child) {
    const auto lattice_type = lattice_of(shape.type);
    const auto corners = static_cast<std::size_t>(shape.corner_count);
    const auto centre_of = [&](std::span<const std::uint8_t> local_corners) {
      Vector3d sum = Vector3d::Zero();
      for (const auto corner : local_corners)
        sum += cell::reference_node(lattice_type, child[corner]);
      return Vector3d(sum / static_cast<double>(local_corners.size()));
    };
    std::vector<NodeIndex> nodes;
    for (std::size_t c = 0; c < corners; ++c)
      nodes.push_back(lattice[child[c]]);
    if (shape.order == 2)
      for (const auto& edge : shape.edges)
        nodes.push_back(shared(middles_, corner_set(nodes, edge), shape, parent, centre_of(edge)));
    for (const auto& side : shape.sides)
      if (cell::centre_node(side))
        nodes.push_back(
            shared(centres_, corner_set(nodes, side), shape, parent, centre_of(side.nodes.first(4))));
    if (cell::inner_node(shape)) {
      constexpr std::array<std::uint8_t, 8> all{0, 1, 2, 3, 4, 5, 6, 7};
      const auto xi = centre_of(std::span(all).first(corners));
      nodes.push_back(shape.dimension == 3
                          ? new_node(shape, parent, xi)
                          : shared(centres_, corner_set(std::span(nodes).first(corners)), shape, parent, xi));
    }
    builder_.add_cell(shape.type, nodes);
  }

  NodeIndex shared(SharedNodes& known, const CornerSet& corners, const cell::CellTopology& shape,
                   NodeSpan parent, const Vector3d& xi) {
    auto& node = known[corners];
    if (node == SharedNodes::none)
      node = new_node(shape, parent, xi);
    return node;
  }

  NodeIndex new_node(const cell::CellTopology& shape, NodeSpan parent, const Vector3d& xi) {
    return builder_.add_node(position(shape.type, parent, builder_.points(), xi));
  }

  const Vector3d& point(NodeIndex node) const { return builder_.points()[static_cast<std::size_t>(node)]; }

  std::vector<MeshBuilder::CellHandle> children_of(std::span<const CellIndex> parents) const {
    std::vector<MeshBuilder::CellHandle> children;
    for (const auto parent : parents) {
      const auto i = static_cast<std::size_t>(parent);
      for (auto child = first_child_[i]; child < first_child_[i + 1]; ++child)
        children.push_back(child);
    }
    return children;
  }

  const Mesh& mesh_;
  MeshBuilder builder_;
  SharedNodes middles_;
  SharedNodes centres_;
  std::vector<MeshBuilder::CellHandle> first_child_;
};

void refuse_bad_input(const Mesh& mesh, int parts) {
  if (parts < 1 || !std::has_single_bit(static_cast<unsigned>(parts)))
    throw InputError(
        fmt::format("cannot cut the edges of this mesh into {} parts: a mesh that is not made from bodies is "
                    "refined by halving, so 1, 2, 4, 8… are expected",
                    parts));
  for (const auto& block : mesh.blocks)
    if (cell::linear_type(block.type) == CellType::pyra5 || block.type == CellType::penta18)
      throw InputError(
          fmt::format("cannot refine {} {} cells: pyramids and 18-node prisms have no children of "
                      "their own type here",
                      block.cell_count(), cell::topology(block.type).name));
  const double growth = std::pow(double(parts), mesh.dimension);
  const double largest = growth * std::max(mesh.node_count(), mesh.cell_count());
  if (largest > std::numeric_limits<NodeIndex>::max())
    throw InputError(
        fmt::format("cannot cut the edges of this mesh into {} parts: about {:.1e} nodes or cells would "
                    "come of it, {:.1e} are possible",
                    parts, largest, double(std::numeric_limits<NodeIndex>::max())));
}

} // namespace

Mesh refined(const Mesh& mesh, int parts) {
  refuse_bad_input(mesh, parts);
  Mesh result = mesh;
  for (; parts > 1; parts /= 2)
    result = Halving(result).build();
  return result;
}

} // namespace rubato::mesh
