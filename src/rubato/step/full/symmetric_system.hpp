// SPDX-License-Identifier: LGPL-3.0-or-later
/// The effective matrix alone, which may have negative eigenvalues: bodies that nothing touches beyond a
/// limit load or a bifurcation.
#pragma once

#include "rubato/linalg/direct_solver.hpp"
#include "rubato/step/common/effective_system.hpp"

#include <Eigen/Core>

#include <optional>

namespace rubato::step {

/// Keeps the factor as long as the tangent of the system stays.
class SymmetricSystem {
public:
  /// A⁻¹ of a right side on free dofs. Nothing comes back when A is singular.
  std::optional<Eigen::VectorXd> solve(const model::Model& model, const EffectiveSystem& system,
                                       const Eigen::VectorXd& right_side);

  int factorisations() const { return factorisations_; }
  /// Negative eigenvalues of the last one.
  int negative() const { return factor_ ? factor_->negative_pivots() : 0; }

private:
  std::optional<linalg::SymmetricFactor> factor_;
  Tangent of_;
  int factorisations_ = 0;
};

} // namespace rubato::step
