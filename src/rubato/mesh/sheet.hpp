// SPDX-License-Identifier: LGPL-3.0-or-later
/// Faces without cells behind them (segments in 2D): sheets, whose sides only their numbering tells apart.
#pragma once

#include "rubato/mesh/skin.hpp"

#include <Eigen/Core>

#include <span>
#include <string>
#include <vector>

namespace rubato::mesh {

struct Sheets {
  /// One a cell asked for, in their order; the normals of each sheet look to the same side.
  std::vector<SurfaceFace> faces;
  std::vector<int> sheet_of_face;
  int count = 0;
  /// What keeps them from having two sides, one sentence each: edges where more than two faces meet, or a
  /// sheet with one side.
  std::vector<std::string> faults;
};

/// `cells` are faces, in 2D segments. Faces that share an edge (in 2D a node) belong to one sheet.
Sheets sheets_of(const Mesh& mesh, std::span<const CellIndex> cells);

/// Turns a face's normal to the other side.
void turn(SurfaceFace& face);

/// Of the corners [area in 3D, length in 2D]: as long as the face is large.
Eigen::Vector3d normal_of(const Mesh& mesh, const SurfaceFace& face);
/// Mean of the corners.
Eigen::Vector3d centre_of(const Mesh& mesh, const SurfaceFace& face);

} // namespace rubato::mesh
