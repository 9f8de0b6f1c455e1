// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the project only: what a .msh file says, before it is a mesh, and the readers of its sections.
#pragma once

#include "rubato/mesh/io/msh_cells.hpp"
#include "rubato/mesh/io/msh_input.hpp"
#include "rubato/mesh/mesh.hpp"

#include <Eigen/Core>

#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace rubato::mesh::msh {

using Tag = std::int64_t;

/// A piece of the geometry, or a physical group: its dimension, and its tag among those of that dimension.
struct Entity {
  int dimension = 0;
  Tag tag = 0;
  auto operator<=>(const Entity&) const = default; // NOLINT(modernize-use-nullptr): the check errs here
};

/// Cells of one type, with the tags that Gmsh gives nodes, in our order of a cell's nodes.
struct Cells {
  std::vector<Tag> tags;
  std::vector<Tag> nodes;
};

struct CellPlace {
  CellType type;
  CellIndex index; ///< among those of the type
};

struct Content {
  std::vector<Tag> node_tags;
  std::vector<Eigen::Vector3d> points;
  std::map<CellType, Cells> cells;
  std::map<Entity, std::string> names;                ///< of physical groups
  std::map<Entity, std::vector<CellPlace>> in_group;  ///< the cells of physical groups
  std::map<Entity, std::vector<Tag>> points_in_group; ///< the nodes of physical groups of points
};

/// The type of that number. Throws InputError for one that this project doesn't know.
const KnownType& known_type(const Input& input, Tag gmsh);

/// Reads the nodes of one cell and appends them in our order.
void read_cell_nodes(Input& input, const KnownType& type, Tag (Input::*next)(std::string_view),
                     std::vector<Tag>& nodes);

/// $Nodes, $ParametricNodes and $Elements of versions 2.0 to 2.2. A cell that is in several physical groups
/// stands there once for each: it becomes one cell.
void read_nodes_2(Input& input, bool parametric, Content& content);
void read_cells_2(Input& input, Content& content);

/// The physical groups of each piece of the geometry.
using Physicals = std::map<Entity, std::vector<Tag>>;

/// $Entities, $PartitionedEntities, $Nodes and $Elements of version 4.1.
void read_entities_4(Input& input, bool partitioned, Physicals& physicals);
void read_nodes_4(Input& input, const Physicals& physicals, Content& content);
void read_cells_4(Input& input, const Physicals& physicals, Content& content);

/// Throws InputError when a cell has a node that the file doesn't give, or when there are no cells.
Mesh assembled(const Input& input, Content content);

} // namespace rubato::mesh::msh
