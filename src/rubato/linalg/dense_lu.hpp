// SPDX-License-Identifier: LGPL-3.0-or-later
/// LU factors of a dense general matrix: LAPACK's, of small ones Eigen's, which are done before LAPACK has
/// begun.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

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
  std::optional<Eigen::PartialPivLU<Eigen::MatrixXd>> small_;
  Eigen::MatrixXd factors_; ///< of LAPACK
  std::vector<int> pivots_;
};

} // namespace rubato::linalg
