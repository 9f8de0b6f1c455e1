// SPDX-License-Identifier: LGPL-3.0-or-later
/// The linear system of one Newton iteration,
///   [A + f ∂f_c/∂u   f ∂f_c/∂λ] [d ]     [residual ]
///   [  ∂e/∂u           ∂e/∂λ   ] [dλ] = − [equations],
/// solved whole, or condensed on the contact unknowns that take part: with y the forces contact adds there,
///   d = A⁻¹(−residual) − A⁻¹Bᵀ y,   y = f (∂f_c/∂u d + ∂f_c/∂λ dλ),
/// a small dense system for d on the surfaces and dλ remains. Both give the same answer.
#pragma once

#include "rubato/contact/enforcement.hpp"
#include "rubato/model/model.hpp"
#include "rubato/step/compliance.hpp"

#include <Eigen/Core>

#include <memory>
#include <optional>

namespace rubato::step {

struct LinearSolution {
  Eigen::VectorXd displacement; ///< on free dofs
  Eigen::VectorXd multipliers;
};

struct LinearProblem {
  const model::Model& model;
  const model::SparseMatrix& matrix; ///< A on free dofs
  double force_weight;               ///< f: the scheme's weight of forces at the end of the step
  const contact::ContactSystem& contact;
  const Eigen::VectorXd& residual; ///< on free dofs
};

/// Nothing comes back when the system is singular.
std::optional<LinearSolution> solve_full(const LinearProblem& problem);

/// Nothing comes back when the dense system is singular or larger than pays; solve_full is to be tried then.
std::optional<LinearSolution> solve_condensed(const LinearProblem& problem, Compliance& compliance);

/// The free unknowns of every contact surface of the model, ascending.
std::vector<int> surface_unknowns(const model::Model& model);

} // namespace rubato::step
