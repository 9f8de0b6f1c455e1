// SPDX-License-Identifier: LGPL-3.0-or-later
/// What groups that are made are made of: groups of the mesh, groups made before, nodes, everything.
#pragma once

#include "rubato/mesh/face_cells.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/study/mesh_source.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace rubato::mesh {

/// What a group has. New cells are those of FaceCells.
struct GroupItems {
  bool are_cells = false;                 ///< else nodes
  std::vector<std::int32_t> items;        ///< ascending
  std::vector<std::int32_t> ordered = {}; ///< nodes along a line; else empty
};

/// What a node is to the cells that have it.
enum class NodeRole : std::uint8_t { none, middle, corner };

/// Throws InputError: the sentence at the path of a study.
[[noreturn]] void refuse(const std::string& path, std::string text);

/// "N12 (1, 0, 0.5)".
std::string place_label(const Mesh& mesh, NodeIndex node);

class GroupSources {
public:
  /// Mesh and faces must outlive it.
  GroupSources(const Mesh& mesh, const FaceCells& faces) : mesh_(mesh), faces_(faces) {}

  void add(const std::string& name, GroupItems items) { made_[name] = std::move(items); }
  bool is_made(const std::string& name) const { return made_.contains(name); }
  const GroupItems& made(const std::string& name) const { return made_.at(name); }

  /// Whether the group is made of everything, or of a group of cells.
  static bool is_of_everything(const study::MadeGroup& group);
  bool is_of_cells(const study::MadeGroup& group) const;
  /// Nodes of what the group is made of; every node of the mesh when that is everything. Throws InputError at
  /// the path of the name where there is no such group or node, or nothing in it.
  std::vector<NodeIndex> nodes(const study::MadeGroup& group) const;
  /// Cells of what it is made of; every cell of the bodies when that is everything. Throws as above, and for
  /// nodes.
  std::vector<CellIndex> cells(const study::MadeGroup& group) const;
  /// All it is made of: as cells when each name is a group of cells, else as nodes. Throws as above, and for
  /// cells beside nodes.
  std::vector<GroupItems> alike(const study::MadeGroup& group) const;

  /// Nodes of these cells, ascending.
  std::vector<NodeIndex> nodes_of(const std::vector<CellIndex>& cells) const;
  /// The role of each node of the mesh in these cells, and in all cells of the mesh but points.
  std::vector<NodeRole> roles_in(const std::vector<CellIndex>& cells) const;
  std::vector<NodeRole> roles() const;

private:
  const std::vector<std::int32_t>* cells_named(const std::string& name) const;
  /// A group of nodes, or a node.
  std::vector<NodeIndex> nodes_named(const std::string& name) const;
  [[noreturn]] void refuse_unknown(const std::string& path, const std::string& name) const;

  const Mesh& mesh_;
  const FaceCells& faces_;
  std::map<std::string, GroupItems> made_;
};

} // namespace rubato::mesh
