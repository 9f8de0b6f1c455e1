// SPDX-License-Identifier: LGPL-3.0-or-later
/// Friction below limits that are held (Tresca's problem): slips w = values + matrix F of friction forces F,
/// those of a point (`tangents` in a row) no longer than its limit, slips against the forces at the limit and
/// none below it: the minimum of F·values + F·matrix F/2 within the limits.
#pragma once

#include "rubato/step/progress.hpp"

#include <Eigen/Core>

namespace rubato::step {

/// Improves `forces` by sweeps, and where a point has one tangent by an active set between the bounds, which
/// is taken where it settles. `matrix`: [length/force], symmetric; `values`: [length]; `limits`: [force], one
/// a point. Nothing that comes of it counts when the progress has stopped.
void solve_tresca_problem(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& values,
                          const Eigen::VectorXd& limits, int tangents, Eigen::VectorXd& forces,
                          Progress& progress);

/// Projected Gauss–Seidel sweeps until one changes no force by more than a hundredth of the largest limit.
void tresca_gauss_seidel(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& values,
                         const Eigen::VectorXd& limits, int tangents, Eigen::VectorXd& forces);

} // namespace rubato::step
