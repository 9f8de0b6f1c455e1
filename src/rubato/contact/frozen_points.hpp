// SPDX-License-Identifier: LGPL-3.0-or-later
/// The points of a zone whose geometry is that of the undeformed bodies (`freeze`, `tie`): which nodes each
/// faces, and its frame, are found once. Gaps and slips are linear in the displacements then.
#pragma once

#include "rubato/contact/enforcement.hpp"
#include "rubato/contact/tie_gap.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace rubato::contact {

class FrozenPoints {
public:
  /// Of a zone that outlives it.
  explicit FrozenPoints(const Zone& zone) : zone_(&zone) {}

  /// Takes the chosen points to a configuration, with derivatives.
  void measure(const Eigen::VectorXd& multipliers, const Configuration& configuration,
               std::span<const std::size_t> chosen, std::vector<PointEvaluation>& into);
  /// All of them.
  void measure(const Eigen::VectorXd& multipliers, const Configuration& configuration,
               std::vector<PointEvaluation>& into);

  const Zone& zone() const { return *zone_; }

private:
  void make_frames(const Configuration& configuration);
  void measure(std::size_t point, const Eigen::VectorXd& multipliers, const Configuration& configuration,
               PointEvaluation& into) const;

  const Zone* zone_;
  std::vector<PointEvaluation> frames_;   ///< where nothing has moved
  std::vector<std::vector<TieGap>> gaps_; ///< of ties in finite strain, else none
};

void evaluate(FrozenPoints& points, const Eigen::VectorXd& multipliers, const Configuration& configuration,
              std::vector<PointEvaluation>& into);
void measure(FrozenPoints& points, const Eigen::VectorXd& multipliers, const Configuration& configuration,
             std::vector<PointEvaluation>& into);
void measure(FrozenPoints& points, const Eigen::VectorXd& multipliers, const Configuration& configuration,
             std::span<const std::size_t> chosen, std::vector<PointEvaluation>& into);

} // namespace rubato::contact
