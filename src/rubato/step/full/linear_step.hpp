// SPDX-License-Identifier: LGPL-3.0-or-later
/// The linear system of one Newton iteration on all unknowns,
///   [A + f ∂f_c/∂u   f ∂f_c/∂λ] [d ]     [residual ]
///   [  ∂e/∂u           ∂e/∂λ   ] [dλ] = − [equations],
#pragma once

#include "rubato/contact/enforcement.hpp"
#include "rubato/model/fwd.hpp"
#include "rubato/model/sparse_matrix.hpp"
#include "rubato/step/interface/compliance.hpp"

#include <Eigen/Core>

#include <memory>
#include <optional>

namespace rubato::step {

struct LinearSolution {
  Eigen::VectorXd displacement; ///< on free dofs
  Eigen::VectorXd multipliers;
  // Of a further load alone, where there is one:
  Eigen::VectorXd displacement_by_load = {};
  Eigen::VectorXd multipliers_by_load = {};
};

struct LinearProblem {
  const model::Model& model;
  const model::SparseMatrix& matrix; ///< A on free dofs
  double force_weight;               ///< f: the scheme's weight of forces at the end of the step
  const contact::ContactSystem& contact;
  const Eigen::VectorXd& residual;       ///< on free dofs
  const Eigen::VectorXd* load = nullptr; ///< a further one on free dofs [force]
};

/// Nothing comes back when the system is singular.
std::optional<LinearSolution> solve_full(const LinearProblem& problem);

/// The dependent dofs of the contact surfaces, without those that nothing unknown moves.
std::vector<int> related_surface_dofs(const model::Model& model);

/// The unknowns that move the contact surfaces of the model, ascending.
std::vector<int> surface_unknowns(const model::Model& model);

} // namespace rubato::step
