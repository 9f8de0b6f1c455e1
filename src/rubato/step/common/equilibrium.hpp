// SPDX-License-Identifier: LGPL-3.0-or-later
/// The balance of forces at the end of a step, and how well a motion keeps it.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/step/common/bulk_tangent.hpp"
#include "rubato/step/common/effective_system.hpp"
#include "rubato/step/report.hpp"
#include "rubato/step/state.hpp"
#include "rubato/time/scheme.hpp"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace rubato::step {

/// What contact puts on the dofs, internal side [force].
struct ContactForce {
  Eigen::VectorXd all;
  Eigen::VectorXd nodal;     ///< the part of nodal methods: it counts among the applied forces
  Eigen::VectorXd forgotten; ///< the part that the next step's history has nothing of

  explicit ContactForce(Eigen::Index dofs);
  /// Part of the way from other forces to these.
  ContactForce after(const ContactForce& other, double part) const;
  /// Adds share · (to − from).
  void add(double share, const ContactForce& to, const ContactForce& from);
  /// Calls `add` with each of the vectors that forces of a zone stand in.
  template <class Add> void for_zone(const contact::Zone& zone, const Add& add) {
    add(all);
    if (!zone.settings.history_force)
      add(forgotten);
    if (zone.unit_weights)
      add(nodal);
  }
};

/// What forces at each dof follow the surfaces by, at most. On a master every spring of its zone counts as
/// one that may press on any node. [force/length]
struct ContactStiffness {
  Eigen::VectorXd by_position;     ///< the effective matrix's diagonal, and springs that the deck asks for
  Eigen::VectorXd by_displacement; ///< friction by penalty, which knows of the slips of the step only
};

/// `springs`, `friction`: what ContactEvaluator::spring_stiffness and friction_stiffness give.
ContactStiffness contact_stiffness(const model::Model& model, const EffectiveSystem& system,
                                   const std::vector<std::vector<double>>& springs,
                                   const std::vector<std::vector<double>>& friction);

/// Full residual: m₁ M a₁ + c₁ C v₁ + f₁ (f_int(u₁) − f_ext) + the weight of contact × f_c + the terms of the
/// start of the step. Of conserving schemes f_int of the step stands in it instead of both ends'.
class Equilibrium {
public:
  Equilibrium(const model::Model& model, const time::Scheme& scheme, const EffectiveSystem& system,
              const State& committed, double t);

  void evaluate(const time::Motion& motion, const ContactForce& contact);
  /// The same with internal forces that follow the tangent from the start of the step, and pressures that
  /// follow their faces with them: a motion whose
  /// supports have moved ahead of the bodies has none that mean anything.
  void evaluate_ahead(const time::Motion& motion, const ContactForce& contact, const BulkStart& start);
  /// Whether every cell has forces at these displacements; they are kept for `evaluate`.
  bool has_forces_at(const Eigen::VectorXd& u);
  /// The cell that had none.
  const domain::Failed& failed() const { return failed_; }
  /// The residual less what these forces have put into it.
  Eigen::VectorXd residual_without(const ContactForce& contact) const;
  /// The largest entry of a residual without contact, once these contact forces stand in it [force].
  double unbalanced_with(const Eigen::VectorXd& contact) const;
  /// On free dofs.
  const Eigen::VectorXd& residual() const { return residual_; }
  /// The factor of the loads that have one, from the next evaluation on.
  void set_load_factor(double factor);
  double load_factor() const { return load_factor_; }
  /// What these loads do at a factor of one at displacements u, on free dofs [force].
  Eigen::VectorXd controlled_force(const Eigen::VectorXd& u) const;
  /// Fills the report's residual and worst node. Code_Aster's RESI_GLOB_RELA: the largest unbalanced force
  /// over the largest of reactions and applied forces (inertia, history and the forces of nodal methods among
  /// them), and of the momentum's rate, but no less than 1e-4 of the largest contact force.
  void measure(const time::Motion& motion, const ContactForce& contact, StepReport& report);
  /// Whether every entry of the residual is within `tolerance` or no more than what rounding of the forces
  /// that it sums may leave: 16 units in the last digit of (|A| |u|)_i, A being the effective matrix, and at
  /// contact nodes of their stiffness times the places or moves that gaps and slips are differences of.
  /// `far`: what the surfaces' displacements are differences of, where that is known [length].
  bool within_rounding(const time::Motion& motion, const ContactStiffness& stiffness, double far,
                       double tolerance) const;
  /// The nodes where the residual is largest.
  std::vector<WorstNode> worst() const;
  /// What the last measure held the residual against [force].
  double scale() const { return scale_; }
  /// Stores in `trial` what the next step and the results need.
  void finish(const ContactForce& contact, State& trial) const;

private:
  void take_motion(const time::Motion& motion);
  void take_loads(const Eigen::VectorXd& u);
  void take_inertia(const time::Motion& motion);
  void sum_up(const ContactForce& contact);
  void record(State& trial) const;
  domain::StepSpan span_to(const Eigen::VectorXd& u) const;
  void add_contact(const ContactStiffness& stiffness, double far, double moved,
                   Eigen::VectorXd& summed) const;

  const model::Model& model_;
  const time::Scheme& scheme_;
  const EffectiveSystem& system_;
  double t_;
  const State& committed_;
  Eigen::VectorXd predicted_acceleration_; ///< at the end of the step without any correction
  time::Motion predicted_bulk_;            ///< f_int, M v, M a there
  BulkForces bulk_;
  domain::QuadratureStates bulk_points_;
  domain::Failed failed_;
  std::optional<Eigen::VectorXd> evaluated_at_; ///< displacements that a nonlinear bulk's forces are those of
  Eigen::VectorXd dead_;                        ///< the loads that do not follow [force]
  Eigen::VectorXd external_;
  double load_factor_;
  double reach_;            ///< displacements by which rounding may be told [length]
  double heat_ = 0;         ///< the largest force of temperatures at the end of the step [force]
  Eigen::VectorXd history_; ///< the scheme's terms of the start of the step
  Eigen::VectorXd bracket_; ///< what the next step's history has of bulk and loads [force]
  Eigen::VectorXd inertia_, full_residual_, residual_;
  double scale_ = 0;     ///< what the residual is measured by
  double own_scale_ = 0; ///< without what there was when the step began
};

} // namespace rubato::step
