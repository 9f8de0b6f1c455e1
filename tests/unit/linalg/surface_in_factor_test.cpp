// SPDX-License-Identifier: LGPL-3.0-or-later
// A strip and a block that do not touch; surfaces are eliminated within them.
#include "rubato/linalg/split_factor.hpp"
#include "rubato/linalg/surface_in_factor.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "support/dense.hpp"
#include "unit/linalg/elastic_block.hpp"
#include "unit/linalg/random_vector.hpp"
#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

namespace rubato::linalg::surface_in_factor_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::random_vector;

constexpr auto plenty = std::numeric_limits<std::size_t>::max();
constexpr auto never = [](std::size_t) {};

/// On springs at all nodes, a hundredth as stiff as the cells: a long strip alone is badly conditioned.
SparseMatrix strip_and_block() {
  std::vector<Eigen::Triplet<double, int>> entries;
  int size = 0;
  for (const auto& part : {test::elastic_block(30, 3, 1), test::elastic_block(5, 4, 3)}) {
    for (int column = 0; column < part.outerSize(); ++column)
      for (SparseMatrix::InnerIterator entry(part, column); entry; ++entry)
        entries.emplace_back(size + static_cast<int>(entry.row()), size + column, entry.value());
    size += static_cast<int>(part.rows());
  }
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const double springs = 0.01 * matrix.diagonal().maxCoeff();
  for (int i = 0; i < size; ++i)
    matrix.coeffRef(i, i) += springs;
  return matrix;
}

/// All unknowns of the upper nodes, or of all nodes.
std::vector<int> surface_of(const SparseMatrix& matrix, bool whole) {
  std::vector<int> unknowns;
  for (int i = 0; i < matrix.rows(); ++i)
    if (whole || i / 3 % 2 == 1)
      unknowns.push_back(i);
  return unknowns;
}

class SurfaceWithinABody : public testing::TestWithParam<bool> {
protected:
  VectorXd whole_solution(const VectorXd& right_side) const {
    return CholeskyFactor::of(matrix_)->solve(right_side);
  }

  SparseMatrix matrix_ = strip_and_block();
  std::vector<int> chosen_ = surface_of(matrix_, GetParam());
  std::optional<SplitFactor> factor_ = SplitFactor::of(matrix_, chosen_, plenty, never, {.last = 0});
};

TEST_P(SurfaceWithinABody, HoldsTheUnknownsAskedFor) {
  ASSERT_TRUE(factor_);
  ASSERT_TRUE(factor_->surface_within(0));
  EXPECT_EQ(factor_->surface_within(0)->size(), factor_->body_starts()[1]);
  auto unknowns = factor_->surface();
  std::ranges::sort(unknowns);
  EXPECT_EQ(unknowns, chosen_);
}

TEST_P(SurfaceWithinABody, IsKnownHalfWay) {
  ASSERT_TRUE(factor_);
  const auto right_side = random_vector(matrix_.rows(), 1);
  const VectorXd whole = whole_solution(right_side);
  EXPECT_LE((factor_->solve(right_side) - whole).norm(), 1e-11 * whole.norm());
  const VectorXd on_surface = factor_->surface_of(factor_->forward(right_side));
  EXPECT_LE((on_surface - whole(factor_->surface())).norm(), 1e-11 * whole.norm());
}

TEST_P(SurfaceWithinABody, TakesForcesHalfWay) {
  ASSERT_TRUE(factor_);
  VectorXd right_side = random_vector(matrix_.rows(), 2);
  VectorXd force = random_vector(static_cast<Index>(chosen_.size()), 3);
  force.head(force.size() / 3).setZero();
  auto half_way = factor_->forward(right_side);
  factor_->load_surface(force, half_way);
  right_side(factor_->surface()) += force;
  const VectorXd expected = whole_solution(right_side);
  EXPECT_LE((factor_->backward(half_way) - expected).norm(), 1e-11 * expected.norm());
}

TEST_P(SurfaceWithinABody, MovesByItsComplianceTimesForces) {
  ASSERT_TRUE(factor_);
  const auto& surface = *factor_->surface_within(0);
  VectorXd force = VectorXd::Zero(static_cast<Index>(chosen_.size()));
  force.head(surface.size()) = random_vector(surface.size(), 4);
  VectorXd right_side = VectorXd::Zero(matrix_.rows());
  right_side(factor_->surface()) = force;
  const VectorXd expected = whole_solution(right_side)(factor_->surface());
  EXPECT_LE((surface.moved_by(force.head(surface.size())) - expected.head(surface.size())).norm(),
            1e-11 * expected.norm());
}

TEST_P(SurfaceWithinABody, HasTheComplianceOfWholeSolvesBlockByBlock) {
  ASSERT_TRUE(factor_);
  const MatrixXd inverse = test::inverse(matrix_);
  const auto& surface = *factor_->surface_within(0);
  const auto& starts = surface.block_starts();
  const std::vector<int> unknowns(factor_->surface().begin(), factor_->surface().begin() + surface.size());
  const MatrixXd expected = inverse(unknowns, unknowns);
  ASSERT_GT(starts.size(), 3U);
  EXPECT_EQ(starts.back(), surface.size());
  std::vector<MatrixXd> half_way;
  for (std::size_t b = 0; b + 1 < starts.size(); ++b) {
    EXPECT_LE(starts[b + 1] - starts[b], SurfaceInFactor::largest_block);
    half_way.push_back(surface.half_way_of(b));
  }
  for (std::size_t i = 0; i < half_way.size(); ++i)
    for (std::size_t j = 0; j < half_way.size(); ++j) {
      const MatrixXd difference =
          surface.compliance(i, half_way[i], j, half_way[j]) -
          expected.block(starts[i], starts[j], starts[i + 1] - starts[i], starts[j + 1] - starts[j]);
      EXPECT_LE(difference.norm(), 1e-11 * expected.norm()) << "of blocks " << i << " and " << j;
    }
}

TEST_P(SurfaceWithinABody, HasTheComplianceOfWholeSolvesInOne) {
  ASSERT_TRUE(factor_);
  const MatrixXd inverse = test::inverse(matrix_);
  for (std::size_t body = 0; body < 2; ++body) {
    const auto* surface = factor_->surface_within(body);
    if (!surface)
      continue;
    const auto first = factor_->surface().begin() + factor_->body_starts()[body];
    const std::vector<int> unknowns(first, first + surface->size());
    const MatrixXd expected = inverse(unknowns, unknowns);
    const MatrixXd found = surface->whole();
    EXPECT_EQ(found, found.transpose());
    EXPECT_LE((found - expected).norm(), 1e-11 * expected.norm());
    EXPECT_EQ(factor_->compliance(body), found);
  }
}

TEST_P(SurfaceWithinABody, TakesForcesTogether) {
  ASSERT_TRUE(factor_);
  const auto& surface = *factor_->surface_within(0);
  const auto size = static_cast<Index>(factor_->surface().size());
  std::vector<Eigen::Triplet<double, int>> entries;
  std::mt19937 random(5);
  std::uniform_int_distribution<int> position(0, static_cast<int>(size) - 1); // of both bodies
  std::uniform_real_distribution<double> value(-1, 1);
  for (int column = 0; column < 90; ++column)
    for (int i = 0; i < 8; ++i)
      entries.emplace_back(position(random), column, value(random));
  SparseMatrix forces(size, 90);
  forces.setFromTriplets(entries.begin(), entries.end());
  const Index last = surface.size();
  const std::vector<int> unknowns(factor_->surface().begin(), factor_->surface().begin() + last);
  const MatrixXd of_body = MatrixXd(forces).topRows(last);
  const MatrixXd expected = of_body.transpose() * test::inverse(matrix_)(unknowns, unknowns) * of_body;
  const MatrixXd found = surface.between(forces, 0);
  EXPECT_EQ(found, found.transpose());
  EXPECT_LE((found - expected).norm(), 1e-11 * expected.norm());
}

/// [bytes] of the compliance of a body of a factor.
std::size_t bytes_of_compliance(const SplitFactor& factor, std::size_t body) {
  const auto* surface = factor.surface_within(body);
  std::size_t numbers = 0;
  if (!surface || surface->is_formed_whole())
    numbers = static_cast<std::size_t>(factor.compliance(body).size());
  else
    for (std::size_t b = 0; b + 1 < surface->block_starts().size(); ++b) {
      const auto count = surface->block_starts()[b + 1] - surface->block_starts()[b];
      numbers += static_cast<std::size_t>(surface->half_way_of(b).size());
      numbers += static_cast<std::size_t>(count * surface->block_starts()[b + 1]);
    }
  return numbers * sizeof(double);
}

TEST_P(SurfaceWithinABody, TellsWhatItsComplianceNeeds) {
  for (const Index whole_within : {0, 720}) {
    std::size_t told = 0;
    const auto tell = [&](std::size_t bytes) { told = bytes; };
    const auto factor =
        SplitFactor::of(matrix_, chosen_, plenty, tell, {.last = 0, .whole_within = whole_within});
    ASSERT_TRUE(factor);
    EXPECT_EQ(told,
              factor->factor_bytes() + bytes_of_compliance(*factor, 0) + bytes_of_compliance(*factor, 1));
  }
}

INSTANTIATE_TEST_SUITE_P(OfUpperNodesAndOfAll, SurfaceWithinABody, testing::Bool());

TEST(SplitFactor, EliminatesTheSurfaceLastUnlessItIsLargerThanAllowed) {
  const auto matrix = strip_and_block();
  const auto surface = surface_of(matrix, true);
  EXPECT_FALSE(SplitFactor::of(matrix, surface, plenty)->surface_within(0));
  const auto factor = SplitFactor::of(matrix, surface, plenty, never, {.last = 500});
  EXPECT_TRUE(factor->surface_within(0)) << "720 unknowns";
  EXPECT_FALSE(factor->surface_within(1)) << "300 unknowns";
}

// A block of five layers, its upper surface more than the bandwidth of the block: its dense factor has fewer
// entries than the whole, and takes more multiplications.
TEST(SplitFactor, EliminatesTheSurfaceWithinWhereThatTakesFewerMultiplications) {
  const auto block = test::elastic_block(60, 4, 4);
  std::vector<int> surface;
  for (int i = 0; i < block.rows(); ++i)
    if (i / 3 / 61 % 5 == 4)
      surface.push_back(i);
  const auto factor = SplitFactor::of(block, surface, plenty, never, {.last = 100});
  ASSERT_TRUE(factor);
  const auto size = static_cast<double>(surface.size());
  EXPECT_GT(static_cast<double>(factor->factor_nonzeros()), size * (size + 1) / 2);
  EXPECT_LT(factor->factor_flops(), std::pow(size, 3) / 3);
  EXPECT_TRUE(factor->surface_within(0));
}

TEST(SplitFactor, MovesTheSurfaceByForcesWhereverItIsEliminated) {
  const auto matrix = strip_and_block();
  const auto surface = surface_of(matrix, false);
  for (const Index largest_last : {Index{0}, std::numeric_limits<Index>::max()}) {
    const auto factor = SplitFactor::of(matrix, surface, plenty, never, {.last = largest_last});
    ASSERT_TRUE(factor);
    for (std::size_t body = 0; body < 2; ++body) {
      const int first = factor->body_starts()[body];
      const int count = factor->body_starts()[body + 1] - first;
      const VectorXd force = random_vector(count, 5);
      VectorXd of_all = VectorXd::Zero(matrix.rows());
      for (int i = 0; i < count; ++i)
        of_all[factor->surface()[static_cast<std::size_t>(first + i)]] = force[i];
      const VectorXd moved = factor->solve(of_all);
      const VectorXd found = factor->moved_by(body, force);
      for (int i = 0; i < count; ++i)
        EXPECT_NEAR(found[i], moved[factor->surface()[static_cast<std::size_t>(first + i)]],
                    1e-11 * moved.lpNorm<Eigen::Infinity>());
    }
  }
}

// All of a strip are many more unknowns than its factor has entries in a column; half of a block are not.
TEST(SplitFactor, FormsAComplianceWholeWhereThatIsSoonerReadThanTheFactor) {
  const auto matrix = strip_and_block();
  const auto is_whole = [&](bool all, Index whole_within, std::size_t body) {
    const auto factor = SplitFactor::of(matrix, surface_of(matrix, all), plenty, never,
                                        {.last = 0, .whole_within = whole_within});
    return factor->surface_within(body)->is_formed_whole();
  };
  EXPECT_FALSE(is_whole(true, 720, 0));
  EXPECT_TRUE(is_whole(false, 720, 1));
  EXPECT_TRUE(is_whole(false, 150, 1));
  EXPECT_FALSE(is_whole(false, 149, 1));
}

TEST(SplitFactor, EliminatesTheSurfaceOfAThickBodyLast) {
  const std::vector<int> surface{0, 1, 2, 30, 31, 32};
  const auto factor = SplitFactor::of(test::elastic_block(6, 6, 6), surface, plenty, never, {.last = 0});
  ASSERT_TRUE(factor);
  EXPECT_FALSE(factor->surface_within(0));
  EXPECT_EQ(factor->surface(), surface);
}

} // namespace
} // namespace rubato::linalg::surface_in_factor_test
