// SPDX-License-Identifier: LGPL-3.0-or-later
/// Pressing forces that may not pull: near, by an active set, and by conjugate gradients.
#include "rubato/step/interface/normal_problem.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace rubato::step::normal_problem_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Example {
  MatrixXd matrix;
  VectorXd linear;
};

/// Positive definite of full or lower rank, its condition of 1e6 at most.
Example example(int size, int rank, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  const MatrixXd factor = MatrixXd::NullaryExpr(size, rank, [&] { return number(random); });
  Example made{factor * factor.transpose(), {}};
  if (rank >= size)
    made.matrix += 1e-3 * MatrixXd::Identity(size, size);
  // In the range of the matrix, so that there is a minimum.
  made.linear = made.matrix * VectorXd::NullaryExpr(size, [&] { return number(random); });
  return made;
}

/// F ≥ 0, w ≥ 0, F·w = 0
void expect_solved(const Example& made, const VectorXd& x, unsigned seed) {
  const VectorXd gap = made.matrix * x + made.linear;
  EXPECT_GE(x.minCoeff(), 0) << "seed " << seed;
  EXPECT_GE(gap.minCoeff(), -1e-9) << "seed " << seed;
  EXPECT_LT(x.cwiseProduct(gap).lpNorm<Eigen::Infinity>(), 1e-8) << "seed " << seed;
}

TEST(ProjectedConjugateGradients, FindForcesAndGapsThatExcludeEachOther) {
  Progress progress;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    const auto made = example(25, seed % 3 == 0 ? 12 : 30, seed);
    const auto x =
        minimise_over_nonnegative(made.matrix, made.linear, VectorXd::Ones(25), {1e-10, 5000}, progress);
    ASSERT_TRUE(x) << "seed " << seed;
    expect_solved(made, *x, seed);
  }
}

TEST(ProjectedConjugateGradients, SayWhenTheirIterationsDoNotSuffice) {
  const auto made = example(25, 30, 4);
  Progress progress;
  EXPECT_FALSE(minimise_over_nonnegative(made.matrix, made.linear, VectorXd::Ones(25), {1e-12, 2}, progress));
}

TEST(ProjectedConjugateGradients, EndWhenTheirPulseStops) {
  const auto made = example(25, 30, 4);
  int reports = 0;
  Progress progress([&](const ProgressState&) { return ++reports < 3; });
  EXPECT_FALSE(
      minimise_over_nonnegative(made.matrix, made.linear, VectorXd::Ones(25), {1e-10, 5000}, progress));
  EXPECT_EQ(reports, 3);
}

TEST(ANormalProblem, HasOneSolutionHoweverItIsFound) {
  Progress progress;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    const auto made = example(25, 30, seed);
    std::array<VectorXd, 2> found;
    for (const auto how_far : {NormalSolution::active_set, NormalSolution::projected_cg}) {
      VectorXd forces = VectorXd::Zero(25);
      ASSERT_TRUE(solve_normal_problem(made.matrix, made.linear, how_far, forces, progress))
          << "seed " << seed;
      expect_solved(made, forces, seed);
      found[how_far == NormalSolution::active_set ? 0 : 1] = forces;
    }
    EXPECT_LT((found[0] - found[1]).lpNorm<Eigen::Infinity>(), 1e-8 * found[0].lpNorm<Eigen::Infinity>())
        << "seed " << seed;
  }
}

TEST(ANormalProblem, IsSolvedByConjugateGradientsWherePointsSayTheSame) {
  Progress progress;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    const auto once = example(8, 12, seed);
    Example twice{once.matrix.replicate(2, 2), once.linear.replicate(2, 1)};
    VectorXd forces = VectorXd::Zero(16);
    ASSERT_TRUE(
        solve_normal_problem(twice.matrix, twice.linear, NormalSolution::projected_cg, forces, progress));
    expect_solved(twice, forces, seed);
    EXPECT_GT(forces.maxCoeff(), 0) << "seed " << seed;
  }
}

TEST(ANormalProblem, LeavesPointsBetweenHeldPartsAlone) {
  Progress progress;
  for (const auto how_far :
       {NormalSolution::near, NormalSolution::active_set, NormalSolution::projected_cg}) {
    VectorXd forces = VectorXd::Zero(3);
    const MatrixXd matrix = Eigen::Vector3d(0, 2, 0).asDiagonal();
    solve_normal_problem(matrix, Eigen::Vector3d(-1, -3, 1), how_far, forces, progress);
    EXPECT_EQ(forces[0], 0);
    EXPECT_NEAR(forces[1], 1.5, 1e-12);
    EXPECT_EQ(forces[2], 0);
  }
}

TEST(ANormalProblem, EndsWhenItsPulseStops) {
  const auto made = example(25, 30, 4);
  int reports = 0;
  Progress progress([&](const ProgressState&) { return ++reports < 3; });
  VectorXd forces = VectorXd::Zero(25);
  EXPECT_FALSE(
      solve_normal_problem(made.matrix, made.linear, NormalSolution::projected_cg, forces, progress));
  EXPECT_EQ(reports, 3);
}

} // namespace
} // namespace rubato::step::normal_problem_test
