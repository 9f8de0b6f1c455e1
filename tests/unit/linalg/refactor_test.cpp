// SPDX-License-Identifier: LGPL-3.0-or-later
// A kept analysis takes the values of one matrix after another. What comes out must not tell which were there
// before: a resumed run starts with the last.
#include "rubato/linalg/split_factor.hpp"
#include "rubato/linalg/surface_in_factor.hpp"

#include <gtest/gtest.h>

#include "unit/linalg/elastic_block.hpp"
#include "unit/linalg/random_vector.hpp"
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace rubato::linalg::refactor_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::random_vector;

constexpr auto plenty = std::numeric_limits<std::size_t>::max();
constexpr auto never = [](std::size_t) {};
constexpr auto always_last = std::numeric_limits<Index>::max();

/// Matrices side by side, coupled by nothing.
SparseMatrix side_by_side(const std::vector<SparseMatrix>& parts) {
  std::vector<Eigen::Triplet<double, int>> entries;
  int size = 0;
  for (const auto& part : parts) {
    for (int column = 0; column < part.outerSize(); ++column)
      for (SparseMatrix::InnerIterator entry(part, column); entry; ++entry)
        entries.emplace_back(size + static_cast<int>(entry.row()), size + column, entry.value());
    size += static_cast<int>(part.rows());
  }
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Springs in a row, on a floor: CHOLMOD makes no supernodes of them.
SparseMatrix chain(int size, double spring) {
  std::vector<Eigen::Triplet<double, int>> entries;
  for (int i = 0; i < size; ++i) {
    entries.emplace_back(i, i, 2 * spring + 0.5);
    if (i > 0) {
      entries.emplace_back(i, i - 1, -spring);
      entries.emplace_back(i - 1, i, -spring);
    }
  }
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// D A D with D of random numbers near one: symmetric, positive definite where A is, no value kept.
SparseMatrix varied(const SparseMatrix& matrix, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> near_one(0.8, 1.2);
  const VectorXd scales = VectorXd::NullaryExpr(matrix.rows(), [&] { return near_one(random); });
  return scales.asDiagonal() * matrix * scales.asDiagonal();
}

/// A − 2 a_ii e_i e_iᵀ for the last unknown.
SparseMatrix indefinite(SparseMatrix matrix) {
  const auto last = static_cast<int>(matrix.rows()) - 1;
  matrix.coeffRef(last, last) *= -1;
  return matrix;
}

std::vector<int> every(int step, const SparseMatrix& matrix) {
  std::vector<int> chosen;
  for (int i = 1; i < matrix.rows(); i += step)
    chosen.push_back(i);
  return chosen;
}

struct Case {
  std::string name;
  SparseMatrix matrix;
  int surface_step; ///< every so many unknowns are surface; 0: none
  Index largest_last;

  std::vector<int> surface() const {
    return surface_step == 0 ? std::vector<int>() : every(surface_step, matrix);
  }
  std::optional<SplitFactor> factor_of(const SparseMatrix& values) const {
    return SplitFactor::of(values, surface(), plenty, never, {.last = largest_last});
  }
  SplitFactor analysed(const SparseMatrix& values) const {
    return SplitFactor::analysed(values, surface(), plenty, never, {.last = largest_last});
  }
};

std::vector<Case> cases() {
  const auto blocks = side_by_side({test::elastic_block(7, 4, 4), test::elastic_block(4, 2, 2)});
  const auto strips = side_by_side({test::elastic_block(12, 3, 1), test::elastic_block(5, 4, 3)});
  const auto chains = side_by_side({chain(300, 1), chain(40, 3), chain(1, 2)});
  return {{"SurfaceLast", blocks, 7, always_last}, {"AllOnTheSurface", blocks, 1, always_last},
          {"SurfaceWithin", strips, 2, 0},         {"NoSurface", blocks, 0, always_last},
          {"Chains", chains, 9, always_last},      {"ChainsWithin", chains, 2, 0}};
}

/// All that can be asked of one factor is bit for bit what the other one says.
void expect_same(const SplitFactor& factor, const SplitFactor& fresh, Index size) {
  ASSERT_EQ(factor.surface(), fresh.surface());
  ASSERT_EQ(factor.body_starts(), fresh.body_starts());
  const auto right_side = random_vector(size, 11);
  EXPECT_EQ(factor.solve(right_side), fresh.solve(right_side));
  VectorXd half_way = factor.forward(right_side);
  VectorXd fresh_half_way = fresh.forward(right_side);
  EXPECT_EQ(factor.surface_of(half_way), fresh.surface_of(fresh_half_way));
  const auto force = random_vector(static_cast<Index>(factor.surface().size()), 12);
  factor.load_surface(force, half_way);
  fresh.load_surface(force, fresh_half_way);
  EXPECT_EQ(half_way, fresh_half_way);
  for (std::size_t body = 0; body + 1 < factor.body_starts().size(); ++body) {
    const auto* within = factor.surface_within(body);
    const auto* fresh_within = fresh.surface_within(body);
    ASSERT_EQ(within == nullptr, fresh_within == nullptr);
    if (within == nullptr)
      EXPECT_EQ(factor.compliance(body), fresh.compliance(body));
    else
      for (std::size_t block = 0; block + 1 < within->block_starts().size(); ++block)
        EXPECT_EQ(within->half_way_of(block), fresh_within->half_way_of(block));
  }
}

class Refactor : public testing::TestWithParam<Case> {
protected:
  const SparseMatrix& matrix() const { return GetParam().matrix; }
  void expect_as_fresh(const SplitFactor& factor, const SparseMatrix& values) const {
    const auto fresh = GetParam().factor_of(values);
    ASSERT_TRUE(fresh);
    expect_same(factor, *fresh, values.rows());
  }
};

INSTANTIATE_TEST_SUITE_P(Factors, Refactor, testing::ValuesIn(cases()),
                         [](const auto& chosen) { return chosen.param.name; });

TEST_P(Refactor, GivesTheBitsOfAFactorMadeFromNothing) {
  auto factor = GetParam().factor_of(matrix());
  ASSERT_TRUE(factor);
  for (const unsigned seed : {1U, 2U, 3U}) {
    const auto other = varied(matrix(), seed);
    ASSERT_TRUE(factor->refactor(other));
    expect_as_fresh(*factor, other);
  }
  ASSERT_TRUE(factor->refactor(matrix()));
  expect_as_fresh(*factor, matrix());
}

TEST_P(Refactor, TakesAMatrixAfterOnesThatCannotBeFactored) {
  auto factor = GetParam().factor_of(matrix());
  ASSERT_TRUE(factor);
  auto not_finite = matrix();
  not_finite.coeffRef(1, 1) = std::numeric_limits<double>::quiet_NaN();
  for (const auto& bad : {indefinite(matrix()), not_finite, SparseMatrix(-1.0 * matrix())}) {
    EXPECT_FALSE(factor->refactor(bad));
    EXPECT_FALSE(factor->has_values());
    EXPECT_THROW(factor->solve(VectorXd::Ones(matrix().rows())), std::logic_error);
    ASSERT_TRUE(factor->refactor(matrix()));
    EXPECT_TRUE(factor->has_values());
    expect_as_fresh(*factor, matrix());
  }
}

TEST_P(Refactor, StartsWithAnAnalysisOfWhateverValues) {
  auto not_finite = matrix();
  not_finite.coeffRef(1, 1) = std::numeric_limits<double>::infinity();
  for (const auto& analysed : {matrix(), indefinite(matrix()), not_finite, SparseMatrix(0.0 * matrix())}) {
    auto factor = GetParam().analysed(analysed);
    EXPECT_FALSE(factor.has_values());
    EXPECT_THROW(factor.forward(VectorXd::Ones(matrix().rows())), std::logic_error);
    const auto other = varied(matrix(), 4);
    ASSERT_TRUE(factor.refactor(other));
    expect_as_fresh(factor, other);
  }
}

TEST_P(Refactor, KeepsTheSizeAndTheMemoryOfTheFactor) {
  auto factor = GetParam().factor_of(matrix());
  ASSERT_TRUE(factor);
  const auto bytes = factor->factor_bytes();
  const auto nonzeros = factor->factor_nonzeros();
  const auto flops = factor->factor_flops();
  ASSERT_TRUE(factor->refactor(varied(matrix(), 5)));
  EXPECT_EQ(factor->factor_bytes(), bytes);
  EXPECT_EQ(factor->factor_nonzeros(), nonzeros);
  EXPECT_EQ(factor->factor_flops(), flops);
}

TEST_P(Refactor, MovesWithTheFactor) {
  auto factor = GetParam().analysed(matrix());
  SplitFactor moved = std::move(factor);
  const auto other = varied(matrix(), 6);
  ASSERT_TRUE(moved.refactor(other));
  SplitFactor again = std::move(moved);
  expect_as_fresh(again, other);
}

TEST(RefactorOfBodies, RenewsThoseWhoseValuesAreOthers) {
  const auto soft = test::elastic_block(4, 3, 3);
  const auto stiff = test::elastic_block(3, 2, 2);
  const auto both = side_by_side({soft, stiff});
  auto factor = SplitFactor::of(both, every(5, both), plenty);
  ASSERT_TRUE(factor);
  const auto first = factor->renewals(0);
  const auto second = factor->renewals(1);
  const auto other = side_by_side({soft, varied(stiff, 7)});
  ASSERT_TRUE(factor->refactor(other));
  EXPECT_EQ(factor->renewals(0), first);
  EXPECT_EQ(factor->renewals(1), second + 1);
  expect_same(*factor, *SplitFactor::of(other, every(5, both), plenty), both.rows());
  EXPECT_FALSE(factor->refactor(side_by_side({soft, indefinite(stiff)})));
  EXPECT_EQ(factor->renewals(0), first);
  EXPECT_EQ(factor->renewals(1), second + 2) << "values that are lost";
  ASSERT_TRUE(factor->refactor(other));
  EXPECT_EQ(factor->renewals(0), first);
  EXPECT_EQ(factor->renewals(1), second + 3);
  expect_same(*factor, *SplitFactor::of(other, every(5, both), plenty), both.rows());
}

TEST(RefactorOfBodies, RefusesAnotherPattern) {
  const auto matrix = test::elastic_block(4, 3, 3);
  auto factor = SplitFactor::of(matrix, {}, plenty);
  ASSERT_TRUE(factor);
  auto with_another = matrix;
  const auto last = static_cast<int>(matrix.rows()) - 1;
  with_another.coeffRef(last, 0) = with_another.coeffRef(0, last) = 0.0;
  const SparseMatrix without_zeros = matrix.pruned(1.0, 1e-12);
  ASSERT_LT(without_zeros.nonZeros(), matrix.nonZeros());
  EXPECT_THROW(factor->refactor(with_another), std::invalid_argument);
  EXPECT_THROW(factor->refactor(without_zeros), std::invalid_argument);
  EXPECT_THROW(factor->refactor(test::elastic_block(3, 3, 3)), std::invalid_argument);
  EXPECT_TRUE(factor->has_values()) << "of the matrix before";
  EXPECT_THROW(SplitFactor::analysed(SparseMatrix(2, 3), {}, plenty), std::invalid_argument);
}

TEST(RefactorOfBodies, AsksForMemoryOnceByTheAnalysis) {
  const auto matrix = test::elastic_block(4, 3, 3);
  int told = 0;
  auto factor = SplitFactor::analysed(matrix, {}, plenty, [&](std::size_t) { ++told; });
  ASSERT_TRUE(factor.refactor(matrix));
  ASSERT_TRUE(factor.refactor(varied(matrix, 8)));
  EXPECT_EQ(told, 1);
}

TEST(CostOfAFactor, CountsTheEntriesOfItsColumns) {
  const auto chains = side_by_side({chain(300, 1), chain(40, 3)});
  const auto factor = SplitFactor::analysed(chains, every(1, chains), plenty); // in the order they stand in
  EXPECT_EQ(factor.factor_nonzeros(), 2U * 340 - 2) << "nothing is filled in";
  EXPECT_EQ(factor.factor_flops(), 4.0 * 338 + 2);
}

/// Entries of every column of L, by elimination in the order of the unknowns.
std::vector<double> column_counts(const SparseMatrix& matrix) {
  const Index size = matrix.rows();
  Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> filled;
  filled.setConstant(size, size, false);
  for (int column = 0; column < matrix.cols(); ++column)
    for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry)
      filled(entry.row(), column) = true;
  std::vector<double> counts;
  for (Index k = 0; k < size; ++k) {
    counts.push_back(static_cast<double>(filled.col(k).tail(size - k).count()));
    for (Index j = k + 1; j < size; ++j)
      if (filled(j, k))
        for (Index i = j; i < size; ++i)
          filled(i, j) = filled(i, j) || filled(i, k);
  }
  return counts;
}

TEST(CostOfAFactor, IsThatOfItsOrderOfElimination) {
  const auto matrix = test::elastic_block(4, 2, 2);
  const auto factor = SplitFactor::of(matrix, every(1, matrix), plenty); // in the order they stand in
  ASSERT_TRUE(factor);
  double entries = 0;
  double flops = 0;
  for (const double count : column_counts(matrix)) {
    entries += count;
    flops += count * count;
  }
  EXPECT_EQ(static_cast<double>(factor->factor_nonzeros()), entries);
  EXPECT_EQ(factor->factor_flops(), flops);
}

} // namespace
} // namespace rubato::linalg::refactor_test
