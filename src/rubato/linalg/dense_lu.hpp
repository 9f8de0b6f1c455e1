// SPDX-License-Identifier: LGPL-3.0-or-later
/// LU factors of a dense general matrix: LAPACK's, of small ones Eigen's, which are done before LAPACK has
/// begun.
#pragma once

#include "rubato/core/threads.hpp"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <vector>

namespace rubato::linalg {

class DenseLu {
public:
  /// Nothing comes back when the matrix is singular to working precision (an estimate of its reciprocal
  /// condition number in the 1-norm below 1e-15) or has a value that is not finite. Throws
  /// std::invalid_argument when it is not square. Large ones are factored by all threads; with more than one,
  /// nobody else may be in BLAS meanwhile.
  static std::optional<DenseLu> of(Eigen::MatrixXd matrix, const Threads& threads = {});

  DenseLu(DenseLu&&) noexcept;
  DenseLu& operator=(DenseLu&&) noexcept;
  DenseLu(const DenseLu&) = delete;
  DenseLu& operator=(const DenseLu&) = delete;
  ~DenseLu();

  Eigen::VectorXd solve(Eigen::VectorXd right_side) const;

private:
  struct Small;

  DenseLu();
  bool factor_small();
  bool factor_large(const Threads& threads);

  Eigen::MatrixXd factors_; ///< in the place of the matrix; a move leaves its numbers where they are
  /// Of a small matrix: refers to the numbers of `factors_`.
  std::unique_ptr<Small> small_;
  std::vector<int> pivots_; ///< of LAPACK
};

} // namespace rubato::linalg
