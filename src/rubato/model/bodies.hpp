// SPDX-License-Identifier: LGPL-3.0-or-later
/// The connected components of the mesh: a body is what cells connect, whatever touches it.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace rubato::domain {
struct Bulk;
} // namespace rubato::domain

namespace rubato::model {

class Bodies {
public:
  Bodies(const mesh::Mesh& mesh, const domain::Bulk& bulk);
  /// What those cells connect.
  Bodies(const mesh::Mesh& mesh, std::span<const mesh::CellIndex> cells);

  /// The body of a node, −1 where no cell is.
  int of(mesh::NodeIndex node) const { return of_node_[static_cast<std::size_t>(node)]; }
  int count() const { return static_cast<int>(first_node_.size()); }
  mesh::NodeIndex first_node(int body) const { return first_node_[static_cast<std::size_t>(body)]; }

private:
  std::vector<int> of_node_;
  std::vector<mesh::NodeIndex> first_node_;
};

} // namespace rubato::model
