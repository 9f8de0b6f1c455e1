// SPDX-License-Identifier: LGPL-3.0-or-later
/// Points that move as a group of nodes does as a whole: references of rigid and distributed relations; and
/// places in cells.
#pragma once

#include "rubato/domain/dof_map.hpp"
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

/// The motion of a reference is `motion` · u of `dofs`: its displacement [length], one row a direction, then
/// its rotation [radians], in the plane about z, in space about x, y and z. It is the rigid motion that is
/// nearest to the displacements of the group's nodes in the least squares, all nodes counting alike; of a
/// group that moves as a rigid body it is that motion. Forces and moments on the reference act on the nodes
/// by its transpose, so that they do the same work.
struct Reference {
  std::string name;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  std::vector<mesh::NodeIndex>
      nodes; ///< of the group, those that cells have; of the cell that the place is in
  std::vector<int> dofs;
  Eigen::MatrixXd motion;
  double size = 0; ///< of the group, from the reference to the farthest node [length]
  bool turns =
      true; ///< whether it has a rotation: not of nodes in one point, or in space on a line; not in a cell
};

/// Of all relations of the study that have one; faults where there are no nodes, or where names of references
/// are names of the mesh.
std::vector<Reference> make_references(const study::Study& study, const mesh::Mesh& mesh,
                                       const domain::DofMap& dofs, std::vector<Fault>& faults);

/// The one of that name; null when there is none.
const Reference* reference_named(std::span<const Reference> references, const std::string& name);

/// The mean of their places, of at least one node.
Eigen::Vector3d mean_place(const mesh::Mesh& mesh, std::span<const mesh::NodeIndex> nodes);

/// Displacements of a group's nodes by a rigid motion of 1 about its reference, rotations times its size: one
/// row a dof, one column a motion.
Eigen::MatrixXd rigid_motions_of(const Reference& reference, const mesh::Mesh& mesh, int components);

} // namespace rubato::model
