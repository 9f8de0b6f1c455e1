// SPDX-License-Identifier: LGPL-3.0-or-later
/// Products with dense symmetric matrices (BLAS).
#pragma once

#include <Eigen/Core>

namespace rubato::linalg {

/// y += factor A x, x and y as long as A has rows; only the lower triangle of A is read, which halves the
/// memory that a large one moves.
void add_symmetric_product(double factor, const Eigen::MatrixXd& matrix, const double* x, double* y);

} // namespace rubato::linalg
