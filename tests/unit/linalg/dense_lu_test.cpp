// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/dense_lu.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <stdexcept>

namespace rubato::linalg::dense_lu_test {
namespace {

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(generator); });
}

TEST(DenseLu, SolvesGeneralSystems) {
  for (const Eigen::Index size : {1, 2, 7, 48, 49, 150}) {
    const Eigen::MatrixXd matrix = random_matrix(size, size);
    const Eigen::VectorXd wanted = random_matrix(size, 1);
    const auto lu = DenseLu::of(matrix);
    ASSERT_TRUE(lu) << size;
    EXPECT_LT((lu->solve(matrix * wanted) - wanted).lpNorm<Eigen::Infinity>(), 1e-10) << size;
  }
}

TEST(DenseLu, OfLargeSystemsAreTheSameByThreads) {
  const Eigen::MatrixXd matrix = random_matrix(1100, 1100);
  const Eigen::VectorXd right = random_matrix(1100, 1);
  const auto by_one = DenseLu::of(matrix)->solve(right);
  const auto by_two = DenseLu::of(matrix, Threads(2))->solve(right);
  EXPECT_LT((matrix * by_two - right).lpNorm<Eigen::Infinity>(), 1e-9);
  EXPECT_LT((by_two - by_one).norm(), 1e-9 * by_one.norm());
}

TEST(DenseLu, OfNothingSolvesNothing) {
  const auto lu = DenseLu::of(Eigen::MatrixXd(0, 0));
  ASSERT_TRUE(lu);
  EXPECT_EQ(lu->solve(Eigen::VectorXd(0)).size(), 0);
}

TEST(DenseLu, RefusesSingularAndInfiniteMatrices) {
  Eigen::MatrixXd matrix = random_matrix(6, 6);
  matrix.col(3) = 2 * matrix.col(1) - matrix.col(0);
  EXPECT_FALSE(DenseLu::of(matrix));
  EXPECT_FALSE(DenseLu::of(Eigen::MatrixXd::Zero(3, 3)));
  Eigen::MatrixXd large = random_matrix(60, 60);
  large.row(17) = large.row(2) + large.row(40);
  EXPECT_FALSE(DenseLu::of(large));
  matrix(2, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(DenseLu::of(matrix));
}

TEST(DenseLu, ThrowsForSizesThatDoNotMatch) {
  EXPECT_THROW(DenseLu::of(Eigen::MatrixXd::Identity(3, 2)), std::invalid_argument);
  EXPECT_THROW(DenseLu::of(Eigen::MatrixXd::Identity(3, 3))->solve(Eigen::VectorXd::Ones(2)),
               std::invalid_argument);
}

} // namespace
} // namespace rubato::linalg::dense_lu_test
