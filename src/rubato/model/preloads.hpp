// SPDX-License-Identifier: LGPL-3.0-or-later
/// Preloads: bodies that are cut through, whose sides approach each other.
///
/// Nodes that cells of both sides have get a twin for the cells in front of the plane. With o the node
/// behind, t its twin and n the normal, towards the front, all pairs have the same jump u_t − u_o = −δ n: one
/// unknown more, the shortening δ. A force F on it, −F n on the twin of one pair and F n on its node, is what
/// the cut transmits.
#pragma once

#include "rubato/mesh/mesh.hpp"
#include "rubato/study/study.hpp"

#include <Eigen/Core>

#include <span>
#include <string>
#include <vector>

namespace rubato {
struct Fault;
} // namespace rubato

namespace rubato::model {

struct NodePair {
  mesh::NodeIndex behind = -1;
  mesh::NodeIndex in_front = -1; ///< the twin
};

/// A preload of the study on the mesh.
struct PreloadedCut {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX(); ///< unit, towards the front
  std::vector<NodePair> pairs;                       ///< at least one; the first carries the force
};

/// Cuts the mesh for each preload of the study. Cells, also those of faces and edges, have the nodes of their
/// side; groups of nodes keep the nodes behind. Faults where a plane cuts nothing, or where cells that are
/// not cut have nodes of the cut.
std::vector<PreloadedCut> split_at_preloads(const study::Study& study, mesh::Mesh& mesh,
                                            std::vector<Fault>& faults);

/// For each node its partner behind a cut, or itself: cuts elsewhere see through it.
std::vector<mesh::NodeIndex> nodes_behind(const mesh::Mesh& mesh, std::span<const PreloadedCut> preloads);

/// Of each of the cells whether its centre lies behind a plane; on the plane is in front.
std::vector<char> behind_plane(const mesh::Mesh& mesh, std::span<const mesh::CellIndex> cells,
                               const study::Cut& plane);

} // namespace rubato::model
