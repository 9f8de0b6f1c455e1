// SPDX-License-Identifier: LGPL-3.0-or-later
/// How a step went: a value that says why, not an exception.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <string_view>
#include <vector>

namespace rubato::step {

enum class Outcome { converged, too_many_iterations, singular_matrix, not_finite };

std::string_view to_string(Outcome outcome);

/// A contact point whose status would not settle.
struct RestlessPoint {
  int zone = 0;
  mesh::NodeIndex node = -1;
};

struct StepReport {
  Outcome outcome = Outcome::too_many_iterations;
  int iterations = 0;  ///< linear solves, all attempts of the step together
  double residual = 0; ///< relative, of the last iterate
  double tolerance = 0;
  mesh::NodeIndex worst_node = -1; ///< where the residual is largest
  int status_changes = 0;          ///< contact points that changed in the last iteration
  std::vector<RestlessPoint> restless;
  bool friction_continuation = false; ///< the step needed friction raised in parts
  bool converged() const { return outcome == Outcome::converged; }
};

} // namespace rubato::step
