// SPDX-License-Identifier: LGPL-3.0-or-later
/// Conjugate gradients over forces that may not pull.
#include "rubato/step/interface/projected_cg.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/walk.hpp"
#include <random>

namespace rubato::step {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::Walk;

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

TEST(ProjectedConjugateGradients, FindForcesAndGapsThatExcludeEachOther) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    const auto made = example(25, seed % 3 == 0 ? 12 : 30, seed);
    BoundedProblem problem;
    problem.multiply = [&](const VectorXd& x) { return VectorXd(made.matrix * x); };
    problem.precondition = [&](const VectorXd& g) {
      return VectorXd(g.cwiseQuotient(VectorXd(made.matrix.diagonal())));
    };
    problem.linear = made.linear;
    problem.tolerance = 1e-10;
    problem.max_iterations = 5000;
    const auto x = minimise_over_nonnegative(problem, VectorXd::Ones(25));
    ASSERT_TRUE(x) << "seed " << seed;
    const VectorXd gap = made.matrix * *x + made.linear;
    EXPECT_GE(x->minCoeff(), 0) << "seed " << seed;
    EXPECT_GE(gap.minCoeff(), -1e-9) << "seed " << seed;
    EXPECT_LT(x->cwiseProduct(gap).lpNorm<Eigen::Infinity>(), 1e-8) << "seed " << seed;
  }
}

TEST(ProjectedConjugateGradients, SayWhenTheirIterationsDoNotSuffice) {
  const auto made = example(25, 30, 4);
  BoundedProblem problem;
  problem.multiply = [&](const VectorXd& x) { return VectorXd(made.matrix * x); };
  problem.precondition = [](const VectorXd& g) { return g; };
  problem.linear = made.linear;
  problem.tolerance = 1e-12;
  problem.max_iterations = 2;
  EXPECT_FALSE(minimise_over_nonnegative(problem, VectorXd::Ones(25)));
}

TEST(ProjectedConjugateGradients, EndWhenTheirPulseStops) {
  const auto made = example(25, 30, 4);
  int beats = 0;
  Pulse pulse([&](const Beat&) { return ++beats < 3; });
  BoundedProblem problem;
  problem.multiply = [&](const VectorXd& x) { return VectorXd(made.matrix * x); };
  problem.precondition = [](const VectorXd& g) { return g; };
  problem.linear = made.linear;
  problem.tolerance = 1e-10;
  problem.max_iterations = 5000;
  problem.pulse = &pulse;
  EXPECT_FALSE(minimise_over_nonnegative(problem, VectorXd::Ones(25)));
  EXPECT_EQ(beats, 3);
}

TEST(ProjectedConjugateGradients, MoveTheBeamsAsTheActiveSetDoes) {
  const auto walk = [](const char* method) {
    Walk one(test::two_beams, {{"contact.interface.method", method}, {"contact.interface.friction", "0"}});
    EXPECT_TRUE(one.to_end()) << method;
    return one;
  };
  const auto exact = walk("nodal_lagrange");
  const auto gradients = walk("nodal_pcg");
  EXPECT_GT(exact.resultants().in_contact, 0);
  EXPECT_LT((exact.state().motion.u - gradients.state().motion.u).lpNorm<Eigen::Infinity>(),
            1e-8 * exact.state().motion.u.lpNorm<Eigen::Infinity>());
}

} // namespace
} // namespace rubato::step
