// SPDX-License-Identifier: LGPL-3.0-or-later
/// Damping of the natural modes of bodies that nothing touches.
#pragma once

#include <Eigen/Core>

namespace rubato::model {

/// C = Σ_k 2 ξ_k ω_k M φ_k (M φ_k)ᵀ with φ_k·M φ_k = 1: each mode has its own part of critical damping, all
/// other motions none. It is no sparse matrix, and no part of effective matrices: iterations find its forces.
struct ModalDamping {
  Eigen::MatrixXd momenta; ///< M φ_k, a column a mode and a row a dof
  Eigen::VectorXd factors; ///< 2 ξ_k ω_k [1/time]

  bool empty() const { return factors.size() == 0; }
  /// C v [force]
  Eigen::VectorXd force(const Eigen::VectorXd& v) const;
};

} // namespace rubato::model
