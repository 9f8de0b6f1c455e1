// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a mesh holds, how good its cells are and what looks wrong with it.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rubato::mesh {

struct TypeQuality {
  CellType type = CellType::point1;
  CellIndex count = 0;
  /// Scaled Jacobian: 1 for the ideal cell, 0 for a flat one, −1…0 when inverted somewhere. Not for
  /// points and segments.
  bool has_jacobian = false;
  double smallest_jacobian = std::numeric_limits<double>::infinity();
  double mean_jacobian = 0;
  std::string worst_cell; ///< its name or number in the file
};

struct GroupSummary {
  enum class Kind { nodes, cells };
  std::string name;
  Kind kind = Kind::nodes;
  int dimension = 0;  ///< of its cells, the largest when mixed; 0 for nodes and empty groups
  bool mixed = false; ///< cells of several dimensions
  std::size_t count = 0;
};

/// How many, and what the file calls the first few of them: names, or numbers where it gives no names.
struct Findings {
  static constexpr std::size_t shown = 8;
  std::int64_t count = 0;
  std::vector<std::string> first;
};

/// Scaled Jacobian below which a cell is nearly flat: its matrix maps what is linear badly, and stresses
/// there are not to be trusted.
inline constexpr double least_jacobian = 0.1;

struct MeshReport {
  int dimension = 3;
  NodeIndex nodes = 0;
  bool names_nodes = false; ///< the file gives its nodes names: decks call them by these, not by numbers
  std::vector<TypeQuality> types;
  std::vector<GroupSummary> groups;
  Eigen::Vector3d lower = Eigen::Vector3d::Zero(); ///< bounding box
  Eigen::Vector3d upper = Eigen::Vector3d::Zero();
  double shortest_edge = 0; ///< between corners; 0 when there are no edges
  double longest_edge = 0;
  double bulk_measure = 0;  ///< sum of the volumes (2D: areas) that the corners of the bulk cells span
  int connected_bodies = 0; ///< sets of bulk cells that share nodes

  // What looks wrong.
  Findings lost_nodes;      ///< nodes with a coordinate that is not finite
  Findings free_nodes;      ///< nodes of no cell
  Findings inverted_cells;  ///< bulk cells whose Jacobian is not positive at some corner, reversed or not
  Findings flat_cells;      ///< others whose scaled Jacobian is below least_jacobian
  Findings duplicate_nodes; ///< nodes at the place of another node of the same body (or of no body)
  Findings loose_cells;     ///< cells not connected to any bulk cell
  Findings unowned_faces;   ///< cells of one dimension less than space that are no side of a bulk cell
  std::vector<std::string> empty_groups;
  bool has_bulk_cells = true;
  bool looks_right() const;

  // Worth a note only.
  Findings reversed_cells; ///< bulk cells whose nodes ran the wrong way round: runs mend them
  int flat_axis = -1; ///< of a mesh in space with nothing but faces: the axis along which it has no extent
  std::int64_t coincident_between_bodies =
      0; ///< nodes at the place of a node of another body: fine for contact
};

/// Cells count with the orientation that runs give them (mend_orientation). Nodes count as coincident when
/// nearer than coordinate_rounding of the bounding box' diagonal.
MeshReport examine(const Mesh& mesh);

/// The least of the Jacobian determinants at the corners, each divided by the lengths of the edge tangents
/// there and by its value in the ideal cell (square, cube, equilateral triangle, regular tetrahedron, …).
/// Quadratic edges count with their tangent at the corner, so a misplaced middle node shows. Surface cells
/// in 3D are measured along their own mean normal. Knupp, "Algebraic mesh quality metrics", SIAM J. Sci.
/// Comput. 23 (2001). Nothing for points and segments.
std::optional<double> scaled_jacobian(CellType type, std::span<const NodeIndex> nodes,
                                      const std::vector<Eigen::Vector3d>& points, int space_dimension);

/// The report as text for a terminal, lines ended by '\n'.
std::string to_text(const MeshReport& report);

} // namespace rubato::mesh
