// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a domain is asked and where it answers.
#pragma once

#include "rubato/domain/cell_failure.hpp"
#include "rubato/domain/sparse_matrix.hpp"

#include <Eigen/Core>

#include <functional>

namespace rubato::domain {

struct LawPath;

/// What internal forces are those of.
enum class ForcesOf {
  end, ///< of the step: f_int(u1, t1)
  /// The whole step: with which elastic cells in finite strain keep energy and momenta
  /// (element/energy_momentum.hpp), and the mean of both ends of all that is constant. Materials have no
  /// memory.
  step
};

/// A step from (t0, u0) to (t1, u1), displacements with an entry a dof [length]. What is asked without a step
/// has both ends in one.
struct StepSpan {
  const Eigen::VectorXd& u0;
  const Eigen::VectorXd& u1;
  double t0 = 0;
  double t1 = 0;
  /// Internal forces at the start, where they are known: a domain whose forces depend on u alone, not on
  /// temperatures either, repeats them where u1 = u0.
  const Eigen::VectorXd* forces0 = nullptr;
  ForcesOf of = ForcesOf::end;
};

/// Which tangent.
enum class TangentOf {
  symmetric, ///< of the derivative, or near it: a matrix that is
  exact      ///< of forces of the whole step: the derivative, which is not symmetric
};

/// Where answers go, all of the end of the step but for forces and tangent of the whole of it; null where one
/// is not wanted.
struct Wanted {
  Eigen::VectorXd* forces = nullptr; ///< f_int, an entry a dof [force]
  /// ∂f_int/∂u1, of forces of the whole step twice that: near a stiffness in the middle of it. Always in the
  /// pattern of initial_tangent [force/length].
  SparseMatrix* tangent = nullptr;
  TangentOf tangent_of = TangentOf::symmetric;
  bool records = false; ///< QuadratureStates::records of the end of the step
  /// Goes on from the evaluation before, which must have been that of the start of the step; of cells that
  /// nothing has happened to a path is empty. A linear domain leaves it alone.
  LawPath* path = nullptr;
};

/// Makes of what the cells of each rank add to a vector the whole one, on all ranks; none where this one has
/// all cells.
using AddUp = std::function<void(Eigen::VectorXd&)>;
/// Replaces displacements, one a dof, by others.
using Admit = std::function<void(Eigen::VectorXd&)>;

} // namespace rubato::domain
