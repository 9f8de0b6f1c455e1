// SPDX-License-Identifier: LGPL-3.0-or-later
/// One implicit step on the contact points alone, for a bulk that keeps its effective matrix A.
///
/// The motion from a base is d = A⁻¹(−R₀ − f₁ f_c), R₀ the residual of the base without contact. So contact
/// needs d only where its points are: d_s = d_free − f₁ S f_c, S = B A⁻¹ Bᵀ. Newton's iterates of the whole
/// system fulfil this from the first one on; they are computed here without the bulk, which is solved for
/// once, in halves: down to the surface before the iterates, and back from it after them
/// (linalg/split_factor.hpp). Of a nonlinear bulk A is that of one of its iterates, and contact is solved to
/// its end at each of them.
#pragma once

#include "rubato/step/common/bulk_newton.hpp"
#include "rubato/step/common/contact_evaluator.hpp"
#include "rubato/step/common/equilibrium.hpp"
#include "rubato/step/interface/bulk_history.hpp"
#include "rubato/step/interface/free_motions.hpp"
#include "rubato/step/interface/interface_newton_system.hpp"
#include "rubato/step/interface/newton_history.hpp"
#include "rubato/step/interface/predicted_start.hpp"
#include "rubato/step/interface/surface_motion.hpp"

#include <Eigen/Core>

#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace rubato::step {

/// Whether A is factored and there is contact.
bool can_condense(const model::Model& model, const EffectiveSystem& system);

/// What a step on the points alone can start from beside the usual; nothing where no status is predicted, or
/// always exactly.
std::optional<Start> other_start(const model::Model& model, const EffectiveSystem& system);

/// A point in contact and its force z (contact/point_tangent.hpp).
struct PointInContact {
  std::size_t zone = 0;
  std::size_t index = 0;
  contact::Status status = contact::Status::open;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
};

/// Storage that one attempt leaves to the next.
struct CondensedScratch {
  ContactIterate now, previous, shifted;
  ActiveInterfaceCompliance surface;
  InterfaceNewtonSystem points;
  PredictorScratch predictor;
  std::vector<PointInContact> in_contact;
  Eigen::VectorXd force;               ///< theirs on the surface, one an interface dof
  std::vector<MultiplierShare> shares; ///< of one point
  FreeMotions free_motions;            ///< none where they are not followed
  bool remembers;                      ///< whether Newton's iterations have a history
  NewtonHistory history;

  /// The compliance must outlive this.
  CondensedScratch(Compliance& compliance, double force_weight, int components, NormalSolution how_far,
                   FreeMotions motions, bool remembers);
  void forget();
};

class Condensed {
public:
  /// Everything must outlive this.
  Condensed(const model::Model& model, const time::Scheme& scheme, EffectiveSystem& system,
            const State& committed, double t, ContactEvaluator& side, Progress& progress);

  // As NewtonSystem asks (common/newton.hpp).
  std::optional<Outcome> start(State& trial, const Frozen& frozen);
  void evaluate(const State& trial, const Frozen& frozen, int iteration);
  bool is_finite() const { return force().allFinite(); }
  bool is_settled(const State& trial, const Frozen& frozen);
  std::optional<Outcome> close(State& trial, const Frozen& frozen);
  std::optional<Outcome> correct(State& trial, const Frozen& frozen, double part);
  const ContactIterate& iterate() const { return scratch_.now; }
  int points_in_contact() const { return static_cast<int>(scratch_.in_contact.size()); }
  double force_norm() const { return force().norm(); }
  StepReport& report() { return report_; }
  /// Whether iterations are counted anew from here: from an iterate of a nonlinear bulk.
  bool counts_anew() { return std::exchange(counts_anew_, false); }
  StepReport ended(Outcome outcome, const Frozen& frozen);

private:
  ContactIterate& now() { return scratch_.now; }
  ContactIterate& previous() { return scratch_.previous; }
  const ContactIterate& now() const { return scratch_.now; }
  const ContactIterate& previous() const { return scratch_.previous; }
  const Eigen::VectorXd& force() const { return scratch_.force; }

  std::optional<Outcome> begin(State& trial, const Frozen& frozen);
  void start_from(const State& trial);
  void start_ahead(const State& trial);
  std::optional<Outcome> go_on_from(State& trial, const Frozen& frozen, ContactForce force);
  double search(State& trial, ContactForce& force);
  bool go_on_faster(State& trial, ContactForce& force);
  void go_back(State& trial);
  void take_factor();
  void predict_contact(State& trial, const Frozen& frozen);
  void collect_forces(const Frozen& frozen);
  bool surface_within_rounding(const State& trial, const Frozen& frozen) const;
  bool within_rounding(const State& trial, const Frozen& frozen) const;
  void measure_surface();
  double surface_scale() const;
  void name_failure(Outcome outcome, const Frozen& frozen);
  std::vector<WorstNode> worst_on_surface() const;
  bool bases_carry_forces() const;
  void linearise(const State& trial, const Frozen& frozen);
  std::optional<Corrected> corrected(const State& trial, const Frozen& frozen, const Eigen::VectorXd& at);
  std::optional<Corrected> corrected_at(const Eigen::VectorXd& moved, const Frozen& frozen, State& shifted);
  void shorten(Corrected& correction, double part, const State& trial) const;
  bool follows_free_motions(const Frozen& frozen) const;
  bool gaps_are_followed_as_before() const;
  void accelerate(Corrected& correction, double part);
  void follow_free_motions(const State& trial, const Frozen& frozen, Corrected& correction);
  void add_open_points(const Frozen& frozen);
  std::span<const MultiplierShare> shares_of(std::size_t zone, std::size_t point);
  void correct_own_multipliers(const InterfaceNewtonSystem::Change& change, const Eigen::VectorXd& moved,
                               std::vector<Eigen::VectorXd>& multipliers) const;
  void correct_shared_multipliers(const InterfaceNewtonSystem::Change& change,
                                  std::vector<Eigen::VectorXd>& multipliers) const;
  ContactForce contact_force() const;
  bool in_equilibrium(const State& trial, const Frozen& frozen, const ContactForce& force);

  const model::Model& model_;
  const time::Scheme& scheme_;
  EffectiveSystem& system_;
  const State& committed_;
  ContactEvaluator& side_;
  Progress& progress_;
  Equilibrium equilibrium_;
  std::optional<BulkNewton> bulk_; ///< of a nonlinear one
  CondensedScratch& scratch_;
  StepReport report_;
  double scale_; ///< of forces, what the residual is measured by
  Reach reach_;

  StallWatch surface_stall_, bulk_stall_;
  double last_residual_ = std::numeric_limits<double>::infinity(); ///< at the last whole motion
  bool residual_grew_ = false; ///< from one to the next: they are at their rounding
  bool started_ = false;
  bool counts_anew_ = false;
  std::vector<contact::ZoneState> zones_at_base_; ///< of a nonlinear bulk
  ContactForce force_at_base_;                    ///< likewise
  BulkHistory bulk_history_;                      ///< likewise
  bool measured_ = false;                         ///< whether now() is at the iterate already
  SurfaceMotion surface_;
};

} // namespace rubato::step
