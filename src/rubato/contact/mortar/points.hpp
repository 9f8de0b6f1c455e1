// SPDX-License-Identifier: LGPL-3.0-or-later
/// The slave nodes of a mortar zone as contact points: each has the gap, slip, frame and stencil that the
/// operators give it (operators.hpp), and counts with the part of its area that faces the master.
///
/// Operators and frames are made anew for every configuration and held within one: a point's gap and slip
/// are linear in the displacements there. A node at the border of the cover that iterations of a step
/// keep and drop in turn is kept from another share of its weight on for the rest of the step.
/// The lift of a gap stays that of the step's start until it is off by more than 2e-5 of the way to the next
/// node: what the bending of faces adds is less than their error, but followed it would take as many
/// iterations as all the rest. Where it is off for the third time within a step, the gap is followed as its
/// least gaps move (Kinematics::gap_weights): a point that presses alone dents its face.
#pragma once

#include "rubato/contact/enforcement.hpp"
#include "rubato/contact/mortar/operators.hpp"
#include "rubato/contact/mortar/reach.hpp"
#include "rubato/contact/self_pairs.hpp"

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace rubato::contact::mortar {

class Points {
public:
  /// Of a zone with `mortar`, which must outlive it.
  explicit Points(const Zone& zone, const Threads& threads = {});

  /// A step begins from an end at which points had these lifts, PointEvaluation::lift: one a slave node, or
  /// none before the first step. They are taken from where the step begins then.
  void begin(std::span<const double> lifts);
  /// Integrates the operators of a configuration.
  void update(const Configuration& configuration);
  /// A slave node at the configuration of the last update, by its position: no derivatives.
  void measure(std::size_t position, const Eigen::VectorXd& multipliers, const Configuration& configuration,
               PointEvaluation& into) const;

  const Zone& zone() const { return *zone_; }
  const Operators& operators() const { return now_; }

private:
  using Positions = std::vector<Eigen::Vector3d>;
  void integrate_at(const Positions& slave, const Positions& master, double t, Operators& into);
  Options options_at(const Positions& slave, const Positions& master);
  void take_start(const Configuration& configuration);
  void take_frames();
  void take_frames_before_obstacle();
  void hold_those_that_return();
  void ask_another_share_of(std::size_t node);
  void hold_lifts();
  void hold_lift(std::size_t node);
  void take_lifts();
  Eigen::Matrix<double, 3, 2> start_tangents(std::size_t position) const;
  Eigen::Vector3d anchor_motion(const Node& node, const Configuration& configuration) const;

  const Zone* zone_;
  Threads threads_;
  std::vector<Keep> keep_;
  std::optional<SelfPairs> self_; ///< of a surface that touches itself: as it is where the step begins
  ReachInStep reach_;             ///< between two meshes
  /// Of every slave node in this step: whether it was kept last, and how often that changed.
  std::vector<char> was_kept_;
  std::vector<int> changes_;
  std::vector<double> least_shares_;
  std::vector<double> held_lifts_;     ///< in this step, as PointEvaluation::lift
  std::vector<double> measured_lifts_; ///< at the last update
  std::vector<int> releases_;          ///< of each lift in this attempt
  Workspace workspace_;
  Operators now_;
  Positions slave_, master_;
  /// Where the slave's nodes were when the step began, and the frames that they had there.
  Positions start_slave_, start_master_;
  double start_t_ = 0;
  std::vector<Frame> start_frames_;
};

void evaluate(Points& points, const Eigen::VectorXd& multipliers, const Configuration& configuration,
              std::vector<PointEvaluation>& into);
void measure(Points& points, const Eigen::VectorXd& multipliers, const Configuration& configuration,
             std::vector<PointEvaluation>& into);
void measure(Points& points, const Eigen::VectorXd& multipliers, const Configuration& configuration,
             std::span<const std::size_t> chosen, std::vector<PointEvaluation>& into);

} // namespace rubato::contact::mortar
