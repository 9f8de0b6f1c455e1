// SPDX-License-Identifier: LGPL-3.0-or-later
/// The mesh of a study: a file or bodies that are generated, and what is done with them.
#pragma once

#include "rubato/core/cell_type.hpp"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rubato::study {

/// A box or a rectangle cut into a regular grid.
struct Body {
  std::string name;
  int dimension = 3; ///< 2: rectangle, 3: box
  std::array<double, 3> from{};
  std::array<double, 3> to{};
  std::array<int, 3> divisions{1, 1, 1};
  CellType cells = CellType::hexa8;
  /// Group names of the sides: keys left, right (x), bottom, top (y), back, front (z).
  std::map<std::string, std::string> sides;
  /// Group names of edges (3D) and of corner points, by the sides that meet there: "right_top",
  /// "right_top_back". In 2D a corner is "right_top".
  std::map<std::string, std::string> edges;
  std::map<std::string, std::string> points;
  bool operator==(const Body&) const = default;
};

enum class MeshConversion { none, linear, quadratic, full_quadratic };

/// How a group is made; docs/guide/deck.md has the words.
enum class GroupKind {
  union_of,     ///< what is in one of `of`, or in several
  intersection, ///< what is in all of `of`
  difference,   ///< what is in the first of `of` and in none of the others
  box,          ///< from `from` to `to`
  sphere,       ///< about `point`; in 2D a circle
  cylinder,     ///< about the axis through `point` along `direction`, without ends; 3D only
  plane,        ///< through `point`, across `direction`; in 2D a straight line
  normal,       ///< faces whose outward normal is within `angle` of `direction`
  skin,         ///< faces of the part that bound the bodies
  nodes_of,     ///< every node of the cells
  corners_of,   ///< nodes at corners of cells
  middles_of,   ///< nodes between corners and inside of cells
  along         ///< nodes ordered by how far they are along `direction`
};

/// What of the mesh a shape chooses.
enum class GroupTake { nodes, faces, cells };

/// A group that is made of what the mesh has. In 2D faces are the edges of the bodies and z is 0.
struct MadeGroup {
  std::string name;
  GroupKind kind = GroupKind::box;
  /// Groups it is made of: at least two of the first three kinds; of the others one, or none for everything.
  std::vector<std::string> of;
  std::array<double, 3> from{};      ///< least coordinates of the box [length]
  std::array<double, 3> to{};        ///< greatest ones
  std::array<double, 3> point{};     ///< [length]
  std::array<double, 3> direction{}; ///< of any length > 0
  double radius = 0;                 ///< > 0 [length]
  /// Largest distance from the plane, or from the surface of the sphere or the cylinder [length]. Not given:
  /// on the plane, inside of the others.
  std::optional<double> within = {};
  double angle = 30; ///< [degrees]
  GroupTake take = GroupTake::nodes;
  bool operator==(const MadeGroup&) const = default;
};

struct MeshSource {
  std::string file;         ///< empty when generated; found from the current folder
  std::string file_mesh;    ///< name of the mesh inside the file; empty: its only (first) one
  std::vector<Body> bodies; ///< empty when read
  MeshConversion convert = MeshConversion::none;
  int refine = 1;                ///< every edge is cut into that many parts
  std::vector<MadeGroup> groups; ///< made when that is done; one may be made of others
  bool operator==(const MeshSource&) const = default;
};

} // namespace rubato::study
