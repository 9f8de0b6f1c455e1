// SPDX-License-Identifier: LGPL-3.0-or-later
// With one rank; tests/ranks has several.
#include "rubato/linalg/conjugate_gradients.hpp"
#include "rubato/linalg/petsc_module.hpp"
#include "rubato/linalg/ranked_factor.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "support/dense.hpp"
#include "unit/linalg/elastic_block.hpp"
#include "unit/linalg/matrices_beside.hpp"
#include "unit/linalg/random_vector.hpp"
#include <limits>
#include <stdexcept>

namespace rubato::linalg::ranked_factor_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::random_vector;

/// They do not touch.
SparseMatrix two_blocks() {
  return test::beside(test::elastic_block(4, 2, 2), test::elastic_block(3, 2, 1));
}

class RankedFactorOfBlocks : public testing::Test {
protected:
  void SetUp() override {
    if (!has_conjugate_gradients())
      GTEST_SKIP() << "needs PETSc";
    const auto last = static_cast<int>(matrix_.cols()) - 1;
    surface_ = {last, 5, last - 7, 30, 31};
    factor_ = RankedFactor::of(matrix_, surface_, join_ranks(), {});
    ASSERT_NE(factor_, nullptr);
    inverse_ = test::inverse(matrix_);
  }

  VectorXd expected(const VectorXd& right_side) const { return inverse_ * right_side; }
  static void expect_near(const VectorXd& found, const VectorXd& wanted) {
    EXPECT_LE((found - wanted).norm(), 1e-10 * wanted.norm());
  }

  SparseMatrix matrix_ = two_blocks();
  std::vector<int> surface_;
  std::unique_ptr<RankedFactor> factor_;
  MatrixXd inverse_;
};

TEST_F(RankedFactorOfBlocks, CountsItsSurfaceBodyAfterBody) {
  const auto last = static_cast<int>(matrix_.cols()) - 1;
  EXPECT_EQ(factor_->surface(), (std::vector<int>{5, 30, 31, last, last - 7}));
  EXPECT_EQ(factor_->body_starts(), (std::vector<int>{0, 3, 5}));
}

TEST_F(RankedFactorOfBlocks, SolvesInHalves) {
  VectorXd right_side = random_vector(matrix_.rows(), 1);
  expect_near(factor_->solve(right_side), expected(right_side));
  auto half_way = factor_->forward(right_side);
  expect_near(factor_->surface_of(half_way), expected(right_side)(factor_->surface()));
  const auto force = random_vector(5, 2);
  factor_->load_surface(force, half_way);
  right_side(factor_->surface()) += force;
  expect_near(factor_->surface_of(half_way), expected(right_side)(factor_->surface()));
  expect_near(factor_->backward(half_way), expected(right_side));
}

/// The library remembers the last first half only.
TEST_F(RankedFactorOfBlocks, MakesSecondHalvesInAnyOrder) {
  const auto a = random_vector(matrix_.rows(), 3), b = random_vector(matrix_.rows(), 4);
  const auto half_a = factor_->forward(a);
  const auto half_b = factor_->forward(b);
  expect_near(factor_->backward(half_a), expected(a));
  expect_near(factor_->backward(half_b), expected(b));
  expect_near(factor_->backward(half_b), expected(b));
  expect_near(factor_->backward(half_a), expected(a));
}

TEST_F(RankedFactorOfBlocks, HasTheCompliance) {
  for (std::size_t body = 0; body < 2; ++body) {
    const Index first = factor_->body_starts()[body], size = factor_->body_starts()[body + 1] - first;
    const std::vector<int> unknowns(factor_->surface().begin() + first,
                                    factor_->surface().begin() + first + size);
    const MatrixXd wanted = inverse_(unknowns, unknowns);
    EXPECT_LE((factor_->compliance(body) - wanted).norm(), 1e-10 * wanted.norm());
    EXPECT_LE((factor_->compliance(body, 1, 1) - wanted.col(1)).norm(), 1e-10 * wanted.norm());
    expect_near(factor_->moved_by(body, VectorXd::Ones(size)), wanted.rowwise().sum());
  }
}

TEST_F(RankedFactorOfBlocks, TakesOtherValues) {
  const auto before = factor_->renewals(0);
  EXPECT_TRUE(factor_->refactor(matrix_));
  EXPECT_EQ(factor_->renewals(0), before);
  const SparseMatrix twice = 2 * matrix_;
  EXPECT_TRUE(factor_->refactor(twice));
  EXPECT_EQ(factor_->renewals(0), before + 1);
  const auto right_side = random_vector(matrix_.rows(), 5);
  expect_near(factor_->solve(right_side), expected(right_side) / 2);
  EXPECT_THROW(factor_->refactor(test::elastic_block(4, 2, 2)), std::invalid_argument);
}

TEST_F(RankedFactorOfBlocks, KnowsMatricesThatAreNotPositiveDefinite) {
  for (const int unknown : {7, 5}) { // in the inside, on the surface
    SparseMatrix other = matrix_;
    other.coeffRef(unknown, unknown) *= -1;
    EXPECT_EQ(RankedFactor::of(other, surface_, join_ranks(), {}), nullptr);
    EXPECT_FALSE(factor_->refactor(other));
    EXPECT_FALSE(factor_->has_values());
    EXPECT_THROW(factor_->solve(VectorXd::Ones(matrix_.rows())), std::logic_error);
    other.coeffRef(unknown, unknown) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(factor_->refactor(other));
    EXPECT_TRUE(factor_->refactor(matrix_));
  }
}

TEST_F(RankedFactorOfBlocks, NeedsNoSurface) {
  const auto factor = RankedFactor::of(matrix_, {}, join_ranks(), {});
  ASSERT_NE(factor, nullptr);
  const auto right_side = random_vector(matrix_.rows(), 6);
  expect_near(factor->solve(right_side), expected(right_side));
  auto half_way = factor->forward(right_side);
  factor->load_surface(VectorXd(0), half_way);
  expect_near(factor->backward(half_way), expected(right_side));
  EXPECT_GT(factor->factor_bytes(), 0);
  EXPECT_GT(factor->factor_flops(), 0);
}

} // namespace
} // namespace rubato::linalg::ranked_factor_test
