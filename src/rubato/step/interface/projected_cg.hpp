// SPDX-License-Identifier: LGPL-3.0-or-later
/// Frictionless contact with held relations as a bound-constrained quadratic problem for the nodal forces
/// alone: min ½ Nᵀ F N + qᵀ N over N ≥ 0, F = f B A⁻¹ Bᵀ applied by solves, B the rows of the relations. Its
/// gradient F N + q are the gaps, so that the minimum is N ≥ 0, g ≥ 0, N g = 0.
#pragma once

#include "rubato/step/full/linear_step.hpp"
#include "rubato/step/pulse.hpp"

#include <functional>

namespace rubato::step {

/// A symmetric positive semi-definite operator.
using Operator = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

struct BoundedProblem {
  Operator multiply;      ///< F
  Operator precondition;  ///< near F⁻¹, also on any subset of the unknowns
  Eigen::VectorXd linear; ///< q
  double tolerance = 0;   ///< of the projected gradient's largest entry
  int max_iterations = 0;
  Pulse* pulse = nullptr; ///< that the iterations beat with, when there is one
};

/// Modified proportioning with reduced gradient projections, preconditioned in the face (Dostál and
/// Schöberl, Comput. Optim. Appl. 30, 2005; Domorádová and Dostál, Numer. Linear Algebra Appl. 14, 2007),
/// from `start` ≥ 0. Nothing comes back when the iterations do not suffice or
/// the pulse has stopped.
std::optional<Eigen::VectorXd> minimise_over_nonnegative(const BoundedProblem& problem,
                                                         Eigen::VectorXd start);

/// Whether contact is by a method that solves for its forces by itself: all zones then have it.
bool finds_forces(const model::Model& model);

/// The motion and change of nodal forces of one linear contact problem, all zones of which are nodal_pcg.
/// Nothing comes back without a compliance, when the iterations do not suffice, or when the pulse has
/// stopped.
std::optional<LinearSolution>
solve_projected_cg(const LinearProblem& problem, const Compliance* compliance,
                   const std::vector<std::vector<contact::PointEvaluation>>& points,
                   const std::vector<contact::ZoneState>& zones, Pulse& pulse);

} // namespace rubato::step
