// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/constrained_inverse.hpp"
#include "rubato/linalg/dense_decompositions.hpp"
#include "rubato/linalg/eigen_modes.hpp"

#include <gtest/gtest.h>

#include "elastic_block.hpp"
#include <random>
#include <stdexcept>

namespace rubato::linalg::eigen_modes_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

SparseMatrix diagonal(const VectorXd& values) {
  SparseMatrix matrix(values.size(), values.size());
  for (int i = 0; i < values.size(); ++i)
    matrix.insert(i, i) = values[i];
  matrix.makeCompressed();
  return matrix;
}

SparseMatrix no_constraints(const SparseMatrix& matrix) {
  return SparseMatrix(matrix.rows(), 0);
}

/// Masses between 1 and 2, and some that couple.
SparseMatrix random_mass(Index size, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(1, 2);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < size; ++i)
    entries.emplace_back(i, i, uniform(generator));
  for (int i = 0; i + 1 < size; ++i)
    for (const auto& [row, column] : {std::pair{i, i + 1}, std::pair{i + 1, i}})
      entries.emplace_back(row, column, 0.3);
  SparseMatrix mass(size, size);
  mass.setFromTriplets(entries.begin(), entries.end());
  return mass;
}

/// Ties the last nodes to those `stride` before them, each component; every relation twice.
SparseMatrix ties(Index size, int count, int stride) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < 2 * count; ++i) {
    const int dof = static_cast<int>(size) - 1 - i % count;
    entries.emplace_back(dof, i, 1);
    entries.emplace_back(dof - stride, i, -1);
  }
  SparseMatrix relations(size, 2 * count);
  relations.setFromTriplets(entries.begin(), entries.end());
  return relations;
}

void expect_modes(const EigenModes& modes, const SparseMatrix& stiffness, const SparseMatrix& mass) {
  EXPECT_TRUE(modes.converged);
  EXPECT_LE(modes.residuals.maxCoeff(), 1e-9);
  const MatrixXd moved = mass * modes.vectors;
  const auto count = modes.values.size();
  EXPECT_LE((modes.vectors.transpose() * moved - MatrixXd::Identity(count, count)).cwiseAbs().maxCoeff(),
            1e-9);
  const MatrixXd left = stiffness * modes.vectors - moved * modes.values.asDiagonal();
  EXPECT_LE(left.norm(), 1e-8 * modes.values.maxCoeff() * moved.norm());
}

class EigenModesOfSize : public testing::TestWithParam<int> {};

TEST_P(EigenModesOfSize, FindEveryCopyOfAMultipleValue) {
  constexpr int copies = 5;
  VectorXd values(GetParam());
  for (Index i = 0; i < values.size(); ++i)
    values[values.size() - 1 - i] = static_cast<double>(1 + i / copies);
  const auto stiffness = diagonal(values);
  const auto mass = diagonal(VectorXd::Ones(values.size()));
  const auto modes = smallest_modes(stiffness, mass, no_constraints(mass), 23);
  ASSERT_TRUE(modes);
  ASSERT_EQ(modes->values.size(), 23);
  for (Index i = 0; i < 23; ++i)
    EXPECT_NEAR(modes->values[i], 1 + i / copies, 1e-12 * modes->values[i]) << i;
  expect_modes(*modes, stiffness, mass);
}

TEST_P(EigenModesOfSize, AreThoseOfADenseSolution) {
  const auto size = GetParam() / 36;
  const auto stiffness = test::elastic_block(size, 2, 3, true, 1);
  const auto mass = random_mass(stiffness.rows(), 3);
  const auto dense = generalized_eigen(MatrixXd(stiffness), MatrixXd(mass));
  const auto modes = smallest_modes(stiffness, mass, no_constraints(mass), 12);
  ASSERT_TRUE(modes);
  EXPECT_LE(
      (modes->values - dense.values.head(12)).cwiseQuotient(dense.values.head(12)).cwiseAbs().maxCoeff(),
      1e-9);
  EXPECT_EQ(modes->shift, 0);
  expect_modes(*modes, stiffness, mass);
}

TEST_P(EigenModesOfSize, AreExactlyZeroWhereNothingHolds) {
  const auto stiffness = test::elastic_block(GetParam() / 36, 2, 3, false);
  const auto mass = random_mass(stiffness.rows(), 4);
  for (const auto support : {Support::unknown, Support::none}) {
    const auto modes = smallest_modes(stiffness, mass, no_constraints(mass), 9, support);
    ASSERT_TRUE(modes);
    EXPECT_LT(modes->shift, 0);
    EXPECT_EQ((modes->values.array() == 0).count(), 6);
    EXPECT_GT(modes->values[6], 0);
    expect_modes(*modes, stiffness, mass);
  }
}

TEST_P(EigenModesOfSize, KeepConstraintsOfWhichSomeDependOnOthers) {
  const auto stiffness = test::elastic_block(GetParam() / 36, 2, 3, true, 1);
  const auto size = stiffness.rows();
  const auto mass = random_mass(size, 5);
  constexpr int count = 18;
  const auto relations = ties(size, count, 36);
  const auto modes = smallest_modes(stiffness, mass, relations, 8);
  ASSERT_TRUE(modes);
  EXPECT_TRUE(modes->converged);
  EXPECT_LE((relations.transpose() * modes->vectors).cwiseAbs().maxCoeff(), 1e-9);
  const MatrixXd basis = orthogonal_factor(MatrixXd(relations.leftCols(count))).rightCols(size - count);
  const auto dense =
      generalized_eigen(basis.transpose() * (stiffness * basis), basis.transpose() * (mass * basis));
  EXPECT_LE((modes->values - dense.values.head(8)).cwiseQuotient(dense.values.head(8)).cwiseAbs().maxCoeff(),
            1e-9);
}

INSTANTIATE_TEST_SUITE_P(DenseAndSparse, EigenModesOfSize, testing::Values(240, 720));

TEST(EigenModes, AreAllThereAreWhenMoreAreWanted) {
  const auto stiffness = test::elastic_block(2, 1, 1, true, 1);
  const auto mass = random_mass(stiffness.rows(), 6);
  const auto modes = smallest_modes(stiffness, mass, no_constraints(mass), 1000);
  ASSERT_TRUE(modes);
  EXPECT_EQ(modes->values.size(), stiffness.rows());
  expect_modes(*modes, stiffness, mass);
}

TEST(EigenModes, LeaveOutWhatHasNoMass) {
  const auto stiffness = diagonal(VectorXd::LinSpaced(6, 1, 6));
  VectorXd masses = VectorXd::Ones(6);
  masses[1] = 0;
  const auto mass = diagonal(masses);
  const auto modes = smallest_modes(stiffness, mass, no_constraints(mass), 6);
  ASSERT_TRUE(modes);
  ASSERT_EQ(modes->values.size(), 5);
  EXPECT_NEAR(modes->values[1], 3, 1e-12);
}

TEST(EigenModes, AreTheSameEachTime) {
  const auto stiffness = test::elastic_block(20, 2, 3, false);
  const auto mass = random_mass(stiffness.rows(), 7);
  const auto once = smallest_modes(stiffness, mass, no_constraints(mass), 7);
  const auto again = smallest_modes(stiffness, mass, no_constraints(mass), 7);
  ASSERT_TRUE(once && again);
  EXPECT_EQ(once->vectors, again->vectors);
}

TEST(EigenModes, AreNothingWhereSomethingMovesWithoutMassAndResistance) {
  VectorXd values = VectorXd::Ones(4);
  values[2] = 0;
  const auto matrix = diagonal(values);
  EXPECT_FALSE(smallest_modes(matrix, matrix, no_constraints(matrix), 1));
  values[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(smallest_modes(diagonal(values), matrix, no_constraints(matrix), 1));
}

TEST(EigenModes, WantMatricesThatFitEachOther) {
  const auto matrix = diagonal(VectorXd::Ones(4));
  const auto other = diagonal(VectorXd::Ones(5));
  EXPECT_THROW(smallest_modes(matrix, other, no_constraints(matrix), 1), std::invalid_argument);
  EXPECT_THROW(smallest_modes(matrix, matrix, no_constraints(matrix), 0), std::invalid_argument);
  EXPECT_THROW(smallest_modes(matrix, matrix, SparseMatrix(5, 2), 1), std::invalid_argument);
}

TEST(ConstrainedInverse, SolvesASystemWithItsConstraints) {
  const auto matrix = test::elastic_block(3, 2, 2, true, 1);
  const auto relations = ties(matrix.rows(), 9, 27);
  const auto inverse = ConstrainedInverse::of(matrix, relations);
  ASSERT_TRUE(inverse);
  EXPECT_EQ(inverse->constraints().cols(), 9) << "each relation is there twice";
  const VectorXd force = VectorXd::LinSpaced(matrix.rows(), -1, 2);
  const VectorXd x = inverse->solve(force);
  EXPECT_LE((relations.transpose() * x).cwiseAbs().maxCoeff(), 1e-12 * x.norm());
  EXPECT_LE(inverse->without_reactions(force - matrix * x).norm(), 1e-11 * force.norm());
}

} // namespace
} // namespace rubato::linalg::eigen_modes_test
