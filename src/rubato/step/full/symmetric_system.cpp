// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/full/symmetric_system.hpp"

#include "rubato/linalg/ranked_matrix.hpp"
#include "rubato/model/model.hpp"

namespace rubato::step {

std::optional<Eigen::VectorXd> SymmetricSystem::solve(const model::Model& model,
                                                      const EffectiveSystem& system,
                                                      const Eigen::VectorXd& right_side) {
  if (!factor_ || !same_values(model, of_, system.tangent)) {
    factor_ = linalg::SymmetricFactor::of(linalg::WholeMatrix(system.matrix, model.sharing()).get());
    of_ = system.tangent;
    ++factorisations_;
  }
  const auto ranks = model.sharing();
  if (!ranks.of_first(factor_.has_value()))
    return std::nullopt;
  // Each rank's own need not have the same last digits.
  return linalg::of_first(factor_ ? factor_->solve(right_side) : right_side, ranks);
}

} // namespace rubato::step
