// SPDX-License-Identifier: LGPL-3.0-or-later
// Friction below limits that are held.
#include "rubato/step/interface/tresca_problem.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <random>

namespace rubato::step::tresca_problem_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Points that pull each other along, by seeded random numbers.
struct Rubbing {
  MatrixXd matrix;
  VectorXd values;
  VectorXd limits;

  Rubbing(unsigned seed, Index points, int tangents) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    const auto any = [&] { return number(random); };
    const Index size = points * tangents;
    const MatrixXd root = MatrixXd::NullaryExpr(size, size, any);
    matrix = root * root.transpose() + 0.5 * MatrixXd::Identity(size, size);
    values = VectorXd::NullaryExpr(size, any);
    limits = VectorXd::NullaryExpr(points, [&] { return 0.3 * (1.1 + any()); });
  }

  VectorXd slips(const VectorXd& forces) const { return values + matrix * forces; }
  double energy(const VectorXd& forces) const {
    return forces.dot(values) + 0.5 * forces.dot(matrix * forces);
  }
};

TEST(TrescaProblem, OfOneTangentIsSolvedToItsEnd) {
  int stick = 0;
  int slip = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Rubbing points(seed, 12, 1);
    VectorXd forces = VectorXd::Zero(12);
    Progress progress;
    solve_tresca_problem(points.matrix, points.values, points.limits, 1, forces, progress);
    const VectorXd slips = points.slips(forces);
    for (Index i = 0; i < 12; ++i) {
      if (std::abs(forces[i]) < points.limits[i]) {
        EXPECT_NEAR(slips[i], 0, 1e-9) << "sticks, seed " << seed;
        ++stick;
      } else {
        EXPECT_DOUBLE_EQ(std::abs(forces[i]), points.limits[i]);
        EXPECT_LE(slips[i] * forces[i], 0) << "slips against its force, seed " << seed;
        ++slip;
      }
    }
  }
  EXPECT_GT(stick, 20);
  EXPECT_GT(slip, 20);
}

TEST(TrescaProblem, OfTwoTangentsKeepsItsLimitsAndLosesEnergy) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Rubbing points(seed, 8, 2);
    VectorXd forces = VectorXd::Zero(16);
    Progress progress;
    solve_tresca_problem(points.matrix, points.values, points.limits, 2, forces, progress);
    EXPECT_LT(points.energy(forces), 0) << "that of no forces";
    for (Index i = 0; i < 8; ++i)
      EXPECT_LE(forces.segment<2>(2 * i).norm(), (1 + 1e-12) * points.limits[i]);
    const double before = points.energy(forces);
    for (int again = 0; again < 20; ++again)
      tresca_gauss_seidel(points.matrix, points.values, points.limits, 2, forces);
    EXPECT_LE(points.energy(forces), before + 1e-12);
    EXPECT_NEAR(points.energy(forces), before, 0.05 * std::abs(before)) << "seed " << seed;
  }
}

/// Alone, and as stiff along both tangents: pulled by more than its limit it slips straight against its
/// force.
TEST(TrescaProblem, OfAPointAloneIsKnown) {
  const MatrixXd matrix = 2 * MatrixXd::Identity(2, 2);
  for (const double limit : {1.0, 10.0}) {
    VectorXd forces = VectorXd::Zero(2);
    Progress progress;
    solve_tresca_problem(matrix, Eigen::Vector2d(6, -8), VectorXd::Constant(1, limit), 2, forces, progress);
    EXPECT_LE((forces - std::min(limit, 5.0) * Eigen::Vector2d(-0.6, 0.8)).norm(), 1e-14);
  }
}

TEST(TrescaProblem, LeavesWhatTheSweepsFoundWhereItIsStopped) {
  const Rubbing points(3, 12, 1);
  VectorXd swept = VectorXd::Zero(12);
  tresca_gauss_seidel(points.matrix, points.values, points.limits, 1, swept);
  VectorXd forces = VectorXd::Zero(12);
  Progress progress([](const ProgressState&) { return false; });
  solve_tresca_problem(points.matrix, points.values, points.limits, 1, forces, progress);
  EXPECT_TRUE(progress.stopped());
  EXPECT_EQ(forces, swept);
}

/// The second one is held: no force moves it.
TEST(TrescaSweeps, LeavePointsThatNothingMoves) {
  MatrixXd matrix = MatrixXd::Zero(2, 2);
  matrix(0, 0) = 2;
  VectorXd forces = Eigen::Vector2d(0, 0.25);
  tresca_gauss_seidel(matrix, Eigen::Vector2d(1, 1), Eigen::Vector2d(9, 9), 1, forces);
  EXPECT_EQ(forces, VectorXd(Eigen::Vector2d(-0.5, 0.25)));
}

} // namespace
} // namespace rubato::step::tresca_problem_test
