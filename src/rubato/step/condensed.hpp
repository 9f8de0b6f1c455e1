// SPDX-License-Identifier: LGPL-3.0-or-later
/// One implicit step on the contact points alone, for a bulk that keeps its effective matrix A.
///
/// The motion from a base is d = A⁻¹(−R₀ − f₁ f_c), R₀ the residual of the base without contact. So contact
/// needs d only where its points are: d_s = d_free − f₁ S f_c, S = B A⁻¹ Bᵀ. Newton's iterates of the whole
/// system fulfil this from the first one on; they are computed here without the bulk, which is solved for
/// once, in halves: down to the surface before the iterates, and back from it after them
/// (linalg/split_factor.hpp).
#pragma once

#include "rubato/step/contact_evaluator.hpp"
#include "rubato/step/equilibrium.hpp"
#include "rubato/step/interface_newton_system.hpp"
#include "rubato/step/predicted_start.hpp"
#include "rubato/step/surface_motion.hpp"

#include <Eigen/Core>

#include <limits>
#include <vector>

namespace rubato::step {

/// Whether A is factored and the method of contact is not one that solves for its forces itself.
bool can_condense(const model::Model& model, const EffectiveSystem& system);

/// What a step on the points alone can start from beside the usual; nothing where no status is guessed.
std::optional<Start> other_start(const model::Model& model, const EffectiveSystem& system);

/// A point in contact and its force z (contact/factored_response.hpp).
struct PointInContact {
  std::size_t zone = 0;
  std::size_t index = 0;
  contact::Status status = contact::Status::open;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
};

/// Storage that one attempt leaves to the next.
struct CondensedScratch {
  ContactIterate now, previous;
  ActiveInterfaceCompliance surface;
  InterfaceNewtonSystem points;
  PredictorScratch guess;
  std::vector<PointInContact> in_contact;
  Eigen::VectorXd force;               ///< theirs on the surface, one a position
  std::vector<MultiplierShare> shares; ///< of one point

  /// The compliance must outlive this.
  CondensedScratch(Compliance& compliance, double force_weight, int components, bool free_bodies);
  void forget();
};

class Condensed {
public:
  /// Everything must outlive this.
  Condensed(const model::Model& model, const time::Scheme& scheme, EffectiveSystem& system,
            const State& committed, double t, const ContactEvaluator& side, Pulse& pulse);

  /// Iterates from `trial` (u, v, a, multipliers and statuses) to the end of the step.
  StepReport run(State& trial, const Held& held);

private:
  ContactIterate& now() { return scratch_.now; }
  ContactIterate& previous() { return scratch_.previous; }
  const ContactIterate& now() const { return scratch_.now; }
  const Eigen::VectorXd& force() const { return scratch_.force; }

  void start_from(const State& trial);
  void predict_contact(State& trial, const Held& held);
  void evaluate_contact(const State& trial, const Held& held, int iteration);
  void collect_forces(const Held& held);
  bool settled(const State& trial, const Held& held);
  bool surface_within_rounding(const State& trial, const Held& held) const;
  bool within_rounding(const State& trial, const Held& held) const;
  void measure_surface();
  double surface_scale() const;
  std::vector<WorstNode> worst_on_surface() const;
  void linearise(const State& trial, const Held& held);
  void add_open_points(const Held& held);
  bool iterate(State& trial, const Held& held, double part);
  std::span<const MultiplierShare> shares_of(std::size_t zone, std::size_t point);
  void correct_own_multipliers(const InterfaceNewtonSystem::Change& change, const Eigen::VectorXd& moved,
                               double part, State& trial) const;
  void correct_shared_multipliers(const InterfaceNewtonSystem::Change& change, double part,
                                  State& trial) const;
  ContactForce contact_force() const;
  bool in_equilibrium(const State& trial, const Held& held, const ContactForce& force);
  StepReport ended(Outcome outcome, const Held& held);

  const model::Model& model_;
  const time::Scheme& scheme_;
  EffectiveSystem& system_;
  const ContactEvaluator& side_;
  Pulse& pulse_;
  Equilibrium equilibrium_;
  CondensedScratch& scratch_;
  StepReport report_;
  double scale_; ///< of forces, what the residual is measured by
  Reach reach_;

  StallWatch surface_stall_, bulk_stall_;
  double last_unbalance_ = std::numeric_limits<double>::infinity(); ///< at the last whole motion
  bool unbalance_grew_ = false; ///< from one to the next: they are at their rounding
  bool started_ = false;
  bool measured_ = false; ///< whether now() is at the iterate already
  SurfaceMotion surface_;
};

} // namespace rubato::step
