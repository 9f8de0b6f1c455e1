// SPDX-License-Identifier: LGPL-3.0-or-later
/// Motion and contact of one implicit step solved together by Newton's method, with whatever the outer loops
/// hold.
///
/// Geometry, friction threshold and contact status that no loop holds are re-evaluated in every iteration;
/// the tangent is exact. Unknowns are the free displacements and the contact multipliers:
///   [A + f₁ ∂f_c/∂u   f₁ ∂f_c/∂λ] [d ]     [residual ]
///   [  ∂e/∂u            ∂e/∂λ   ] [dλ] = − [equations]
#pragma once

#include "rubato/model/model.hpp"
#include "rubato/step/effective_system.hpp"
#include "rubato/step/report.hpp"
#include "rubato/step/state.hpp"
#include "rubato/time/scheme.hpp"

#include <vector>

namespace rubato::step {

/// How an attempt at a step differs from the plain one.
struct Variant {
  double friction_part = 1;       ///< of μ
  double normal_multiple = 1;     ///< of c where it is an augmentation
  double tangential_multiple = 1; ///< of c_t where it is an augmentation
};

/// What outer loops hold of one zone while Newton iterates; empty: nothing.
struct HeldZone {
  std::vector<contact::PointEvaluation> frames;
  std::vector<double> thresholds;
  std::vector<contact::Status> status;
};
using Held = std::vector<HeldZone>; ///< one a zone

/// Contact of all zones at one iterate.
struct ContactIterate {
  std::vector<std::vector<contact::PointEvaluation>> points;
  std::vector<std::vector<contact::Status>> status;
};

class Newton {
public:
  Newton(const model::Model& model, const time::Scheme& scheme, EffectiveSystem& system,
         const State& committed, double t, const Variant& variant);

  /// Iterates from `trial` (u, v, a, multipliers and statuses) to the end of the step.
  StepReport run(State& trial, const Held& held);

  /// Contact at `trial` as `held` has it, with the statuses of `trial` where a point can have them.
  ContactIterate contact_at(const State& trial, const Held& held) const;
  /// How the zone behaves in this attempt.
  contact::ZoneLaw law_of(std::size_t zone, const Held& held) const;

private:
  StepReport ended(Outcome outcome);
  void evaluate_contact(const State& trial, const Held& held, int iteration);
  void add_zone(std::size_t zone, const Held& held);
  void evaluate_residual(const State& trial);
  void measure_residual(const State& trial);
  bool settled(const Held& held);
  void collect_restless(const Held& held);
  bool geometry_settled(const Held& held) const;
  bool gaps_closed() const;
  bool solve_and_correct(State& trial);
  void finish(State& trial, const Held& held) const;

  const model::Model& model_;
  const time::Scheme& scheme_;
  EffectiveSystem& system_;
  const State& committed_;
  double t_;
  Variant variant_;
  Eigen::VectorXd external_;
  Eigen::VectorXd history_; ///< the scheme's terms of the start of the step
  std::vector<contact::ZoneCoefficients> coefficients_;
  contact::ContactSystem contact_;
  Eigen::VectorXd forgotten_;   ///< contact force of zones without history force
  Eigen::VectorXd nodal_force_; ///< contact force of nodal methods
  ContactIterate now_, previous_;
  Eigen::VectorXd inertia_, unbalance_, full_residual_, residual_;
  StepReport report_;
};

} // namespace rubato::step
