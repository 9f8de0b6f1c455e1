// SPDX-License-Identifier: LGPL-3.0-or-later
/// QR factors with column pivoting by LAPACK: least squares and the rank of dense matrices.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace rubato::linalg {

/// A P = Q R, |R_kk| descending.
class PivotedQr {
public:
  explicit PivotedQr(Eigen::MatrixXd matrix);

  /// Number of pivots |R_kk| > threshold |R_00|. The threshold is min(rows, columns) ε.
  Eigen::Index rank() const;
  /// x that leaves least of A x = b, one column a right side. Unknowns of pivots that are rounding are 0.
  Eigen::MatrixXd solve(Eigen::MatrixXd right_sides) const;
  /// The smallest x that leaves least of A x = b, whatever the rank, one column a right side.
  Eigen::MatrixXd least_norm(Eigen::MatrixXd right_sides) const;
  /// The first rank() columns of Q: they span the columns of A.
  Eigen::MatrixXd basis() const;

private:
  Eigen::Index pivots_beyond_rounding() const;
  void apply_transposed(Eigen::Index reflections, Eigen::MatrixXd& values) const;
  Eigen::MatrixXd in_order_of_unknowns(const Eigen::MatrixXd& values, Eigen::Index count) const;

  Eigen::MatrixXd factors_; ///< R above the diagonal, the reflections of Q below it
  std::vector<double> reflection_factors_;
  std::vector<int> pivots_; ///< of each column of R its column of A, counted from 1
};

} // namespace rubato::linalg
