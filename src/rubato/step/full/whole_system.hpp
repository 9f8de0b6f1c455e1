// SPDX-License-Identifier: LGPL-3.0-or-later
/// Motion and contact of one implicit step solved for together, with whatever the outer loops freeze.
///
/// Geometry, friction threshold and contact status that no loop holds are re-evaluated in every iteration.
/// The tangent is exact for points on nodes and faces; mortar keeps its operators and frames within an
/// iteration. Unknowns are the free displacements and the contact multipliers:
///   [A + f₁ ∂f_c/∂u   f₁ ∂f_c/∂λ] [d ]     [residual ]
///   [  ∂e/∂u            ∂e/∂λ   ] [dλ] = − [equations]
#pragma once

#include "rubato/step/common/bulk_newton.hpp"
#include "rubato/step/common/contact_evaluator.hpp"
#include "rubato/step/common/equilibrium.hpp"
#include "rubato/step/common/reach.hpp"
#include "rubato/step/full/arc_length.hpp"
#include "rubato/step/full/linear_step.hpp"
#include "rubato/step/full/symmetric_system.hpp"
#include "rubato/step/interface/bulk_history.hpp"
#include "rubato/step/progress.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace rubato::step {

class WholeSystem {
public:
  /// Everything must outlive this. It has no loop of its own that would need the progress.
  WholeSystem(const model::Model& model, const time::Scheme& scheme, EffectiveSystem& system,
              const State& committed, double t, ContactEvaluator& side, Progress& progress);

  // As NewtonSystem asks (common/newton.hpp).
  std::optional<Outcome> start(State& trial, const Frozen& frozen);
  void evaluate(const State& trial, const Frozen& frozen, int iteration);
  bool is_finite() const { return equilibrium_.residual().allFinite(); }
  bool is_settled(const State& trial, const Frozen& frozen);
  std::optional<Outcome> close(State& trial, const Frozen& frozen);
  std::optional<Outcome> correct(State& trial, const Frozen& frozen, double part);
  const ContactIterate& iterate() const { return now_; }
  int points_in_contact() const;
  double force_norm() const { return force_.all.norm(); }
  StepReport& report() { return report_; }
  bool counts_anew() { return std::exchange(counts_anew_, false); }
  StepReport ended(Outcome outcome, const Frozen& frozen);

private:
  std::optional<Outcome> go_on_from(State& trial, const Frozen& frozen);
  void evaluate_contact(const State& trial, const Frozen& frozen, int iteration);
  void add_zone(std::size_t zone, const Frozen& frozen);
  double part_in_reach(const Eigen::VectorXd& displacement);
  std::optional<LinearSolution> solution(const time::Motion& motion);
  bool is_factored() const;
  ContactForce force_at(const State& trial, const Frozen& frozen);
  void search(State& trial, const Frozen& frozen);
  void keep_best(const State& trial);
  std::optional<Outcome> search_from_best(State& trial);
  void go_on_faster(State& trial);
  void forget_moves();
  void take_load_factor(State& trial, double factor);
  bool follow_path(const State& trial, LinearSolution& found, double& factor_change) const;
  bool touches() const;
  void add_slope_changes(const time::Motion& motion);
  bool within_rounding(const State& trial, const Frozen& frozen) const;

  const model::Model& model_;
  const time::Scheme& scheme_;
  EffectiveSystem& system_;
  ContactEvaluator& side_;
  Equilibrium equilibrium_;
  std::optional<BulkNewton> bulk_; ///< of a nonlinear one
  bool started_ = false;
  bool start_ = false; ///< until its first iterate is solved for
  /// Where its last iterate came from.
  struct Before {
    time::Motion motion;
    std::vector<contact::ZoneState> zones;
    double load_factor = 1;
  } before_;
  std::optional<ArcLength> path_; ///< of equilibrium, where the study follows one
  Reach reach_;
  std::vector<int> on_surfaces_; ///< unknowns of bodies that only contact holds, none without such bodies
  contact::ContactSystem contact_;
  ContactForce force_;
  SymmetricSystem symmetric_; ///< of bodies that nothing touches, without a factor
  ContactIterate now_, previous_;
  ContactIterate searched_;  ///< at the point of a move that was tried last
  bool searches_ = false;    ///< along moves
  bool counts_anew_ = false; ///< iterations: those from where it searches
  /// The iterate that left least out of balance [force].
  struct Best {
    time::Motion motion;
    double unbalanced = 0;
  };
  std::optional<Best> best_; ///< of bodies that nothing touches
  BulkHistory history_;
  /// An iterate that was left for one by history.
  struct Left {
    BulkIterate iterate;
    double moved = 0; ///< of its move
  };
  std::optional<Left> left_;
  StepReport report_;
  StallWatch stall_;
};

} // namespace rubato::step
