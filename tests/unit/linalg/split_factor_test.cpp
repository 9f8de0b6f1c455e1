// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/memory.hpp"
#include "rubato/linalg/split_factor.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "support/dense.hpp"
#include "unit/linalg/elastic_block.hpp"
#include "unit/linalg/random_vector.hpp"
#include <limits>
#include <stdexcept>

namespace rubato::linalg::split_factor_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::random_vector;

constexpr auto plenty = std::numeric_limits<std::size_t>::max();

/// Two elastic blocks of different size that don't touch, their unknowns interleaved one for one as far as
/// both go.
SparseMatrix two_bodies() {
  const auto a = test::elastic_block(5, 3, 3);
  const auto b = test::elastic_block(4, 2, 2);
  const auto place = [&](bool first, Eigen::Index i) {
    const auto both = std::min(a.rows(), b.rows());
    if (i < both)
      return static_cast<int>(2 * i + (first ? 0 : 1));
    return static_cast<int>(both + i);
  };
  std::vector<Eigen::Triplet<double, int>> entries;
  for (const bool first : {true, false}) {
    const auto& block = first ? a : b;
    for (int column = 0; column < block.outerSize(); ++column)
      for (SparseMatrix::InnerIterator entry(block, column); entry; ++entry)
        entries.emplace_back(place(first, entry.row()), place(first, column), entry.value());
  }
  SparseMatrix matrix(a.rows() + b.rows(), a.rows() + b.rows());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

std::vector<int> every(int step, Eigen::Index size) {
  std::vector<int> chosen;
  for (int i = 1; i < size; i += step)
    chosen.push_back(i);
  return chosen;
}

class SplitFactorWithSurface : public testing::TestWithParam<int> {
protected:
  SparseMatrix matrix = two_bodies();
  std::vector<int> surface = every(GetParam(), matrix.rows());
  std::optional<SplitFactor> factor = SplitFactor::of(matrix, surface, plenty);
};

TEST_P(SplitFactorWithSurface, SolvesAsAWholeFactorDoes) {
  ASSERT_TRUE(factor);
  const auto right_side = random_vector(matrix.rows(), 1);
  const VectorXd expected = CholeskyFactor::of(matrix)->solve(right_side);
  EXPECT_LE((factor->solve(right_side) - expected).norm(), 1e-11 * expected.norm());
}

TEST_P(SplitFactorWithSurface, KnowsTheSurfaceHalfWay) {
  ASSERT_TRUE(factor);
  const auto right_side = random_vector(matrix.rows(), 2);
  const VectorXd whole = factor->solve(right_side);
  const VectorXd on_surface = factor->surface_of(factor->forward(right_side));
  ASSERT_EQ(factor->surface().size(), surface.size());
  EXPECT_LE((on_surface - whole(factor->surface())).norm(), 1e-11 * whole.norm());
}

TEST_P(SplitFactorWithSurface, TakesForcesOnTheSurfaceHalfWay) {
  ASSERT_TRUE(factor);
  VectorXd right_side = random_vector(matrix.rows(), 3);
  const auto force = random_vector(static_cast<Eigen::Index>(surface.size()), 4);
  auto half_way = factor->forward(right_side);
  factor->load_surface(force, half_way);
  right_side(factor->surface()) += force;
  const VectorXd expected = factor->solve(right_side);
  EXPECT_LE((factor->backward(half_way) - expected).norm(), 1e-11 * expected.norm());
}

TEST_P(SplitFactorWithSurface, GivesTheComplianceOfEachBody) {
  ASSERT_TRUE(factor);
  const MatrixXd inverse = test::inverse(matrix);
  const auto& starts = factor->body_starts();
  ASSERT_EQ(starts.size(), 3U);
  for (std::size_t body = 0; body < 2; ++body) {
    const std::vector<int> unknowns(factor->surface().begin() + starts[body],
                                    factor->surface().begin() + starts[body + 1]);
    const MatrixXd expected = inverse(unknowns, unknowns);
    EXPECT_LE((factor->compliance(body) - expected).norm(), 1e-11 * expected.norm());
    const auto size = static_cast<Eigen::Index>(unknowns.size());
    for (const Eigen::Index first : {Eigen::Index(0), size / 3}) {
      const Eigen::Index count = size / 2;
      EXPECT_LE((factor->compliance(body, first, count) - expected.middleCols(first, count)).norm(),
                1e-11 * expected.norm());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryFew, SplitFactorWithSurface, testing::Values(1, 2, 7, 50));

TEST(SplitFactor, TakesABodyWithoutSurface) {
  const auto matrix = two_bodies();
  const auto factor = SplitFactor::of(matrix, {}, plenty);
  ASSERT_TRUE(factor);
  EXPECT_EQ(factor->surface_of(factor->forward(VectorXd::Ones(matrix.rows()))).size(), 0);
}

TEST(SplitFactor, RefusesAFloatingBody) {
  const std::vector<int> surface{0, 1, 2};
  EXPECT_FALSE(SplitFactor::of(test::elastic_block(4, 3, 3, false), surface, plenty));
}

TEST(SplitFactor, RefusesWhatDoesNotFitBeforeItFactors) {
  const auto matrix = test::elastic_block(8, 8, 8);
  const auto needed = SplitFactor::of(matrix, {}, plenty)->factor_bytes();
  EXPECT_TRUE(SplitFactor::of(matrix, {}, needed));
  try {
    SplitFactor::of(matrix, {}, needed - 1);
    FAIL() << "a factor larger than the memory was computed";
  } catch (const TooLargeForMemory& error) {
    EXPECT_EQ(error.needed, needed);
    EXPECT_EQ(error.available, needed - 1);
  }
}

TEST(SplitFactor, TellsWhatItNeedsWithTheComplianceOfTheSurface) {
  const auto matrix = test::elastic_block(6, 6, 6);
  const std::vector<int> surface{0, 1, 2, 3, 4};
  std::vector<std::size_t> told;
  const auto factor =
      SplitFactor::of(matrix, surface, plenty, [&](std::size_t bytes) { told.push_back(bytes); });
  ASSERT_TRUE(factor);
  EXPECT_EQ(told, (std::vector{factor->factor_bytes() + 25 * sizeof(double)}));
}

TEST(SplitFactor, SaysNothingOfAFactorThatDoesNotFit) {
  bool told = false;
  EXPECT_THROW(SplitFactor::of(test::elastic_block(4, 4, 4), {}, 1, [&](std::size_t) { told = true; }),
               TooLargeForMemory);
  EXPECT_FALSE(told);
}

TEST(SplitFactor, RefusesSizesThatDoNotMatch) {
  EXPECT_THROW(SplitFactor::of(SparseMatrix(2, 3), {}, plenty), std::invalid_argument);
  const auto factor = SplitFactor::of(two_bodies(), {}, plenty);
  EXPECT_THROW(factor->forward(VectorXd::Ones(3)), std::invalid_argument);
}

} // namespace
} // namespace rubato::linalg::split_factor_test
