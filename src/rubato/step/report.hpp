// SPDX-License-Identifier: LGPL-3.0-or-later
/// How a step went: a value that says why, not an exception.
#pragma once

#include "rubato/contact/law.hpp"
#include "rubato/mesh/mesh.hpp"

#include <Eigen/Core>

#include <span>
#include <string_view>
#include <vector>

namespace rubato::step {

enum class Outcome {
  converged,
  too_many_iterations,
  cycling, ///< statuses and forces came back to those of an earlier iterate
  singular_matrix,
  not_finite,
  geometry_unsettled, ///< the loop of that level came to its last round
  friction_unsettled,
  status_unsettled
};

std::string_view to_string(Outcome outcome);

/// The level of a step's iterations that came to no end: "geometry", "friction", "status" or "newton".
std::string_view level_of(Outcome outcome);

/// A contact point whose status would not settle, and what it went from and to last.
struct RestlessPoint {
  int zone = 0;
  mesh::NodeIndex node = -1;
  contact::Status before = contact::Status::open;
  contact::Status now = contact::Status::open;
};

/// A node where forces are out of balance.
struct WorstNode {
  mesh::NodeIndex node = -1;
  double residual = 0; ///< largest of its components, relative as in StepReport; infinite where not finite
};

enum class LoopLevel { geometry, friction, status };

std::string_view to_string(LoopLevel level);

/// One round of an outer loop.
struct LoopRound {
  LoopLevel level = LoopLevel::geometry;
  int round = 0;      ///< from 1 on
  int iterations = 0; ///< linear solves of this round
  double change = 0;  ///< what the loop's tolerance is held against; of the status: points that changed
  bool settled = false;
};

struct StepReport {
  Outcome outcome = Outcome::too_many_iterations;
  int iterations = 0;  ///< linear solves, all attempts of the step together
  double residual = 0; ///< relative, of the last iterate
  double tolerance = 0;
  mesh::NodeIndex worst_node = -1; ///< where the residual is largest
  /// Of an attempt that failed: the nodes where the residual is largest, largest first, at most five.
  std::vector<WorstNode> worst;
  int status_changes = 0; ///< contact points that changed in the last iteration or round
  std::vector<RestlessPoint> restless;
  std::vector<LoopRound> rounds;      ///< in the order they ended, of the last attempt
  bool geometry_by_loop = false;      ///< the step needed its geometry in a loop of its own
  bool friction_continuation = false; ///< the step needed friction raised in parts
  bool converged() const { return outcome == Outcome::converged; }
};

/// The nodes of the largest entries of a residual. `nodes`: of every entry; `scale`: what entries are
/// measured by [force].
std::vector<WorstNode> worst_nodes(const Eigen::VectorXd& residual, std::span<const mesh::NodeIndex> nodes,
                                   double scale);

} // namespace rubato::step
