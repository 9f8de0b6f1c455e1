// SPDX-License-Identifier: LGPL-3.0-or-later
/// Complementarity of few unknowns, solved to its end.
#pragma once

#include "rubato/step/pulse.hpp"

#include <Eigen/Core>

namespace rubato::step {

/// Takes `forces` ≥ 0 to w = values + matrix F,  F ≥ 0, w ≥ 0, F·w = 0, the minimum of F·values + F·matrix
/// F/2 over F ≥ 0. The matrix is symmetric positive definite. One unknown joins or leaves the set of positive
/// ones at a time and the minimised value never rises, so that this ends where sets that change at once may
/// go round (Lawson and Hanson, Solving Least Squares Problems, 1974, chapter 23). Whether it has come to the
/// end.
bool solve_complementarity(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& values,
                           Eigen::VectorXd& forces, Pulse& pulse);

} // namespace rubato::step
