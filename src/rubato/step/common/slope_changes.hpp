// SPDX-License-Identifier: LGPL-3.0-or-later
/// Newton's iteration for springs and dashpots by tables, with a factor that has other slopes of them.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/model/springs.hpp"
#include "rubato/step/interface/compliance.hpp"
#include "rubato/time/scheme.hpp"

#include <Eigen/Core>

#include <vector>

namespace rubato::step {

/// The effective matrix at hand is A + R D Rᵀ, A the factored one, R with a column a connector that has a
/// table, D the change of its slope. Sherman, Morrison and Woodbury:
///   (A + R D Rᵀ)⁻¹ r = A⁻¹ (r − R y),   y = (1 + D Rᵀ A⁻¹ R)⁻¹ D Rᵀ A⁻¹ r
class SlopeChanges {
public:
  /// No connectors with tables.
  SlopeChanges() = default;
  /// The model must outlive this.
  SlopeChanges(const model::Model& model, const Compliance& compliance, const time::StepCoefficients& step);

  bool empty() const { return places_.empty(); }
  /// r − R y at a motion: what A answers as the matrix at hand would answer to r, one an unknown each.
  Eigen::VectorXd adjusted(const Eigen::VectorXd& residual, const time::Motion& motion) const;

private:
  const model::Model* model_ = nullptr;
  time::StepCoefficients step_;
  std::vector<std::size_t> places_; ///< in Model::connectors
  Eigen::MatrixXd rows_;            ///< R
  Eigen::MatrixXd answers_;         ///< A⁻¹ R
  Eigen::MatrixXd between_;         ///< Rᵀ A⁻¹ R
};

/// D of a connector: what A lacks of its slopes at a motion.
double slope_change(const model::Connector& connector, const time::StepCoefficients& step,
                    const time::Motion& motion);

} // namespace rubato::step
