// SPDX-License-Identifier: LGPL-3.0-or-later
/// The sweeps that Newton starts from, on small problems with known answers.
#include "rubato/step/interface/contact_predictor.hpp"
#include "rubato/step/interface/tresca_problem.hpp"

#include <gtest/gtest.h>

#include "unit/linalg/elastic_block.hpp"
#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <utility>

namespace rubato::step::contact_predictor_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Symmetric, positive definite and well conditioned, so that few sweeps come close.
MatrixXd stiffish(Index size, std::mt19937& random) {
  std::uniform_real_distribution<double> number(-0.1, 0.1);
  MatrixXd a = MatrixXd::NullaryExpr(size, size, [&] { return number(random); });
  return MatrixXd(a * a.transpose()) + MatrixXd::Identity(size, size);
}

TEST(PressingSweeps, PushOnlyWhereGapsWouldBeNegative) {
  const MatrixXd springs = (MatrixXd(2, 2) << 2, 0, 0, 4).finished();
  VectorXd forces = VectorXd::Zero(2);
  normal_gauss_seidel(springs, Eigen::Vector2d(-3, 1), forces);
  EXPECT_DOUBLE_EQ(forces[0], 1.5);
  EXPECT_EQ(forces[1], 0);
}

TEST(PressingSweeps, ComeCloseToComplementarity) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    const auto matrix = stiffish(12, random);
    const VectorXd gaps = VectorXd::NullaryExpr(12, [&] { return number(random); });
    VectorXd forces = VectorXd::NullaryExpr(12, [&] { return std::abs(number(random)); });
    normal_gauss_seidel(matrix, gaps, forces);
    const VectorXd open = gaps + matrix * forces;
    const double largest = forces.maxCoeff();
    for (Index i = 0; i < 12; ++i) {
      EXPECT_GE(forces[i], 0);
      EXPECT_GE(open[i], -0.02 * largest);
      EXPECT_LE(std::min(forces[i], open[i]), 0.02 * largest);
    }
  }
}

TEST(PressingSweeps, LeavePointsBetweenHeldPartsAlone) {
  VectorXd forces = VectorXd::Zero(1);
  normal_gauss_seidel(MatrixXd::Zero(1, 1), VectorXd::Constant(1, -1), forces);
  EXPECT_EQ(forces[0], 0);
}

TEST(RubbingSweeps, StickBelowTheLimitAndSlideAgainstTheSlipAtIt) {
  const MatrixXd springs = MatrixXd::Identity(2, 2);
  VectorXd forces = VectorXd::Zero(2);
  tresca_gauss_seidel(springs, Eigen::Vector2d(0.3, -5), Eigen::Vector2d(1, 2), 1, forces);
  EXPECT_DOUBLE_EQ(forces[0], -0.3);
  EXPECT_DOUBLE_EQ(forces[1], 2);
}

TEST(RubbingSweeps, TurnAgainstTheSlipInThePlane) {
  const MatrixXd springs = MatrixXd::Identity(2, 2);
  VectorXd forces = VectorXd::Zero(2);
  tresca_gauss_seidel(springs, Eigen::Vector2d(30, 40), VectorXd::Constant(1, 5), 2, forces);
  EXPECT_NEAR(forces[0], -3, 1e-12);
  EXPECT_NEAR(forces[1], -4, 1e-12);
}

/// Points that press a block of elastic cells, each on a node of its own, all pushed in along z.
class PushedBlock : public testing::Test {
protected:
  PushedBlock() : compliance_(factored(), constraint::Reduction(static_cast<int>(matrix_.rows()), {})) {
    for (int i = 0; i < 8; ++i) {
      PredictorPoint point;
      point.index = static_cast<std::size_t>(i);
      const auto& at = compliance_.interface_dof_of_dof();
      const auto first = static_cast<std::size_t>(9 * i);
      point.stencil.nodes = {{.at = {at[first], at[first + 1], at[first + 2]}, .weight = 1}};
      point.frame << 0, 1, 0, 0, 0, 1, 1, 0, 0;
      point.value << (i % 3 == 0 ? 0.5 : -1.0 - i), 0.2 * i, -0.1;
      point.value *= unit();
      point.friction = 0.3;
      points_.push_back(point);
    }
  }

  std::vector<int> numbers() const {
    std::vector<int> all(static_cast<std::size_t>(matrix_.rows()));
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  linalg::SplitFactor factored() const {
    return *linalg::SplitFactor::of(matrix_, numbers(), std::numeric_limits<std::size_t>::max());
  }
  static double unit() { return 1e-3; }

  Progress progress_;

  /// The surface under the points' forces.
  VectorXd moved() {
    VectorXd force = VectorXd::Zero(matrix_.rows());
    for (const auto& point : points_)
      for (int c = 0; c < 3; ++c)
        force[point.stencil.nodes.front().at[static_cast<std::size_t>(c)]] += (point.frame * point.force)[c];
    VectorXd d = VectorXd::Zero(matrix_.rows());
    compliance_.add(1, force, d);
    return d;
  }

  Eigen::Vector3d measures(const PredictorPoint& point, const VectorXd& d) const {
    Eigen::Vector3d e;
    for (int c = 0; c < 3; ++c)
      e[c] = d[point.stencil.nodes.front().at[static_cast<std::size_t>(c)]];
    return point.value + point.frame.transpose() * e;
  }

  linalg::SparseMatrix matrix_ = test::elastic_block(5, 4, 3);
  Compliance compliance_;
  std::vector<PredictorPoint> points_;
};

// With points on a third of the surface, and on most of it.
TEST_F(PushedBlock, HasTheSameForcesWhateverPartOfTheSurfaceIsLookedAt) {
  for (const auto& [how_far, apart] : {std::pair{NormalSolution::near, 9},
                                       {NormalSolution::near, 5},
                                       {NormalSolution::active_set, 9},
                                       {NormalSolution::active_set, 5}}) {
    auto whole = points_;
    for (int first = 0; auto& point : whole) {
      point.stencil.nodes.front().at = {first, first + 1, first + 2};
      first += apart;
    }
    auto watched = whole;
    const VectorXd free = VectorXd::Zero(matrix_.rows());
    ContactPredictor(compliance_, 0.7, 3, how_far).improve(whole, free, free, matrix_, progress_);
    ContactPredictor(compliance_, 0.7, 3, how_far, 0).improve(watched, free, free, matrix_, progress_);
    double largest = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      EXPECT_EQ(watched[i].force, whole[i].force) << i;
      largest = std::max(largest, whole[i].force[0]);
    }
    EXPECT_GT(largest, 0);
  }
}

TEST_F(PushedBlock, HasTheSameForcesWherePointsAreTakenTogether) {
  constexpr auto no_limit = std::numeric_limits<std::size_t>::max();
  auto factor = linalg::SplitFactor::of(matrix_, numbers(), no_limit, [](std::size_t) {}, {.last = 0});
  Compliance within(std::move(*factor), constraint::Reduction(static_cast<int>(matrix_.rows()), {}));
  ASSERT_TRUE(within.takes_forces_together());
  const auto& at = within.interface_dof_of_dof();
  const VectorXd free = VectorXd::Zero(matrix_.rows());
  for (const auto how_far : {NormalSolution::near, NormalSolution::active_set}) {
    auto expected = points_;
    ContactPredictor(compliance_, 0.7, 3, how_far).improve(expected, free, free, matrix_, progress_);
    const auto pressing = [](const PredictorPoint& point) { return point.force[0]; };
    const double largest = pressing(*std::ranges::max_element(expected, {}, pressing));
    EXPECT_GT(largest, 0);
    for (const std::size_t many : {1, 1000}) {
      auto points = points_;
      for (std::size_t i = 0; i < points.size(); ++i)
        points[i].stencil.nodes.front().at = {at[9 * i], at[9 * i + 1], at[9 * i + 2]};
      ContactPredictor(within, 0.7, 3, how_far, 0, many).improve(points, free, free, matrix_, progress_);
      for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_LE((points[i].force - expected[i].force).norm(), 1e-10 * largest) << i;
    }
  }
}

// Pressing forces alone: friction stays what the points bring, within its limit.
TEST_F(PushedBlock, IsPressedNearlyAsFarByProductsWithTheCompliance) {
  for (auto& point : points_)
    point.friction = 0;
  const VectorXd free = VectorXd::Zero(matrix_.rows());
  auto expected = points_;
  ContactPredictor(compliance_, 0.7, 3).improve(expected, free, free, matrix_, progress_);
  ContactPredictor by_products(compliance_, 0.7, 3, NormalSolution::near, 0, 1000, 0);
  for (auto& point : points_)
    point.force = {0, 1, 0};
  by_products.improve(points_, free, free, matrix_, progress_);
  EXPECT_EQ(by_products.misfit(points_, free), 0);
  double largest = 0;
  int pressed = 0;
  for (const auto& point : expected)
    largest = std::max(largest, point.force[0]);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    EXPECT_NEAR(points_[i].force[0], expected[i].force[0], 0.05 * largest) << i;
    EXPECT_EQ(points_[i].force.tail<2>().norm(), 0) << i;
    pressed += points_[i].force[0] > 0 ? 1 : 0;
  }
  EXPECT_GT(pressed, 2);
}

TEST_F(PushedBlock, IsPressedWhereItPenetratesAndRubbedNoMoreThanItMay) {
  ContactPredictor guess(compliance_, 1, 3);
  for (int round = 0; round < 20; ++round)
    guess.improve(points_, VectorXd::Zero(matrix_.rows()), moved(), matrix_, progress_);
  const VectorXd d = moved();
  double largest = 0;
  for (const auto& point : points_)
    largest = std::max(largest, point.force[0]);
  EXPECT_GT(largest, 0);
  EXPECT_LE(guess.misfit(points_, d), 1e-2);
  int pressed = 0;
  for (const auto& point : points_) {
    pressed += point.force[0] > 0 ? 1 : 0;
    EXPECT_GE(point.force[0], 0);
    const double gap = measures(point, d)[0];
    EXPECT_GE(gap, -0.02 * unit());
    EXPECT_LE(point.force[0] > 0 ? gap : 0.0, 0.02 * unit());
    EXPECT_LE(point.force.tail<2>().norm(), (1 + 1e-12) * point.friction * point.force[0]);
  }
  EXPECT_GT(pressed, 2);
  EXPECT_LT(pressed, 8);
}

TEST_F(PushedBlock, FindsTheSameForcesAgain) {
  ContactPredictor guess(compliance_, 1, 3);
  guess.improve(points_, VectorXd::Zero(matrix_.rows()), moved(), matrix_, progress_);
  const auto first = points_;
  for (auto& point : points_)
    point.force.setZero();
  guess.forget();
  guess.improve(points_, VectorXd::Zero(matrix_.rows()), moved(), matrix_, progress_);
  for (std::size_t i = 0; i < points_.size(); ++i)
    EXPECT_EQ(points_[i].force, first[i].force);
}

} // namespace
} // namespace rubato::step::contact_predictor_test
