// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/pivoted_qr.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace rubato::linalg::pivoted_qr_test {
namespace {

using Eigen::MatrixXd;

MatrixXd matrix_of(Eigen::Index rows, std::initializer_list<double> by_row) {
  MatrixXd matrix(rows, static_cast<Eigen::Index>(by_row.size()) / rows);
  const double* value = by_row.begin();
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      matrix(i, j) = *value++;
  return matrix;
}

/// A line through (0, 1), (1, 2), (2, 4): y = 5/6 + 3/2 x.
TEST(PivotedQr, LeavesTheLeastSquares) {
  const MatrixXd x = PivotedQr(matrix_of(3, {1, 0, 1, 1, 1, 2})).solve(matrix_of(3, {1, 2, 4}));
  EXPECT_NEAR(x(0, 0), 5. / 6, 1e-14);
  EXPECT_NEAR(x(1, 0), 1.5, 1e-14);
}

TEST(PivotedQr, CountsIndependentColumns) {
  const PivotedQr qr(matrix_of(4, {1, 2, 3, 0, 1, 1, 2, 0, 2, 1, 1, 2}));
  EXPECT_EQ(qr.rank(), 2);
  const MatrixXd basis = qr.basis();
  ASSERT_EQ(basis.cols(), 2);
  EXPECT_NEAR(basis.col(0).dot(basis.col(1)), 0, 1e-15);
  EXPECT_NEAR(basis.col(0).norm(), 1, 1e-15);
  EXPECT_EQ(PivotedQr(MatrixXd::Zero(3, 2)).rank(), 0);
  EXPECT_EQ(PivotedQr(MatrixXd(3, 0)).rank(), 0);
}

/// x₁ + x₂ = 2 and the same once more: the smallest solution is (1, 1).
TEST(PivotedQr, FindsTheSmallestOfManySolutions) {
  const MatrixXd x = PivotedQr(matrix_of(2, {1, 1, 1, 1})).least_norm(matrix_of(2, {2, 2}));
  EXPECT_NEAR(x(0, 0), 1, 1e-15);
  EXPECT_NEAR(x(1, 0), 1, 1e-15);
  const MatrixXd wide = PivotedQr(matrix_of(1, {3, 4})).least_norm(matrix_of(1, {25}));
  EXPECT_NEAR(wide(0, 0), 3, 1e-14);
  EXPECT_NEAR(wide(1, 0), 4, 1e-14);
}

TEST(PivotedQr, RefusesRightSidesOfAnotherSize) {
  EXPECT_THROW(PivotedQr(MatrixXd::Identity(3, 2)).solve(MatrixXd::Ones(2, 1)), std::invalid_argument);
  EXPECT_THROW(PivotedQr(MatrixXd::Identity(3, 2)).least_norm(MatrixXd::Ones(2, 1)), std::invalid_argument);
}

} // namespace
} // namespace rubato::linalg::pivoted_qr_test
