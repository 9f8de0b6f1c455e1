// SPDX-License-Identifier: LGPL-3.0-or-later
/// How a step went: a value that says why, not an exception.
#pragma once

#include "rubato/contact/status.hpp"
#include "rubato/domain/cell_failure.hpp"
#include "rubato/mesh/mesh.hpp"

#include <Eigen/Core>

#include <limits>
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
  status_unsettled,
  pressed_afar, ///< forces in balance, but a point presses where its master is not
  indefinite,   ///< the effective matrix without contact is not positive definite at the start
  plastic_step, ///< in balance, but plastic strain grew by more than the study allows in a step
  cell_failed,  ///< a cell has no forces, however short the corrections
  unsolved,     ///< the iterative solver of the effective matrix came to no end
  interrupted   ///< asked to end: neither converged nor failed
};

std::string_view to_string(Outcome outcome);

/// The level of a step's iterations that came to no end: "geometry", "friction", "status" or "newton".
std::string_view level_of(Outcome outcome);

/// A contact point whose status would not settle, and what it went from and to last.
struct ChangingPoint {
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

/// What the end of a step has to fulfil, and what keeps it from being judged at all.
enum class Criterion {
  residual,      ///< forces in balance; value: relative residual
  status,        ///< no contact point changes its status; value: points that did
  gap,           ///< points in contact of exact methods are closed; value: |gap| [length]
  projection,    ///< points in contact stay where they are on the master; value: in reference lengths of a
                 ///< face; before an obstacle: change of the normal
  point_lost,    ///< a point that was in contact faces nothing any more; value: points that do
  distance,      ///< points that press are near their master; value: to its nearest node [length]
  singular,      ///< the linear system has no solution; value 0
  geometry_loop, ///< value: as LoopRound::change, infinite of a loop that had one round
  friction_loop, ///< value: as LoopRound::change
  plastic_step,  ///< value: growth of the cumulated plastic strain; node: one of the cell
  cell,          ///< every cell has forces; node: one of the cell; value 0
  linear_solve   ///< the iterative solver reaches its tolerance; value: relative residual it left
};

/// "residual", "status", "gap", "projection", "point lost", "distance", "singular matrix", "geometry loop",
/// "friction loop", "plastic step", "cell", "linear solve".
std::string_view to_string(Criterion criterion);

/// A criterion that the last iterate of an attempt does not meet, and the point or node where it is furthest
/// from it.
struct Unmet {
  Criterion criterion = Criterion::residual;
  int zone = -1;             ///< −1: of no contact zone
  mesh::NodeIndex node = -1; ///< −1: not known
  double value = 0;
  double allowed = 0;
  int count = 1; ///< points or nodes that do not meet it
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
  int iterations = 0; ///< linear solves, all attempts of the step together
  /// Of nonlinear bodies, of the last attempt: motions from which they were solved for, and effective
  /// matrices that were factored.
  int bulk_iterations = 0;
  int factorisations = 0;
  /// Of nonlinear bodies, of the last attempt: the largest unbalanced force at the start and at every motion
  /// that contact was solved from, contact included [force].
  std::vector<double> bulk_residuals;
  bool stagnates = false;  ///< whether motions that came no nearer were given up before there were too many
  bool indefinite = false; ///< whether an effective matrix without contact was not positive definite
  /// Negative eigenvalues of the last matrix, where nothing touches bodies whose matrix was not positive
  /// definite: as many directions in which the state is not stable.
  int unstable_directions = 0;
  double load_factor = 1;      ///< at the last iterate, of loads along a path of equilibrium
  domain::Failed failed_cell;  ///< of an attempt that ended where a cell has no forces
  double residual = 0;         ///< relative, of the last iterate
  double unbalanced_force = 0; ///< the largest, of the last iterate
  double tolerance = 0;
  /// The residual at which the step ended, where rounding of the forces let it go no lower; else 0.
  double rounding = 0;
  mesh::NodeIndex worst_node = -1; ///< where the residual is largest
  /// Of an attempt that failed: the nodes where the residual is largest, largest first, at most five.
  std::vector<WorstNode> worst;
  int status_changes = 0; ///< contact points that changed in the last iteration or round
  std::vector<ChangingPoint> changing_points;
  /// Of an attempt that failed: each criterion that is not met, once.
  std::vector<Unmet> unmet;
  std::vector<LoopRound> rounds;      ///< in the order they ended, of the last attempt
  bool geometry_by_loop = false;      ///< the step needed its geometry in a loop of its own
  bool friction_continuation = false; ///< the step needed friction raised in parts
  bool exact_tangent = false;         ///< the step needed the exact tangent of a conserving scheme's forces
  bool converged() const { return outcome == Outcome::converged; }
  /// Whether another attempt may do better.
  bool failed() const { return !converged() && outcome != Outcome::interrupted; }
  /// The entry of `unmet` for that criterion, or nullptr.
  const Unmet* unmet_by(Criterion criterion) const;
};

/// Adds to `unmet` of an attempt that fails the points that changed their status.
void name_status_changes(StepReport& report);
/// Adds what its outcome and its residual say.
void name_residual_growth(StepReport& report);

/// Notices residuals that don't go down any more.
class StallWatch {
public:
  /// Whether this one is no better than the last one.
  bool stalls(double residual);

private:
  double last_ = std::numeric_limits<double>::infinity();
};

/// The nodes of the largest entries of a residual. `nodes`: of every entry; `scale`: what entries are
/// measured by [force].
std::vector<WorstNode> worst_nodes(const Eigen::VectorXd& residual, std::span<const mesh::NodeIndex> nodes,
                                   double scale);

} // namespace rubato::step
