// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/equilibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rubato::linalg::equilibration_test {
namespace {

SparseMatrix sparse(const Eigen::MatrixXd& matrix) {
  return matrix.sparseView();
}

TEST(Equilibration, BringsRowAndColumnMaximaNearOne) {
  Eigen::MatrixXd matrix(3, 3);
  matrix << 2e11, -1e11, 1, -1e11, 2e11, -1, 1, -1, 0;
  const auto result = equilibrated(sparse(matrix));
  ASSERT_TRUE(result);
  const Eigen::MatrixXd scaled = Eigen::MatrixXd(result->matrix).cwiseAbs();
  for (int i = 0; i < 3; ++i) {
    EXPECT_GT(scaled.row(i).maxCoeff(), 0.25);
    EXPECT_LT(scaled.row(i).maxCoeff(), 4);
    EXPECT_GT(scaled.col(i).maxCoeff(), 0.25);
    EXPECT_LT(scaled.col(i).maxCoeff(), 4);
  }
}

TEST(Equilibration, RoundsNothing) {
  Eigen::MatrixXd matrix(2, 2);
  matrix << 1.0 / 3.0 * 1e200, 0.1, 7e-3, 1.1e-150;
  const auto result = equilibrated(sparse(matrix));
  ASSERT_TRUE(result);
  int exponent = 0;
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(std::frexp(result->rows[i], &exponent), 0.5);
    EXPECT_EQ(std::frexp(result->columns[i], &exponent), 0.5);
    for (int j = 0; j < 2; ++j)
      EXPECT_EQ(result->matrix.coeff(i, j) / result->rows[i] / result->columns[j], matrix(i, j));
  }
}

TEST(Equilibration, KeepsASymmetricMatrixSymmetric) {
  Eigen::MatrixXd matrix(3, 3);
  matrix << 3e9, 2e4, 1, 2e4, 1e-6, 5, 1, 5, 0;
  const auto result = equilibrated(sparse(matrix));
  ASSERT_TRUE(result);
  EXPECT_EQ(result->rows, result->columns);
  const Eigen::MatrixXd scaled(result->matrix);
  EXPECT_EQ(scaled, scaled.transpose());
}

TEST(Equilibration, RefusesEmptyRowsAndColumnsAndWhatIsNotFinite) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(3, 3);
  matrix(1, 1) = 0;
  EXPECT_FALSE(equilibrated(sparse(matrix)));
  matrix(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(equilibrated(sparse(matrix)));
  matrix(1, 1) = -std::numeric_limits<double>::infinity();
  EXPECT_FALSE(equilibrated(sparse(matrix)));
}

TEST(Equilibration, BringsDenseRowsAndColumnsToOne) {
  Eigen::MatrixXd matrix(3, 3);
  matrix << 2e11, 0, -1e3, 4e-7, 0, 5e-9, 0, 0, 0;
  Eigen::MatrixXd scaled = matrix;
  Eigen::VectorXd rows, columns;
  equilibrate(scaled, rows, columns);
  EXPECT_NEAR(scaled.row(0).lpNorm<Eigen::Infinity>(), 1, 1e-15);
  EXPECT_NEAR(scaled.row(1).lpNorm<Eigen::Infinity>(), 1, 1e-15);
  EXPECT_EQ(rows[2], 1);
  EXPECT_EQ(columns[1], 1);
  const Eigen::MatrixXd expected = rows.asDiagonal() * matrix * columns.asDiagonal();
  EXPECT_LE((scaled - expected).lpNorm<Eigen::Infinity>(), 1e-15);
}

} // namespace
} // namespace rubato::linalg::equilibration_test
