// SPDX-License-Identifier: LGPL-3.0-or-later
/// The nonnegative quadratic problem of contact without friction: the gaps w = values + matrix F of pressing
/// forces F, with F ≥ 0, w ≥ 0, F·w = 0, which is the minimum of F·values + F·matrix F/2 over F ≥ 0. The
/// matrix [length/force] is symmetric and positive semi-definite; unknowns with a zero on its diagonal
/// (points between parts that are held) keep the force 0.
#pragma once

#include "rubato/linalg/linear_map.hpp"
#include "rubato/step/progress.hpp"

#include <Eigen/Core>

#include <optional>

namespace rubato::step {

/// How far a normal problem is solved.
enum class NormalSolution {
  near,        ///< sweeps, then sets of pressing points that change at once, where these settle
  active_set,  ///< where they don't settle to the end, by a set that changes by one point at a time
  projected_cg ///< to the end by projected conjugate gradients; where these fail, as `active_set`
};

/// Improves `forces` ≥ 0. Whether the solution is exact, not only near. Nothing that comes of it counts when
/// the progress has stopped.
bool solve_normal_problem(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& values,
                          NormalSolution how_far, Eigen::VectorXd& forces, Progress& progress);

/// Projected Gauss–Seidel sweeps until one changes neither which F are positive nor any of them by more than
/// a hundredth of the largest.
void normal_gauss_seidel(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& values,
                         Eigen::VectorXd& forces);

/// One unknown joins or leaves the set of positive ones at a time and the minimised value never rises, so
/// that this ends where sets that change at once may go round (Lawson and Hanson, Solving Least Squares
/// Problems, 1974, chapter 23). The matrix is positive definite. Whether it has come to the end.
bool solve_complementarity(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& values,
                           Eigen::VectorXd& forces, Progress& progress);

/// When conjugate gradients end.
struct CgLimits {
  double tolerance = 0;   ///< of the projected gradient's largest entry [length]
  int max_iterations = 0; ///< products with the matrix, nearly
};

/// A normal problem whose matrix is known by its products.
struct NormalProducts {
  linalg::LinearMap matrix;       ///< gaps by forces
  linalg::LinearMap precondition; ///< forces by gaps, near the inverse of the matrix; symmetric and positive
  int norm_products = 0;          ///< of the power method that bounds ‖matrix‖ from below
};

/// Modified proportioning with reduced gradient projections (MPRGP), preconditioned in the face (Dostál and
/// Schöberl, Comput. Optim. Appl. 30, 2005; Domorádová and Dostál, Numer. Linear Algebra Appl. 14, 2007),
/// from `start` ≥ 0. The diagonal of the matrix is positive; the matrix may be singular. Nothing comes back
/// when the iterations do not suffice or the progress has stopped.
std::optional<Eigen::VectorXd> minimise_over_nonnegative(const NormalProducts& products,
                                                         const Eigen::VectorXd& values, Eigen::VectorXd start,
                                                         const CgLimits& limits, Progress& progress);

/// The same with the matrix, preconditioned by its diagonal.
std::optional<Eigen::VectorXd> minimise_over_nonnegative(const Eigen::MatrixXd& matrix,
                                                         const Eigen::VectorXd& values, Eigen::VectorXd start,
                                                         const CgLimits& limits, Progress& progress);

} // namespace rubato::step
