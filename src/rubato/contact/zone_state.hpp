// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a step changes in a contact zone.
#pragma once

#include "rubato/contact/friction_history.hpp"
#include "rubato/contact/status.hpp"

#include <Eigen/Core>

#include <vector>

namespace rubato::contact {

/// What a contact point does at the end of a step, for the results.
struct PointOutcome {
  double gap = 0; ///< infinite when nothing faces the point [length]
  Eigen::Vector2d slip = Eigen::Vector2d::Zero();
  double pressure = 0;                              ///< T_n; of nodal methods over the node's area
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< force of the master on the slave, its two parts
  Eigen::Vector3d tangential = Eigen::Vector3d::Zero();
  double activation_gap = 0; ///< of a law of velocities: what it still had when it closed [length]
  double area = 0;           ///< undeformed, of the part of the point's share that faces the master [area]

  bool operator==(const PointOutcome&) const = default;
};

/// N, the size of the normal force: < 0 where it pulls [force].
double pressing_force(const PointOutcome& outcome);

/// What an obstacle does by its motion on the bodies that it touches [force · length].
struct ObstacleWork {
  double normal = 0; ///< of its pressures
  double tangential = 0;

  bool operator==(const ObstacleWork&) const = default;
};

/// What a step changes in a zone.
struct ZoneState {
  /// Node after node of the slave surface, those of the zone's multiplier_variables.
  Eigen::VectorXd multipliers;
  std::vector<Status> status;                    ///< one a contact point
  std::vector<PointOutcome> outcomes;            ///< one a contact point
  std::vector<FrictionHistory> friction_history; ///< one a contact point
  PointForces friction_forces;                   ///< at the end of the step
  std::vector<double> lifts;                     ///< PointEvaluation::lift of each point; none before a step
  PointForces pressing_forces;                   ///< likewise, of an obstacle
  ObstacleWork obstacle_work;                    ///< in the step
  /// Four numbers a point, for points whose dual function receivers have: status and tangential traction
  /// [force/area], means of the receivers (dropped_nodes.hpp). Empty where there is no such point.
  Eigen::VectorXd of_receivers;

  bool operator==(const ZoneState&) const = default;
};

} // namespace rubato::contact
