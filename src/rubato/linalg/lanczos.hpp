// SPDX-License-Identifier: LGPL-3.0-or-later
/// The largest eigenvalue of a matrix that is only multiplied with.
#pragma once

#include "rubato/linalg/block_matrix.hpp"

#include <Eigen/Core>

#include <functional>

namespace rubato::linalg {

/// A bound from above of the largest λ of A x = λ D⁻¹ x, at most 1 % beyond it. A must be positive
/// semidefinite, D ≥ 0 is a diagonal; where it is 0, x is held at 0.
///
/// Lanczos' method from a random start, with as many steps as make the found value lie less than 1 % below
/// the true one in all but 1e-12 of all starts, whatever the spectrum: J. Kuczyński, H. Woźniakowski,
/// Estimating the largest eigenvalue by the power and Lanczos algorithms with a random start, SIAM J. Matrix
/// Anal. Appl. 13 (1992) 1094–1122, theorem 4.2. The start is always the same, so is the result.
double largest_eigenvalue(const SymmetricBlockMatrix& matrix, const Eigen::VectorXd& diagonal);

/// y = A x; both have an entry a row and are not the same.
using Product = std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& y)>;
/// The same of a matrix that nobody holds.
double largest_eigenvalue(const Product& multiply, const Eigen::VectorXd& diagonal);

} // namespace rubato::linalg
