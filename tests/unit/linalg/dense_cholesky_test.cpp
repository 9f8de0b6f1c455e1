// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/dense_cholesky.hpp"

#include <gtest/gtest.h>

#include "support/dense.hpp"
#include <algorithm>
#include <array>
#include <random>
#include <stdexcept>

namespace rubato::linalg::dense_cholesky_test {
namespace {

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(generator); });
}

TEST(DenseCholesky, SolvesByTheLowerTriangle) {
  for (const Eigen::Index size : {1, 2, 7, 48, 49, 150}) {
    const Eigen::MatrixXd root = random_matrix(size, size);
    const Eigen::MatrixXd matrix = root * root.transpose() + Eigen::MatrixXd::Identity(size, size);
    const Eigen::VectorXd wanted = random_matrix(size, 1);
    const Eigen::MatrixXd lower = matrix.triangularView<Eigen::Lower>();
    EXPECT_LT((solve_positive_definite(lower, matrix * wanted) - wanted).lpNorm<Eigen::Infinity>(), 1e-10)
        << size;
  }
}

TEST(DenseCholesky, KnowsIndefiniteMatrices) {
  for (const Eigen::Index size : {3, 60}) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(size, size);
    matrix(1, 1) = -1;
    EXPECT_TRUE(solve_positive_definite(matrix, Eigen::VectorXd::Ones(size)).array().isNaN().all()) << size;
  }
}

TEST(DenseCholesky, InvertsByTheUpperTriangle) {
  for (const Eigen::Index size : {0, 1, 7, 60}) {
    const Eigen::MatrixXd root = random_matrix(size, size);
    const Eigen::MatrixXd matrix = root * root.transpose() + Eigen::MatrixXd::Identity(size, size);
    const auto inverse = inverse_of_positive_definite(matrix.triangularView<Eigen::Upper>());
    ASSERT_TRUE(inverse);
    EXPECT_EQ(*inverse, inverse->transpose());
    EXPECT_TRUE((*inverse * matrix).isIdentity(1e-11)) << size;
  }
  EXPECT_FALSE(inverse_of_positive_definite(Eigen::Vector2d(1, -1).asDiagonal()));
  EXPECT_THROW(inverse_of_positive_definite(Eigen::MatrixXd::Zero(2, 3)), std::invalid_argument);
}

TEST(DenseCholesky, SolvesAmongSomeUnknownsInTheirOrder) {
  const Eigen::MatrixXd matrix = Eigen::Vector4d(1, 4, 9, 16).asDiagonal();
  const Eigen::VectorXd values = Eigen::Vector4d(3, -8, 5, 32);
  const std::array<Eigen::Index, 2> unknowns{3, 1};
  EXPECT_EQ(solve_among(unknowns, matrix, values), Eigen::VectorXd(Eigen::Vector2d(-2, 2)));
}

TEST(DenseCholesky, OfNothingSolvesNothing) {
  EXPECT_EQ(solve_positive_definite(Eigen::MatrixXd(0, 0), Eigen::VectorXd(0)).size(), 0);
}

TEST(DenseCholesky, ThrowsForSizesThatDoNotMatch) {
  EXPECT_THROW(solve_positive_definite(Eigen::MatrixXd::Identity(3, 3), Eigen::VectorXd::Ones(2)),
               std::invalid_argument);
}

TEST(IndependentRows, AreAsManyAsTheRank) {
  Eigen::MatrixXd basis(6, 3);
  basis << 1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1, 1, 1, 1, 1, 0, 0, 0;
  const Eigen::MatrixXd matrix = basis * basis.transpose();
  const auto rows = independent_rows(matrix, 1e-10);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_GT(test::determinant(matrix(rows, rows)), 0.1);
  EXPECT_TRUE(std::ranges::is_sorted(rows));
  EXPECT_TRUE(independent_rows(Eigen::MatrixXd::Zero(2, 2), 1e-10).empty());
}

} // namespace
} // namespace rubato::linalg::dense_cholesky_test
