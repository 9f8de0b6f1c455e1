// SPDX-License-Identifier: LGPL-3.0-or-later
/// The sweeps that Newton starts from, on small problems with known answers.
#include "rubato/step/contact_guess.hpp"

#include <gtest/gtest.h>

#include <random>

namespace rubato::step {
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
  sweep_pressing(springs, Eigen::Vector2d(-3, 1), forces);
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
    sweep_pressing(matrix, gaps, forces);
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
  sweep_pressing(MatrixXd::Zero(1, 1), VectorXd::Constant(1, -1), forces);
  EXPECT_EQ(forces[0], 0);
}

TEST(RubbingSweeps, StickBelowTheLimitAndSlideAgainstTheSlipAtIt) {
  const MatrixXd springs = MatrixXd::Identity(2, 2);
  VectorXd forces = VectorXd::Zero(2);
  sweep_rubbing(springs, Eigen::Vector2d(0.3, -5), Eigen::Vector2d(1, 2), 1, forces);
  EXPECT_DOUBLE_EQ(forces[0], -0.3);
  EXPECT_DOUBLE_EQ(forces[1], 2);
}

TEST(RubbingSweeps, TurnAgainstTheSlipInThePlane) {
  const MatrixXd springs = MatrixXd::Identity(2, 2);
  VectorXd forces = VectorXd::Zero(2);
  sweep_rubbing(springs, Eigen::Vector2d(30, 40), VectorXd::Constant(1, 5), 2, forces);
  EXPECT_NEAR(forces[0], -3, 1e-12);
  EXPECT_NEAR(forces[1], -4, 1e-12);
}

} // namespace
} // namespace rubato::step
