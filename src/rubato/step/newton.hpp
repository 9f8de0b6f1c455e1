// SPDX-License-Identifier: LGPL-3.0-or-later
/// Motion and contact of one implicit step solved together by Newton's method, with whatever the outer loops
/// hold.
///
/// Geometry, friction threshold and contact status that no loop holds are re-evaluated in every iteration;
/// the tangent is exact. Unknowns are the free displacements and the contact multipliers:
///   [A + f₁ ∂f_c/∂u   f₁ ∂f_c/∂λ] [d ]     [residual ]
///   [  ∂e/∂u            ∂e/∂λ   ] [dλ] = − [equations]
#pragma once

#include "rubato/step/contact_evaluator.hpp"
#include "rubato/step/equilibrium.hpp"
#include "rubato/step/pulse.hpp"

namespace rubato::step {

class Newton {
public:
  /// Everything must outlive this.
  Newton(const model::Model& model, const time::Scheme& scheme, EffectiveSystem& system,
         const State& committed, double t, const ContactEvaluator& side, Pulse& pulse);

  /// Iterates from `trial` (u, v, a, multipliers and statuses) to the end of the step.
  StepReport run(State& trial, const Held& held);

private:
  int points_in_contact() const;
  StepReport ended(Outcome outcome, const Held& held);
  void evaluate_contact(const State& trial, const Held& held, int iteration);
  void add_zone(std::size_t zone, const Held& held);
  bool settled(const State& trial, const Held& held);
  bool within_rounding(const State& trial, const Held& held) const;
  bool solve_and_correct(double part, State& trial);

  const model::Model& model_;
  const time::Scheme& scheme_;
  EffectiveSystem& system_;
  const ContactEvaluator& side_;
  Pulse& pulse_;
  Equilibrium equilibrium_;
  contact::ContactSystem contact_;
  ContactForce force_;
  ContactIterate now_, previous_;
  StepReport report_;
  StallWatch stall_;
};

} // namespace rubato::step
