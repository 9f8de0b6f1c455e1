// SPDX-License-Identifier: LGPL-3.0-or-later
/// Dense symmetric positive definite systems (LAPACK).
#pragma once

#include <Eigen/Core>

namespace rubato::linalg {

/// x of A x = b; only the lower triangle of A is read. Full of NaN when A is not positive definite. Throws
/// std::invalid_argument when sizes do not match.
Eigen::VectorXd solve_positive_definite(Eigen::MatrixXd matrix, Eigen::VectorXd right_side);

} // namespace rubato::linalg
