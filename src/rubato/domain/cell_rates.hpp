// SPDX-License-Identifier: LGPL-3.0-or-later
/// How fast cells vibrate each for itself: λ of K_e x = λ M_e x, M_e lumped [1/time²]. The largest λ of the
/// whole is at most the largest of its cells (B. M. Irons, G. Treharne, A bound theorem in eigenvalues and
/// its practical applications, Proc. 3rd Conf. Matrix Methods in Structural Mechanics, 1971, 245–254).
#pragma once

#include "rubato/domain/bulk.hpp"

#include <Eigen/Core>

namespace rubato::domain {

/// Matrices of one cell that nothing has happened to.
struct CellVibration {
  Eigen::MatrixXd stiffness; ///< [force/length]
  Eigen::VectorXd mass;      ///< one a node [mass]

  /// ‖K_e‖ over the least mass, ‖K_e‖ the root of the sum of the squares of its entries, which is the same
  /// however the cell is turned: not below the largest λ. Infinite where a node has no mass.
  double bound() const;
  /// The largest λ. Every node must have mass.
  double largest() const;
};

/// `cell`: a place in Bulk::cells.
CellVibration vibration_of(const mesh::Mesh& mesh, const Bulk& bulk, std::size_t cell);

} // namespace rubato::domain
