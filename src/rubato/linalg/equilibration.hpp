// SPDX-License-Identifier: LGPL-3.0-or-later
/// Scale a system so that its largest entries are near one, whatever the units of its rows and columns.
#pragma once

#include "rubato/linalg/direct_solver.hpp"

#include <optional>

namespace rubato::linalg {

/// diag(rows) · A · diag(columns), its rows and columns having a largest magnitude near one. The scales are
/// powers of two, so scaling rounds nothing.
struct EquilibratedMatrix {
  SparseMatrix matrix;
  Eigen::VectorXd rows;
  Eigen::VectorXd columns;
};

/// Simultaneous scaling by the square roots of row and column maxima (D. Ruiz, A scaling algorithm to
/// equilibrate both rows and columns norms in matrices, RAL-TR-2001-034), which keeps a symmetric matrix
/// symmetric. Nothing comes back when a row or column is all zero or a value is not finite.
std::optional<EquilibratedMatrix> equilibrated(const SparseMatrix& matrix);

/// The same of a dense matrix in place, its columns first, then its rows, each to a largest magnitude of 1;
/// those that are all zero stay.
void equilibrate(Eigen::MatrixXd& matrix, Eigen::VectorXd& rows, Eigen::VectorXd& columns);

} // namespace rubato::linalg
