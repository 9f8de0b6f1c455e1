// SPDX-License-Identifier: LGPL-3.0-or-later
/// Coulomb's friction of few points that move one another strongly, pressing and rubbing solved at once.
#pragma once

#include "rubato/step/progress.hpp"

#include <Eigen/Core>

#include <optional>

namespace rubato::step {

/// Points one after the other, each with its gap and then its slips: w = values + matrix F.
struct FrictionCones {
  Eigen::MatrixXd matrix;   ///< symmetric, with a positive diagonal [length/force]
  Eigen::VectorXd values;   ///< gaps and slips without forces [length]
  Eigen::VectorXd friction; ///< μ of each point
};

/// Forces with F_n ≥ 0, gaps ≥ 0 and closed where F_n > 0, |F_t| ≤ μ F_n, slips against the forces at the
/// limit and none below it. With r > 0 that is F_n = max(0, F_n − r gap), F_t the projection of F_t − r slip
/// on the disc of radius μ max(0, F_n − r gap), which Newton's method with shortened moves solves (Alart and
/// Curnier 1991), from `start`, and if that fails with a smaller r from where every point sticks. Nothing
/// where neither comes to its end.
std::optional<Eigen::VectorXd> solve_friction(const FrictionCones& cones, const Eigen::VectorXd& start,
                                              Progress& progress);

} // namespace rubato::step
