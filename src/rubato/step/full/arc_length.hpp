// SPDX-License-Identifier: LGPL-3.0-or-later
/// Static steps of a given length along the path of equilibrium, the factor of the loads unknown: past limit
/// loads and back (E. Riks 1979; M. A. Crisfield, A fast incremental/iterative solution procedure that
/// handles "snap-through", Computers and Structures 13, 1981). docs/theory/bulk-newton.md#loads-along-a-path.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/step/state.hpp"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace rubato::step {

/// Lengths are root mean squares of the displacements of the measured nodes.
class ArcLength {
public:
  /// Nothing where the study has no arc length. `committed`: must outlive this; `step`: of time.
  static std::optional<ArcLength> of(const model::Model& model, const State& committed, double step);

  /// By how much the factor of the loads changes in an iterate that goes from displacements u on by
  /// `correction` and by so many times `by_load`, the displacement of a factor of one, all one a dof. Where
  /// no change gives the length of the step: what comes nearest to it. Nothing comes back when the loads move
  /// no measured node.
  std::optional<double> change(const Eigen::VectorXd& u, const Eigen::VectorXd& correction,
                               const Eigen::VectorXd& by_load) const;

  /// Whether the displacements are as far from the start of the step as they should be.
  bool is_met(const Eigen::VectorXd& u) const;

  /// Whether the step goes back where the last one came from.
  bool goes_back(const Eigen::VectorXd& u) const;

private:
  ArcLength(const model::Model& model, const State& committed, double length);
  Eigen::VectorXd measured(const Eigen::VectorXd& full) const;

  const State* committed_;
  std::vector<int> dofs_;
  double length_; ///< of the step, as the norm of what is measured
};

} // namespace rubato::step
