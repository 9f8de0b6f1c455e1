// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/direct_solver.hpp"

#include <gtest/gtest.h>

#include "elastic_block.hpp"
#include "support/dense.hpp"
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>

namespace rubato::linalg::symmetric_factor_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd random_matrix(Index rows, Index columns, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  return MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(generator); });
}

/// Entries of both signs, about six a row; every fourth row has nothing on the diagonal.
MatrixXd random_indefinite(Index size, unsigned seed) {
  const MatrixXd drawn = random_matrix(size, size, seed);
  MatrixXd matrix =
      (drawn.array().abs() < 3.0 / static_cast<double>(size)).select(drawn * static_cast<double>(size), 0.0);
  matrix = (matrix + matrix.transpose()).eval();
  matrix.diagonal() = random_matrix(size, 1, seed + 1000);
  for (Index i = 1; i + 1 < size; i += 4) {
    matrix(i, i) = 0;
    matrix(i, i + 1) = matrix(i + 1, i) = 1; // a row must not be all zero
  }
  return matrix;
}

SparseMatrix sparse(const MatrixXd& matrix) {
  return matrix.sparseView();
}

int negative_eigenvalues(const MatrixXd& matrix) {
  return static_cast<int>((test::symmetric_eigenvalues(matrix).array() < 0).count());
}

class SymmetricFactorOfSize : public testing::TestWithParam<int> {};

TEST_P(SymmetricFactorOfSize, SolvesAndCountsNegativeEigenvalues) {
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    const auto matrix = random_indefinite(GetParam(), seed);
    const auto factor = SymmetricFactor::of(sparse(matrix));
    ASSERT_TRUE(factor) << seed;
    EXPECT_EQ(factor->negative_pivots(), negative_eigenvalues(matrix)) << seed;
    const VectorXd right_side = random_matrix(GetParam(), 1, seed + 50);
    const VectorXd found = factor->solve(right_side);
    EXPECT_LE((matrix * found - right_side).norm(), 1e-13 * matrix.norm() * found.norm()) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(RandomMatrices, SymmetricFactorOfSize, testing::Values(1, 2, 3, 10, 57, 300));

TEST(SymmetricFactor, CountsEverySignOfDiagonals) {
  VectorXd diagonal(5);
  diagonal << 3, -1e-9, 2e12, -4, -1;
  const auto factor = SymmetricFactor::of(sparse(diagonal.asDiagonal()));
  ASSERT_TRUE(factor);
  EXPECT_EQ(factor->negative_pivots(), 3);
  EXPECT_LE((factor->solve(diagonal) - VectorXd::Ones(5)).norm(), 1e-15);
}

TEST(SymmetricFactor, CountsPivotsOfTwoRows) {
  MatrixXd matrix = MatrixXd::Zero(6, 6);
  for (Index i = 0; i < 6; i += 2)
    matrix(i, i + 1) = matrix(i + 1, i) = 2;
  const auto factor = SymmetricFactor::of(sparse(matrix));
  ASSERT_TRUE(factor);
  EXPECT_EQ(factor->negative_pivots(), 3);
  EXPECT_EQ(factor->solve(VectorXd::Ones(6)), 0.5 * VectorXd::Ones(6));
}

/// A block less so much of its mass (one at every unknown) that a known number of its eigenvalues is passed.
TEST(SymmetricFactor, CountsEigenvaluesPassedByAShift) {
  const auto block = test::elastic_block(5, 3, 2, true, 1.0); // not square: no eigenvalue is double
  const VectorXd values = test::symmetric_eigenvalues(block);
  for (const Index passed : {0, 1, 4, 37}) {
    const double shift = passed == 0 ? 0 : 0.5 * (values[passed - 1] + values[passed]);
    SparseMatrix shifted = block;
    shifted.diagonal().array() -= shift;
    const auto factor = SymmetricFactor::of(shifted);
    ASSERT_TRUE(factor) << passed;
    EXPECT_EQ(factor->negative_pivots(), passed);
  }
}

TEST(SymmetricFactor, SolvesATiedBlockOfElasticityDespiteItsUnits) {
  // Large enough that MUMPS works by another ordering than on small systems.
  const auto matrix = test::tied_block(test::elastic_block(16, 10, 9), 30, 110);
  ASSERT_GT(matrix.cols(), 5000);
  const auto factor = SymmetricFactor::of(matrix);
  ASSERT_TRUE(factor);
  EXPECT_EQ(factor->negative_pivots(), 90) << "one a multiplier: the block is positive definite";
  VectorXd exact = random_matrix(matrix.cols(), 1, 23);
  exact.tail(90) *= 1e11; // multipliers are forces
  const VectorXd found = factor->solve(VectorXd(matrix * exact));
  const auto unknowns = matrix.cols() - 90;
  EXPECT_LE((found - exact).head(unknowns).norm(), 1e-10 * exact.head(unknowns).norm());
  EXPECT_LE((found - exact).tail(90).norm(), 1e-10 * exact.tail(90).norm());
}

TEST(SymmetricFactor, AgreesWithCholeskyOnAPositiveDefiniteMatrix) {
  const auto matrix = test::elastic_block(7, 5, 4);
  const auto factor = SymmetricFactor::of(matrix);
  ASSERT_TRUE(factor);
  EXPECT_EQ(factor->negative_pivots(), 0);
  const VectorXd right_side = random_matrix(matrix.rows(), 1, 5);
  const VectorXd expected = CholeskyFactor::of(matrix)->solve(right_side);
  EXPECT_LE((factor->solve(right_side) - expected).norm(), 1e-11 * expected.norm());
}

TEST(SymmetricFactor, ReadsTheLowerTriangleAlone) {
  const auto matrix = random_indefinite(40, 6);
  MatrixXd other = matrix;
  other.triangularView<Eigen::StrictlyUpper>() = 7 * random_matrix(40, 40, 7);
  const VectorXd right_side = random_matrix(40, 1, 8);
  EXPECT_EQ(SymmetricFactor::of(sparse(other))->solve(right_side),
            SymmetricFactor::of(sparse(matrix))->solve(right_side));
}

TEST(SymmetricFactor, RefusesADependentRow) {
  for (const int size : {2, 10, 57, 300}) {
    auto matrix = random_indefinite(size, 9);
    const Index last = size - 1;
    const VectorXd combination = 0.5 * matrix.col(0).head(last);
    matrix.col(last).head(last) = combination;
    matrix.row(last).head(last) = combination.transpose();
    matrix(last, last) = 0.25 * matrix(0, 0);
    EXPECT_FALSE(SymmetricFactor::of(sparse(matrix))) << size;
  }
}

TEST(SymmetricFactor, RefusesAFloatingBody) {
  EXPECT_FALSE(SymmetricFactor::of(test::elastic_block(2, 1, 1, false)));
  EXPECT_FALSE(SymmetricFactor::of(test::elastic_block(7, 5, 5, false)));
}

TEST(SymmetricFactor, RefusesAConstraintGivenTwice) {
  const auto block = test::elastic_block(3, 2, 2);
  const auto tied = test::tied_block(block, 2, 9);
  MatrixXd matrix(tied);
  const Index last = matrix.rows() - 1;
  matrix.row(last) = matrix.row(last - 1);
  matrix.col(last) = matrix.col(last - 1);
  EXPECT_FALSE(SymmetricFactor::of(sparse(matrix)));
}

TEST(SymmetricFactor, RefusesAPatternThatNoValuesMakeRegular) {
  MatrixXd matrix = MatrixXd::Zero(4, 4);
  matrix.col(0).setOnes();
  matrix.row(0).setOnes();
  EXPECT_FALSE(SymmetricFactor::of(sparse(matrix)));
  EXPECT_FALSE(SymmetricFactor::of(SparseMatrix(3, 3)));
}

TEST(SymmetricFactor, RefusesValuesThatAreNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    auto matrix = random_indefinite(30, 10);
    matrix(21, 3) = matrix(3, 21) = bad;
    EXPECT_FALSE(SymmetricFactor::of(sparse(matrix)));
  }
}

TEST(SymmetricFactor, RepeatsItselfToTheLastBit) {
  const auto matrix = test::tied_block(test::elastic_block(7, 4, 4), 10, 25);
  const VectorXd right_side = random_matrix(matrix.cols(), 1, 28);
  const auto first = SymmetricFactor::of(matrix);
  const auto second = SymmetricFactor::of(matrix);
  ASSERT_TRUE(first && second);
  const VectorXd solution = first->solve(right_side);
  EXPECT_EQ(solution, second->solve(right_side));
  EXPECT_EQ(solution, first->solve(right_side));
}

TEST(SymmetricFactor, OutlivesItsMatrixAndMoves) {
  const VectorXd ones = VectorXd::Ones(3);
  auto first = SymmetricFactor::of(sparse(2 * MatrixXd::Identity(3, 3)));
  auto second = SymmetricFactor::of(sparse(-4 * MatrixXd::Identity(3, 3)));
  ASSERT_TRUE(first && second);
  SymmetricFactor moved = std::move(*first);
  EXPECT_EQ(moved.solve(ones), 0.5 * ones);
  moved = std::move(*second);
  EXPECT_EQ(moved.solve(ones), -0.25 * ones);
  EXPECT_EQ(moved.negative_pivots(), 3);
}

TEST(SymmetricFactor, TakesEmptySystemsAndRefusesSizesThatDoNotMatch) {
  const auto empty = SymmetricFactor::of(SparseMatrix(0, 0));
  ASSERT_TRUE(empty);
  EXPECT_EQ(empty->solve(VectorXd(0)).size(), 0);
  EXPECT_EQ(empty->negative_pivots(), 0);
  EXPECT_THROW(SymmetricFactor::of(SparseMatrix(2, 3)), std::invalid_argument);
  EXPECT_THROW(empty->solve(VectorXd(1)), std::invalid_argument);
}

TEST(SymmetricFactor, PrintsNothing) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  SymmetricFactor::of(test::elastic_block(2, 2, 2));
  SymmetricFactor::of(test::elastic_block(2, 2, 2, false));
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

} // namespace
} // namespace rubato::linalg::symmetric_factor_test
