// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/direct_solver.hpp"

#include <gtest/gtest.h>

#include "elastic_block.hpp"
#include "support/dense.hpp"
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>

namespace rubato::linalg::cholesky_factor_test {
namespace {

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(generator); });
}

/// About five entries a row; diagonally dominant, so positive definite.
Eigen::MatrixXd random_positive_definite(Eigen::Index size, unsigned seed) {
  const Eigen::MatrixXd drawn = random_matrix(size, size, seed);
  Eigen::MatrixXd matrix = (drawn.array().abs() < 2.5 / static_cast<double>(size)).select(drawn, 0.0);
  matrix = (matrix + matrix.transpose()).eval();
  matrix.diagonal() = matrix.cwiseAbs().rowwise().sum().array() + 0.1 / static_cast<double>(size);
  return matrix;
}

SparseMatrix sparse(const Eigen::MatrixXd& matrix) {
  return matrix.sparseView();
}

class CholeskyFactorOfSize : public testing::TestWithParam<int> {};

TEST_P(CholeskyFactorOfSize, SolvesAsADenseFactorDoes) {
  const auto matrix = random_positive_definite(GetParam(), 7);
  const Eigen::VectorXd right_side = random_matrix(GetParam(), 1, 8);
  const auto factor = CholeskyFactor::of(sparse(matrix));
  ASSERT_TRUE(factor);
  const Eigen::VectorXd expected = test::dense_solution(matrix, right_side);
  EXPECT_LE((factor->solve(right_side) - expected).norm(), 1e-10 * expected.norm());
}

TEST_P(CholeskyFactorOfSize, SolvesManyRightSidesAsOneByOne) {
  const auto factor = CholeskyFactor::of(sparse(random_positive_definite(GetParam(), 9)));
  ASSERT_TRUE(factor);
  const Eigen::MatrixXd right_sides = random_matrix(GetParam(), 7, 10);
  const Eigen::MatrixXd solutions = factor->solve(right_sides);
  ASSERT_EQ(solutions.cols(), 7);
  for (int k = 0; k < 7; ++k) {
    const Eigen::VectorXd one = factor->solve(Eigen::VectorXd(right_sides.col(k)));
    EXPECT_LE((solutions.col(k) - one).norm(), 1e-12 * one.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(RandomMatrices, CholeskyFactorOfSize, testing::Values(1, 2, 3, 10, 57, 300));

TEST(CholeskyFactor, SolvesABlockOfThreeDimensionalElasticity) {
  const auto stiffness = test::elastic_block(8, 6, 6);
  const auto factor = CholeskyFactor::of(stiffness);
  ASSERT_TRUE(factor);
  const Eigen::VectorXd exact = random_matrix(stiffness.cols(), 1, 11);
  const Eigen::VectorXd found = factor->solve(Eigen::VectorXd(stiffness * exact));
  EXPECT_LE((found - exact).norm(), 1e-10 * exact.norm());
}

TEST(CholeskyFactor, ReadsTheLowerTriangleOnly) {
  const auto matrix = random_positive_definite(40, 12);
  const Eigen::MatrixXd lower = matrix.triangularView<Eigen::Lower>();
  const Eigen::VectorXd right_side = random_matrix(40, 1, 13);
  const auto whole = CholeskyFactor::of(sparse(matrix));
  const auto half = CholeskyFactor::of(sparse(lower));
  ASSERT_TRUE(whole && half);
  EXPECT_EQ(whole->solve(right_side), half->solve(right_side));
}

TEST(CholeskyFactor, TakesAMatrixThatIsNotCompressed) {
  SparseMatrix matrix(3, 3);
  matrix.reserve(Eigen::VectorXi::Constant(3, 5));
  for (int i = 0; i < 3; ++i)
    matrix.insert(i, i) = 4;
  ASSERT_FALSE(matrix.isCompressed());
  const auto factor = CholeskyFactor::of(matrix);
  ASSERT_TRUE(factor);
  EXPECT_EQ(factor->solve(Eigen::VectorXd(Eigen::Vector3d(4, 8, 12))), Eigen::Vector3d(1, 2, 3));
}

TEST(CholeskyFactor, RefusesAFloatingBody) {
  EXPECT_FALSE(CholeskyFactor::of(test::elastic_block(1, 1, 1, false)));
  EXPECT_FALSE(CholeskyFactor::of(test::elastic_block(7, 4, 4, false)));
}

TEST(CholeskyFactor, RefusesAnIndefiniteMatrix) {
  auto matrix = random_positive_definite(50, 14);
  matrix(30, 30) = -1;
  EXPECT_FALSE(CholeskyFactor::of(sparse(matrix)));
  auto stiffness = test::elastic_block(6, 4, 4);
  stiffness.coeffRef(100, 100) *= -1;
  EXPECT_FALSE(CholeskyFactor::of(stiffness));
}

TEST(CholeskyFactor, RefusesAMissingDiagonal) {
  SparseMatrix matrix(2, 2);
  matrix.insert(0, 0) = 1;
  EXPECT_FALSE(CholeskyFactor::of(matrix));
}

TEST(CholeskyFactor, RefusesValuesThatAreNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    auto matrix = random_positive_definite(20, 15);
    matrix(11, 11) = bad;
    EXPECT_FALSE(CholeskyFactor::of(sparse(matrix)));
  }
}

TEST(CholeskyFactor, TakesScalesFarApartForWhatTheyAre) {
  Eigen::VectorXd diagonal(3);
  diagonal << 1e-20, 1, 1e20;
  const auto factor = CholeskyFactor::of(sparse(diagonal.asDiagonal()));
  ASSERT_TRUE(factor);
  EXPECT_TRUE(factor->solve(diagonal).isApprox(Eigen::VectorXd::Ones(3), 1e-14));
}

TEST(CholeskyFactor, TakesALongThinBeam) {
  const auto stiffness = test::elastic_block(400, 1, 1);
  const auto factor = CholeskyFactor::of(stiffness);
  ASSERT_TRUE(factor);
  const Eigen::VectorXd load = Eigen::VectorXd::Unit(stiffness.cols(), stiffness.cols() - 1);
  EXPECT_GT(factor->solve(load)[stiffness.cols() - 1], 0);
}

TEST(CholeskyFactor, TakesAnEmptySystem) {
  const auto factor = CholeskyFactor::of(SparseMatrix(0, 0));
  ASSERT_TRUE(factor);
  EXPECT_EQ(factor->solve(Eigen::VectorXd(0)).size(), 0);
  EXPECT_EQ(factor->solve(Eigen::MatrixXd(0, 2)).cols(), 2);
}

TEST(CholeskyFactor, RefusesSizesThatDoNotMatch) {
  EXPECT_THROW(CholeskyFactor::of(SparseMatrix(2, 3)), std::invalid_argument);
  const auto factor = CholeskyFactor::of(sparse(Eigen::MatrixXd::Identity(3, 3)));
  ASSERT_TRUE(factor);
  EXPECT_THROW(factor->solve(Eigen::VectorXd(2)), std::invalid_argument);
  EXPECT_THROW(factor->solve(Eigen::MatrixXd(4, 2)), std::invalid_argument);
}

TEST(CholeskyFactor, RepeatsItselfToTheLastBit) {
  const auto stiffness = test::elastic_block(7, 5, 5);
  const Eigen::VectorXd right_side = random_matrix(stiffness.cols(), 1, 16);
  const auto first = CholeskyFactor::of(stiffness);
  const auto second = CholeskyFactor::of(stiffness);
  ASSERT_TRUE(first && second);
  const Eigen::VectorXd solution = first->solve(right_side);
  EXPECT_EQ(solution, second->solve(right_side));
  EXPECT_EQ(solution, first->solve(right_side));
}

TEST(CholeskyFactor, OutlivesItsMatrixAndMoves) {
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(3);
  auto first = CholeskyFactor::of(sparse(4 * Eigen::MatrixXd::Identity(3, 3)));
  auto second = CholeskyFactor::of(sparse(16 * Eigen::MatrixXd::Identity(3, 3)));
  ASSERT_TRUE(first && second);
  CholeskyFactor moved = std::move(*first);
  EXPECT_EQ(moved.solve(ones), 0.25 * ones);
  moved = std::move(*second);
  EXPECT_EQ(moved.solve(ones), 0.0625 * ones);
}

TEST(CholeskyFactor, TellsTheBytesOfItsFactor) {
  const auto small = CholeskyFactor::of(test::elastic_block(3, 3, 3));
  const auto large = CholeskyFactor::of(test::elastic_block(8, 8, 8));
  ASSERT_TRUE(small && large);
  // Never less than the lower triangle it fills.
  EXPECT_GE(small->factor_bytes(),
            sizeof(double) * static_cast<std::size_t>(test::elastic_block(3, 3, 3).nonZeros()) / 2);
  EXPECT_GT(large->factor_bytes(), 10 * small->factor_bytes());
}

} // namespace
} // namespace rubato::linalg::cholesky_factor_test
