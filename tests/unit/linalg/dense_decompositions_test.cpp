// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/dense_decompositions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace rubato::linalg::dense_decompositions_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

const MatrixXd a{{2, 1, 0}, {1, 2, 1}, {0, 1, 2}}; // 2 − √2, 2, 2 + √2

TEST(DenseDecompositions, FindEigenvaluesOfSymmetricMatrices) {
  const auto [values, vectors] = symmetric_eigen(a);
  EXPECT_NEAR(values[0], 2 - std::sqrt(2), 1e-14);
  EXPECT_NEAR(values[1], 2, 1e-14);
  EXPECT_NEAR(values[2], 2 + std::sqrt(2), 1e-14);
  EXPECT_LT((a * vectors - vectors * values.asDiagonal()).norm(), 1e-14);
  EXPECT_LT((symmetric_eigenvalues(a) - values).norm(), 1e-14);
  EXPECT_NEAR(largest_of_tridiagonal(VectorXd::Constant(3, 2.), VectorXd::Ones(2)), values[2], 1e-14);
}

TEST(DenseDecompositions, ReadTheLowerTriangle) {
  MatrixXd lower = a;
  lower(0, 1) = lower(0, 2) = lower(1, 2) = 99;
  EXPECT_LT((symmetric_eigenvalues(lower) - symmetric_eigenvalues(a)).norm(), 1e-14);
}

TEST(DenseDecompositions, FindEigenvaluesOfTwoMatrices) {
  const MatrixXd b{{2, 0, 0}, {0, 1, 0}, {0, 0, 4}};
  const auto [values, vectors] = generalized_eigen(a, b);
  EXPECT_LT((a * vectors - b * vectors * values.asDiagonal()).norm(), 1e-13);
  EXPECT_LT((vectors.transpose() * b * vectors - MatrixXd::Identity(3, 3)).norm(), 1e-14);
  EXPECT_FALSE(generalized_eigen(a, -b).values.allFinite());
}

TEST(DenseDecompositions, CompleteColumnsToAnOrthogonalBasis) {
  const MatrixXd columns{{1, 1}, {0, 2}, {1, 0}};
  const MatrixXd q = orthogonal_factor(columns);
  EXPECT_LT((q.transpose() * q - MatrixXd::Identity(3, 3)).norm(), 1e-15);
  EXPECT_LT((columns.transpose() * q.col(2)).norm(), 1e-15);
  EXPECT_EQ(orthogonal_factor(MatrixXd(2, 0)), MatrixXd::Identity(2, 2));
}

TEST(DenseDecompositions, SolveSymmetricSystemsWithZerosOnTheDiagonal) {
  const MatrixXd indefinite{{1, 2, 0}, {2, 0, 3}, {0, 3, -5}};
  const MatrixXd wanted{{1, 4}, {-2, 5}, {3, 6}};
  const double bound = 1e-14 * wanted.norm();
  EXPECT_LT((solve_symmetric(indefinite, indefinite * wanted) - wanted).norm(), bound);
  EXPECT_LT((solve_symmetric(a, a * wanted) - wanted).norm(), bound);
}

TEST(DenseDecompositions, InvertWhatHasAnInverse) {
  const MatrixXd tall{{1, 0}, {1, 1}, {1, 2}};
  EXPECT_LT((pseudo_inverse(tall) * tall - MatrixXd::Identity(2, 2)).norm(), 1e-14);
  const MatrixXd same{{1, 1}, {1, 1}};
  EXPECT_LT((pseudo_inverse(same) - same / 4).norm(), 1e-15);
  EXPECT_LT((least_norm_solution(same, VectorXd::Constant(2, 2.)) - VectorXd::Ones(2)).norm(), 1e-14);
}

TEST(DenseDecompositions, ChooseColumnsThatSpanAll) {
  const MatrixXd columns{{1, 0, 3, 0}, {0, 1e-12, 0, 0}, {0, 0, 0, 2}};
  EXPECT_EQ(independent_columns(columns, 1e-9), (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(independent_columns(columns, 1e-13), (std::vector<std::size_t>{2, 3, 1}));
  EXPECT_TRUE(independent_columns(MatrixXd::Zero(2, 2), 1e-9).empty());
}

} // namespace
} // namespace rubato::linalg::dense_decompositions_test
