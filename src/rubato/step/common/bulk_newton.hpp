// SPDX-License-Identifier: LGPL-3.0-or-later
/// Newton's iterations of a nonlinear bulk around whatever solves a step with one tangent: what every
/// iterate of the bulk asks for, and when there are too many of them.
#pragma once

#include "rubato/step/common/bulk_tangent.hpp"
#include "rubato/step/common/equilibrium.hpp"
#include "rubato/step/report.hpp"
#include "rubato/step/state.hpp"

#include <limits>
#include <optional>

namespace rubato::step {

class BulkNewton {
public:
  /// Everything must outlive this.
  BulkNewton(const model::Model& model, const time::Scheme& scheme, EffectiveSystem& system,
             const State& committed, double t);

  /// What the first iterate starts from. Then the factor may be another one.
  BulkStart start();

  /// Shortens the move from `from` until every cell has forces. Nothing comes back when that has no end.
  /// How much of the move is left, else.
  std::optional<double> shorten(const time::Motion& from, time::Motion& to, Equilibrium& equilibrium) const;

  /// What is out of balance before the first iterate [force].
  void start_with(double unbalanced) { last_ = unbalanced; }
  /// After an iterate at `u` that leaves so much out of balance: an outcome ends the step. `renewed()` says
  /// then whether the factor is another one.
  std::optional<Outcome> go_on(const Eigen::VectorXd& u, double unbalanced);
  bool renewed() const { return renewed_; }

  /// What there is to tell of a step whose outcome the report has already.
  void fill(StepReport& report, const Equilibrium& equilibrium) const;

private:
  const model::Model& model_;
  BulkTangent tangent_;
  double last_ = std::numeric_limits<double>::infinity(); ///< out of balance [force]
  int iterations_ = 0;
  int growing_ = 0; ///< iterates one after the other whose residual has grown with a new tangent
  bool renewed_ = false;
};

} // namespace rubato::step
