// SPDX-License-Identifier: LGPL-3.0-or-later
/// What is seen of a mesh: its cells in the plane, the faces of its skin in space, cut into patches of one
/// value.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace rubato::plot {

/// A part of a face over which its value is taken as constant.
struct Patch {
  std::vector<Eigen::Vector3d> corners;
  double value = 0;
};

struct Facet {
  std::vector<Patch> patches;
  std::vector<Eigen::Vector3d> outline; ///< closed; in space counter-clockwise as seen from outside
};

/// Of every face, by the shape functions of its cell. `points`: one a node, where it is drawn; `values`: one
/// a node. Bulk cells must be positive.
std::vector<Facet> facets(const mesh::Mesh& mesh, std::span<const Eigen::Vector3d> points,
                          std::span<const double> values);

/// The border of the bodies of a plane mesh, a line for each side of a cell.
std::vector<std::vector<Eigen::Vector3d>> border_lines(const mesh::Mesh& mesh,
                                                       std::span<const Eigen::Vector3d> points);

} // namespace rubato::plot
