// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/block_matrix.hpp"
#include "rubato/linalg/lanczos.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "support/dense.hpp"
#include "unit/linalg/elastic_block.hpp"
#include <random>
#include <stdexcept>

namespace rubato::linalg::block_matrix_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd random_vector(Eigen::Index size) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(-1, 1);
  return VectorXd::NullaryExpr(size, [&] { return value(random); });
}

/// Symmetric, a third of its blocks there, some of them only in part.
SparseMatrix scattered(int blocks, int size) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-1, 1);
  std::vector<Eigen::Triplet<double, int>> entries;
  for (int i = 0; i < blocks; ++i)
    for (int j = i; j < blocks; ++j)
      for (int k = 0; (i == j || value(random) > 0.3) && k < size * size; ++k) {
        const int row = i * size + k % size;
        const int column = j * size + k / size;
        if (row > column || value(random) > 0.8)
          continue;
        const double entry = value(random);
        entries.emplace_back(row, column, entry);
        if (row != column)
          entries.emplace_back(column, row, entry);
      }
  SparseMatrix matrix(blocks * size, blocks * size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

TEST(SymmetricBlockMatrix, MultipliesAsTheSparseMatrixItWasMadeOf) {
  for (const int size : {2, 3})
    for (const int blocks : {1, 2, 40}) {
      const auto matrix = scattered(blocks, size);
      const SymmetricBlockMatrix in_blocks(matrix, size);
      const auto x = random_vector(matrix.rows());
      VectorXd y = VectorXd::Constant(matrix.rows(), 5);
      in_blocks.multiply(x, y);
      EXPECT_LT((y - matrix * x).norm(), 1e-14 * x.norm() * blocks) << size << ", " << blocks;
      EXPECT_EQ(in_blocks.rows(), matrix.rows());
    }
}

TEST(SymmetricBlockMatrix, MultipliesTheSameWithAnyInstructionsOfTheProcessor) {
  for (const int size : {2, 3}) {
    const auto matrix = scattered(40, size);
    const SymmetricBlockMatrix in_blocks(matrix, size);
    const auto x = random_vector(matrix.rows());
    VectorXd plain(matrix.rows());
    VectorXd best(matrix.rows());
    in_blocks.multiply(x, plain, Instructions::plain);
    in_blocks.multiply(x, best);
    EXPECT_LT((best - plain).norm(), 1e-14 * plain.norm()) << size;
    EXPECT_GT(plain.norm(), 1) << size;
  }
}

TEST(SymmetricBlockMatrix, MultipliesAStiffness) {
  const auto matrix = test::elastic_block(4, 3, 5, false);
  const SymmetricBlockMatrix in_blocks(matrix, 3);
  const auto x = random_vector(matrix.rows());
  const VectorXd expected = matrix * x;
  VectorXd y(matrix.rows());
  in_blocks.multiply(x, y);
  EXPECT_LT((y - expected).norm(), 1e-14 * expected.norm());
}

TEST(SymmetricBlockMatrix, HoldsLittleMoreThanHalfOfTheNumbers) {
  const auto matrix = test::elastic_block(10, 10, 10, false);
  const SymmetricBlockMatrix in_blocks(matrix, 3);
  EXPECT_LT(static_cast<double>(in_blocks.bytes()), 0.6 * 8 * static_cast<double>(matrix.nonZeros()));
}

TEST(SymmetricBlockMatrix, RefusesBlocksThatDoNotFit) {
  EXPECT_THROW(SymmetricBlockMatrix(scattered(3, 2), 4), std::invalid_argument);
  EXPECT_THROW(SymmetricBlockMatrix(scattered(2, 2), 3), std::invalid_argument);
}

TEST(LargestEigenvalue, BoundsTheDenseOneWithinAPercent) {
  const auto matrix = test::elastic_block(3, 3, 4);
  const VectorXd diagonal = random_vector(matrix.rows()).cwiseAbs2();
  const VectorXd root = diagonal.cwiseSqrt();
  const MatrixXd scaled = root.asDiagonal() * MatrixXd(matrix) * root.asDiagonal();
  const double dense = test::symmetric_eigenvalues(scaled).maxCoeff();
  const double found = largest_eigenvalue(SymmetricBlockMatrix(matrix, 3), diagonal);
  EXPECT_GE(found, dense);
  EXPECT_LE(found, 1.0102 * dense);
}

TEST(LargestEigenvalue, IsFoundInAnyUnits) {
  for (int length = 1; length <= 6; ++length) {
    const auto matrix = test::elastic_block(length, 2, 1);
    const VectorXd diagonal = random_vector(matrix.rows()).array().abs() + 0.5;
    const MatrixXd scaled =
        diagonal.cwiseSqrt().asDiagonal() * MatrixXd(matrix) * diagonal.cwiseSqrt().asDiagonal();
    const double dense = test::symmetric_eigenvalues(scaled).maxCoeff();
    for (const double unit : {1e-14, 1e-7, 1.0, 1e7, 1e14}) {
      const double found = largest_eigenvalue(SymmetricBlockMatrix(unit * matrix, 3), diagonal);
      EXPECT_GE(found, unit * dense) << length << ' ' << unit;
      EXPECT_LE(found, 1.0102 * unit * dense) << length << ' ' << unit;
    }
  }
}

TEST(LargestEigenvalue, LeavesHeldUnknownsOut) {
  const auto matrix = test::elastic_block(2, 2, 2);
  VectorXd diagonal = VectorXd::Zero(matrix.rows());
  diagonal[4] = 0.5;
  const double found = largest_eigenvalue(SymmetricBlockMatrix(matrix, 3), diagonal);
  EXPECT_NEAR(found * 0.99, 0.5 * matrix.coeff(4, 4), 1e-10 * found);
  EXPECT_EQ(largest_eigenvalue(SymmetricBlockMatrix(matrix, 3), VectorXd::Zero(matrix.rows())), 0);
}

} // namespace
} // namespace rubato::linalg::block_matrix_test
