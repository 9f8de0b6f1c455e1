// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/direct_solver.hpp"

#include <gtest/gtest.h>

#include "elastic_block.hpp"
#include "support/dense.hpp"
#include <limits>
#include <ostream>
#include <random>
#include <stdexcept>
#include <utility>

namespace rubato::linalg {

/// What GoogleTest calls an engine.
static void PrintTo(GeneralEngine engine, std::ostream* out) {
  switch (engine) {
  case GeneralEngine::automatic:
    *out << "Automatic";
    break;
  case GeneralEngine::umfpack:
    *out << "Umfpack";
    break;
  case GeneralEngine::mumps:
    *out << "Mumps";
    break;
  }
}

} // namespace rubato::linalg

namespace rubato::linalg::lu_factor_test {
namespace {

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(generator); });
}

/// [K Bᵀ; B' 0] with a diagonal K and, when they differ, unsymmetric borders; regular for these sizes and
/// seeds.
Eigen::MatrixXd random_saddle(int size, int border, bool symmetric, unsigned seed) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size + border, size + border);
  matrix.diagonal().head(size) = random_matrix(size, 1, seed).array() + 1.5;
  matrix.topRightCorner(size, border) = random_matrix(size, border, seed + 1);
  matrix.bottomLeftCorner(border, size) = matrix.topRightCorner(size, border).transpose();
  if (!symmetric)
    matrix.bottomLeftCorner(border, size) += 0.3 * random_matrix(border, size, seed + 2);
  return matrix;
}

SparseMatrix sparse(const Eigen::MatrixXd& matrix) {
  return matrix.sparseView();
}

class LuFactorBy : public testing::TestWithParam<GeneralEngine> {
protected:
  static std::optional<LuFactor> factor(const SparseMatrix& matrix) {
    return LuFactor::of(matrix, GetParam());
  }
};

INSTANTIATE_TEST_SUITE_P(Engines, LuFactorBy,
                         testing::Values(GeneralEngine::automatic, GeneralEngine::umfpack,
                                         GeneralEngine::mumps),
                         testing::PrintToStringParamName());

TEST_P(LuFactorBy, SolvesSaddlesAsADenseFactorDoes) {
  for (const int size : {1, 2, 5, 20, 90, 300})
    for (const bool symmetric : {true, false}) {
      const auto matrix = random_saddle(size, (size + 2) / 3, symmetric, 21);
      const Eigen::VectorXd right_side = random_matrix(matrix.cols(), 1, 22);
      const auto lu = factor(sparse(matrix));
      ASSERT_TRUE(lu) << size;
      const Eigen::VectorXd expected = test::dense_solution(matrix, right_side);
      const Eigen::VectorXd found = lu->solve(right_side);
      EXPECT_LE((found - expected).norm(), 1e-10 * expected.norm()) << size;
      EXPECT_LE((matrix * found - right_side).norm(), 1e-12 * matrix.norm() * found.norm()) << size;
    }
}

TEST_P(LuFactorBy, SolvesATiedBlockOfElasticityDespiteItsUnits) {
  const auto matrix = test::tied_block(test::elastic_block(8, 5, 5), 30, 36);
  const auto lu = factor(matrix);
  ASSERT_TRUE(lu);
  Eigen::VectorXd exact = random_matrix(matrix.cols(), 1, 23);
  exact.tail(90) *= 1e11; // multipliers are forces
  const Eigen::VectorXd found = lu->solve(Eigen::VectorXd(matrix * exact));
  const auto unknowns = matrix.cols() - 90;
  EXPECT_LE((found - exact).head(unknowns).norm(), 1e-10 * exact.head(unknowns).norm());
  EXPECT_LE((found - exact).tail(90).norm(), 1e-10 * exact.tail(90).norm());
}

TEST_P(LuFactorBy, SolvesAFloatingBlockHeldByMultipliersAlone) {
  // Positive semi-definite inside, regular with its ties to the fixed world: the case an LDLᵀ without
  // pivoting loses.
  const auto stiffness = test::elastic_block(3, 3, 3, false);
  const auto n = static_cast<int>(stiffness.cols());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n + 12, n + 12);
  matrix.topLeftCorner(n, n) = Eigen::MatrixXd(stiffness);
  for (int k = 0; k < 12; ++k) { // two nodes at either end of a diagonal
    const int unknown = k < 6 ? k : n - 12 + k;
    matrix(n + k, unknown) = matrix(unknown, n + k) = 1;
  }
  const auto lu = factor(sparse(matrix));
  ASSERT_TRUE(lu);
  const Eigen::VectorXd right_side = random_matrix(n + 12, 1, 24);
  const Eigen::VectorXd found = lu->solve(right_side);
  EXPECT_LE((matrix * found - right_side).norm(), 1e-13 * matrix.norm() * found.norm());
}

TEST_P(LuFactorBy, RefusesADependentRow) {
  auto matrix = random_saddle(60, 12, false, 25);
  matrix.row(41) = 0.5 * matrix.row(7) - 3 * matrix.row(65);
  EXPECT_FALSE(factor(sparse(matrix)));
}

TEST_P(LuFactorBy, RefusesAConstraintGivenTwice) {
  auto matrix = random_saddle(60, 12, true, 26);
  matrix.row(65) = matrix.row(66);
  matrix.col(65) = matrix.col(66);
  EXPECT_FALSE(factor(sparse(matrix)));
}

TEST_P(LuFactorBy, RefusesAFloatingBody) {
  EXPECT_FALSE(factor(test::elastic_block(2, 1, 1, false)));
  EXPECT_FALSE(factor(test::elastic_block(7, 5, 5, false)));
}

TEST_P(LuFactorBy, RefusesAPatternThatNoValuesMakeRegular) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(4, 4);
  matrix.col(0).setOnes();
  matrix.row(0).setOnes();
  EXPECT_FALSE(factor(sparse(matrix)));
  EXPECT_FALSE(factor(SparseMatrix(3, 3)));
}

TEST_P(LuFactorBy, RefusesValuesThatAreNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    auto matrix = random_saddle(30, 5, false, 27);
    matrix(3, 31) = bad;
    EXPECT_FALSE(factor(sparse(matrix)));
  }
}

TEST_P(LuFactorBy, RepeatsItselfToTheLastBit) {
  const auto matrix = test::tied_block(test::elastic_block(7, 4, 4), 10, 25);
  const Eigen::VectorXd right_side = random_matrix(matrix.cols(), 1, 28);
  const auto first = factor(matrix);
  const auto second = factor(matrix);
  ASSERT_TRUE(first && second);
  const Eigen::VectorXd solution = first->solve(right_side);
  EXPECT_EQ(solution, second->solve(right_side));
  EXPECT_EQ(solution, first->solve(right_side));
}

TEST_P(LuFactorBy, OutlivesItsMatrixAndMoves) {
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(3);
  auto first = factor(sparse(2 * Eigen::MatrixXd::Identity(3, 3)));
  auto second = factor(sparse(-4 * Eigen::MatrixXd::Identity(3, 3)));
  ASSERT_TRUE(first && second);
  LuFactor moved = std::move(*first);
  EXPECT_EQ(moved.solve(ones), 0.5 * ones);
  moved = std::move(*second);
  EXPECT_EQ(moved.solve(ones), -0.25 * ones);
}

TEST_P(LuFactorBy, TakesEmptySystemsAndRefusesSizesThatDoNotMatch) {
  const auto empty = factor(SparseMatrix(0, 0));
  ASSERT_TRUE(empty);
  EXPECT_EQ(empty->solve(Eigen::VectorXd(0)).size(), 0);
  EXPECT_THROW(factor(SparseMatrix(2, 3)), std::invalid_argument);
  EXPECT_THROW(empty->solve(Eigen::VectorXd(1)), std::invalid_argument);
}

TEST_P(LuFactorBy, PrintsNothing) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  factor(test::elastic_block(2, 2, 2));
  factor(test::elastic_block(2, 2, 2, false));
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(LuFactor, EnginesAgree) {
  // Large enough that MUMPS works by another ordering than on small systems.
  const auto matrix = test::tied_block(test::elastic_block(40, 12, 9), 20, 130);
  ASSERT_GT(matrix.cols(), 15'000);
  const Eigen::VectorXd right_side = random_matrix(matrix.cols(), 1, 29);
  const auto umfpack = LuFactor::of(matrix, GeneralEngine::umfpack);
  const auto mumps = LuFactor::of(matrix, GeneralEngine::mumps);
  ASSERT_TRUE(umfpack && mumps);
  const Eigen::VectorXd one = umfpack->solve(right_side);
  const Eigen::VectorXd other = mumps->solve(right_side);
  EXPECT_LE((one - other).norm(), 1e-9 * one.norm());
}

} // namespace
} // namespace rubato::linalg::lu_factor_test
