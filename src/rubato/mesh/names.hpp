// SPDX-License-Identifier: LGPL-3.0-or-later
/// What decks and command lines call nodes, and what messages call nodes and cells.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace rubato::mesh {

/// The nodes a name stands for, ascending, or a sentence that says why it stands for none.
struct FoundNodes {
  std::vector<NodeIndex> nodes;
  std::string fault; ///< empty when there are nodes
};

/// A group of nodes, else the nodes of a group of cells, else a single node. Where the file names its nodes a
/// node is found by that name alone; where it does not, by its number in the file ("N90" or "90"). A name
/// that could mean two different things is a fault, never a choice.
FoundNodes find_nodes(const Mesh& mesh, std::string_view name);

/// What the file calls the node ("N90" where it only numbers its nodes): find_nodes finds it by this name.
std::string node_name(const Mesh& mesh, NodeIndex node);

/// Gives the nodes whose name is empty a name by their number, "N90", or "N90_" where another node has that,
/// once any node has a name, and drops the names when none has; in the same way cells, "M90". A list of names
/// that is shorter than that of the numbers lacks the last ones.
void name_the_rest(Mesh& mesh);

/// What the file calls the cell: its name, or its number.
std::string cell_name(const Mesh& mesh, CellIndex cell);

} // namespace rubato::mesh
