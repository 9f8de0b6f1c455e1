// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/full/symmetric_system.hpp"

namespace rubato::step {

std::optional<Eigen::VectorXd> SymmetricSystem::solve(const EffectiveSystem& system,
                                                      const Eigen::VectorXd& right_side) {
  if (!factor_ || !same_values(of_, system.tangent)) {
    factor_ = linalg::SymmetricFactor::of(system.matrix);
    of_ = system.tangent;
    ++factorisations_;
  }
  if (!factor_)
    return std::nullopt;
  return factor_->solve(right_side);
}

} // namespace rubato::step
