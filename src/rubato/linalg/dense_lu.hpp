// SPDX-License-Identifier: LGPL-3.0-or-later
/// LU factors of a dense general matrix (LAPACK).
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace rubato::linalg {

class DenseLu {
public:
  /// Nothing comes back when the matrix is singular to working precision (an estimate of its reciprocal
  /// condition number in the 1-norm below 1e-15) or has a value that is not finite. Throws
  /// std::invalid_argument when it is not square.
  static std::optional<DenseLu> of(Eigen::MatrixXd matrix);

  Eigen::VectorXd solve(Eigen::VectorXd right_side) const;

private:
  Eigen::MatrixXd factors_;
  std::vector<int> pivots_;
};

} // namespace rubato::linalg
