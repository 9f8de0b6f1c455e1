// SPDX-License-Identifier: LGPL-3.0-or-later
/// Stresses for people to look at: from quadrature points to nodes.
#pragma once

#include "rubato/domain/bulk.hpp"
#include "rubato/domain/dof_map.hpp"

#include <Eigen/Core>

namespace rubato::domain {

struct NodalStress {
  Eigen::Matrix<double, 6, Eigen::Dynamic>
      stress;                ///< xx yy zz xy yz xz in one column a mesh node; 0 off the bulk
  Eigen::VectorXd von_mises; ///< of the averaged stress
};

/// Takes values at the points of cell::stiffness_rule to the nodes of the cell, nodes × points: the linear
/// functions of the corners that fit the points best (least squares), evaluated at every node. Throws
/// std::invalid_argument for cells without mechanics.
const Eigen::MatrixXd& extrapolation(CellType type);

/// Stress of the displacement `u` (size dof_count) extrapolated cell by cell, averaged at each node over its
/// cells with equal weights. Where materials meet, the average hides a jump: call it with the cells of one
/// material to see it.
NodalStress nodal_stress(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                         const Eigen::VectorXd& u);

} // namespace rubato::domain
