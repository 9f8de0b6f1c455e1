// SPDX-License-Identifier: LGPL-3.0-or-later
/// The contact half of one attempt at a step: where the points are, what their zones ask of them, and whether
/// they have settled.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/step/common/effective_system.hpp"
#include "rubato/step/report.hpp"
#include "rubato/step/state.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rubato::step {

/// What an attempt on the points alone starts from.
enum class Start {
  usual,     ///< the prediction, but where friction is by springs the last step
  predicted, ///< forces that close the gaps of the free motion
  last_step, ///< its statuses and multipliers
};

/// How an attempt at a step differs from the plain one.
struct RetrySettings {
  double friction_part = 1;       ///< of μ
  double normal_multiple = 1;     ///< of c where it is an augmentation
  double tangential_multiple = 1; ///< of c_t where it is an augmentation
  bool geometry_by_loop = false;  ///< also where the zone iterates it by Newton
  bool status_by_newton = false;  ///< also where the zone iterates it by a loop
  Start start = Start::usual;
  bool indefinite = false; ///< the matrix without contact is not positive definite: no factor of it serves
  /// Of the forces of a conserving scheme, with contact in the matrix of every iteration: it is not
  /// symmetric.
  bool exact_tangent = false;
  bool searches = false; ///< nonlinear bodies go only as far along a move as that brings them into balance
  bool hurries = false;  ///< iterates of nonlinear bodies that come no nearer are given up soon
};

/// What outer loops hold of one zone while Newton iterates; empty: nothing.
struct FrozenZone {
  std::vector<contact::PointEvaluation> frames;
  std::vector<double> thresholds;
  std::vector<contact::Status> status;
};
using Frozen = std::vector<FrozenZone>; ///< one a zone

/// Contact of all zones at one iterate.
struct ContactIterate {
  std::vector<std::vector<contact::PointEvaluation>> points;
  std::vector<std::vector<contact::Status>> status;
  Eigen::VectorXd u; ///< one a dof, where friction is by springs; else unused
};

class ContactEvaluator {
public:
  /// Everything must outlive this.
  ContactEvaluator(const model::Model& model, const time::Scheme& scheme, EffectiveSystem& system,
                   const State& committed, const RetrySettings& variant);

  /// Contact at `trial` as `frozen` has it, with the statuses of `trial` where a point can have them.
  ContactIterate at(const State& trial, const Frozen& frozen) const;
  /// The same in storage that an earlier iterate left.
  void evaluate(const State& trial, const Frozen& frozen, ContactIterate& into) const;
  /// The same without the derivatives of points whose frames move.
  void measure(const State& trial, const Frozen& frozen, ContactIterate& into) const;
  /// The same of some points of each zone, in an iterate that has the others: these stay where they were.
  void measure(const State& trial, const Frozen& frozen, std::span<const std::vector<std::size_t>> points,
               ContactIterate& iterate) const;
  /// Those derivatives, of one point at the same `trial`.
  void differentiate(const State& trial, const Frozen& frozen, std::size_t zone, std::size_t point,
                     ContactIterate& iterate) const;
  /// Statuses that the points of an iterate call for, where no loop holds them. `before`: the iterate before.
  void renew_status(const Frozen& frozen, const ContactIterate& before, ContactIterate& now) const;
  /// How the zone behaves in this attempt.
  contact::ZoneLaw law_of(std::size_t zone, const Frozen& frozen) const;
  const RetrySettings& variant() const { return variant_; }
  const EffectiveSystem& system() const { return system_; }
  /// Where the step starts.
  const State& committed() const { return committed_; }
  /// Whether the surfaces have come so far in an iterate that frames measured there say little: a point sank
  /// in by more than half an edge, or most of those that were in contact face nothing.
  bool is_out_of_reach(const ContactIterate& now) const;

  /// To be told when Newton's iterations begin: which faces points hop between is counted from there.
  void start_iterations() const;
  /// Friction of nodes with several points that press in `now` acts along directions tangential to all of
  /// their surfaces for the rest of the attempt (contact/shared_nodes.hpp).
  void restrict_friction(const Frozen& frozen, const ContactIterate& now);
  /// Lets points go that stay on a face they stand beyond (contact/neighbours.hpp). Whether there were any.
  bool release_beyond_borders() const;

  /// Of each zone's points (contact/springs.hpp).
  std::vector<std::vector<double>> spring_stiffness(const Frozen& frozen, const ContactIterate& now) const;
  /// Of the friction of each zone's points that is by `penalty` (contact/spring_friction.hpp).
  std::vector<std::vector<double>> friction_stiffness(const Frozen& frozen, const ContactIterate& now) const;

  /// Counts and names the points whose status changed between two iterates.
  void collect_status_changes(const Frozen& frozen, const ContactIterate& before, const ContactIterate& now,
                              StepReport& report) const;
  /// Whether a point whose status changed between two iterates had or has a force of more than `negligible`,
  /// and would have another, by more than that, with the status before. Else statuses are rounding: when all
  /// loads are gone, or where points that slipped up to their limit are held there in steps that follow.
  bool has_decisive_changes(const Frozen& frozen, const ContactIterate& before, const ContactIterate& now,
                            double negligible) const;
  /// Whether no projection of a point in contact moved between two iterates, and exact gaps are closed.
  bool settled(const Frozen& frozen, const ContactIterate& before, const ContactIterate& now) const;
  /// Adds to the report of an attempt that fails what of contact is not settled. `before` is nothing when
  /// `now` is the first iterate.
  void name_unmet(const Frozen& frozen, const ContactIterate* before, const ContactIterate& now,
                  StepReport& report) const;

  /// Stores in `trial` the statuses of an iterate and what its points do.
  void finish(const Frozen& frozen, const ContactIterate& iterate, State& trial) const;

private:
  bool presses(const Frozen& frozen, const ContactIterate& now, const contact::PointOfZone& at) const;
  bool most_are_lost(const ContactIterate& now) const;
  contact::Configuration at_end(const State& trial) const;
  template <class Measure>
  void measure_by(const Measure& measure, const State& trial, const Frozen& frozen,
                  ContactIterate& into) const;
  bool has_frozen_frames(std::size_t zone, const Frozen& frozen) const {
    return !frames_.empty() || !frozen[zone].frames.empty();
  }
  void add_obstacle_work(std::size_t z, std::span<const contact::PointEvaluation> points, State& trial) const;
  double work_by_way(std::size_t zone, const contact::PointForces& forces, const State& trial) const;
  Eigen::Vector3d way_of_obstacle(std::size_t zone, const contact::PointForces& forces, std::size_t entry,
                                  const State& trial) const;
  void add_friction_history(std::size_t z, std::span<const contact::PointEvaluation> points,
                            State& trial) const;
  void measure_places(State& trial) const;
  std::vector<double> moved_out(std::size_t zone, const ContactIterate& iterate,
                                const contact::Configuration& configuration) const;
  std::optional<Unmet> moving_projection(const Frozen& frozen, const ContactIterate& before,
                                         const ContactIterate& now) const;
  std::optional<Unmet> open_gap(const Frozen& frozen, const ContactIterate& now) const;
  std::optional<Unmet> lost_point(const ContactIterate* before, const ContactIterate& now) const;
  /// How messages name a point.
  mesh::NodeIndex named_node(std::size_t zone, std::size_t point) const;

  const model::Model& model_;
  EffectiveSystem& system_;
  const State& committed_;
  RetrySettings variant_;
  std::vector<contact::ZoneCoefficients> coefficients_;
  std::vector<std::vector<std::uint8_t>> touched_; ///< of each zone, where it is bilateral
  /// Of every zone's points in this attempt; none of a zone: all.
  std::vector<std::vector<contact::FrictionDirections>> directions_;
  std::vector<std::vector<contact::PointEvaluation>>
      frames_; ///< of every zone, where contact is a law of velocities; else none
  std::vector<std::vector<double>> activation_gaps_; ///< theirs
};

} // namespace rubato::step
