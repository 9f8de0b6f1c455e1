// SPDX-License-Identifier: LGPL-3.0-or-later
/// How a step went: a value that says why, not an exception.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <string_view>
#include <vector>

namespace rubato::step {

enum class Outcome {
  converged,
  too_many_iterations,
  singular_matrix,
  not_finite,
  geometry_unsettled, ///< the loop of that level came to its last round
  friction_unsettled,
  status_unsettled
};

std::string_view to_string(Outcome outcome);

/// A contact point whose status would not settle.
struct RestlessPoint {
  int zone = 0;
  mesh::NodeIndex node = -1;
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
  int status_changes = 0;          ///< contact points that changed in the last iteration or round
  std::vector<RestlessPoint> restless;
  std::vector<LoopRound> rounds;      ///< in the order they ended, of the last attempt
  bool friction_continuation = false; ///< the step needed friction raised in parts
  bool converged() const { return outcome == Outcome::converged; }
};

} // namespace rubato::step
