// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/newton_history.hpp"

#include <gtest/gtest.h>

#include "support/dense.hpp"
#include <utility>

namespace rubato::step::newton_history_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What corrections leave of a linear problem: its error times this matrix. Forces are the places of the
/// surface, and a multiplier twice their sum.
struct Iterations {
  MatrixXd left;
  VectorXd solution;

  Corrected correct(const VectorXd& x) const {
    const VectorXd next = solution + left * (x - solution);
    return {next, next, {VectorXd::Constant(1, 2 * next.sum())}};
  }
};

/// Most of an error is taken at once, a little of it slowly: growing, to and fro, not at all.
Iterations with_slow_directions() {
  const MatrixXd directions = (MatrixXd(5, 3) << 1, 0, 0, 1, 1, 0, 0, 2, 1, 0, -1, 1, 1, 0, 3).finished();
  const MatrixXd dual = test::pseudo_inverse(directions);
  const VectorXd parts = (VectorXd(3) << 1.1, -0.95, 0.999).finished();
  return {directions * parts.asDiagonal() * dual, VectorXd::LinSpaced(5, -1, 2)};
}

/// The error after some iterations, and the last multiplier.
std::pair<double, double> iterated(const Iterations& problem, int count, bool accelerated) {
  NewtonHistory history;
  VectorXd x = VectorXd::Zero(5);
  double multiplier = 0;
  for (int i = 0; i < count; ++i) {
    auto corrected = problem.correct(x);
    history.add(corrected.moved - x, corrected);
    if (accelerated && history.is_slow())
      history.accelerate(corrected);
    x = corrected.applied;
    multiplier = corrected.multipliers[0][0];
  }
  return {(x - problem.solution).norm(), multiplier};
}

TEST(NewtonHistory, EndsWithAnIterationForEachSlowDirection) {
  const auto problem = with_slow_directions();
  const auto [error, multiplier] = iterated(problem, 6, true);
  EXPECT_LE(error, 1e-9);
  EXPECT_NEAR(multiplier, 2 * problem.solution.sum(), 1e-9);
  EXPECT_GE(iterated(problem, 100, false).first, 0.1);
}

TEST(NewtonHistory, RemembersTheLastIteratesOnly) {
  const auto problem = with_slow_directions();
  NewtonHistory history;
  const VectorXd far = VectorXd::Constant(5, 1e6);
  for (int i = 0; i < 3; ++i)
    history.add(far, {far, far, {VectorXd::Zero(1)}});
  VectorXd x = VectorXd::Zero(5);
  for (int i = 0; i < 12; ++i) {
    auto corrected = problem.correct(x);
    history.add(corrected.moved - x, corrected);
    if (history.is_slow())
      history.accelerate(corrected);
    x = corrected.applied;
  }
  EXPECT_LE((x - problem.solution).norm(), 1e-8);
}

TEST(NewtonHistory, IsSlowWhereACorrectionIsMoreThanATenthOfTheOneBefore) {
  NewtonHistory history;
  const VectorXd unit = VectorXd::Unit(2, 0);
  const Corrected none{unit, unit, {}};
  history.add(unit, none);
  EXPECT_FALSE(history.is_slow());
  history.add(0.09 * unit, none);
  EXPECT_FALSE(history.is_slow());
  history.add(0.01 * unit, none);
  EXPECT_TRUE(history.is_slow());
  history.forget();
  EXPECT_FALSE(history.is_slow());
}

TEST(NewtonHistory, LeavesACorrectionThatRepeatsItselfAlone) {
  NewtonHistory history;
  const VectorXd change = VectorXd::Ones(3);
  Corrected corrected{change, change, {}};
  for (int i = 0; i < 4; ++i)
    history.add(change, corrected);
  history.accelerate(corrected);
  EXPECT_EQ(corrected.applied, change);
}

} // namespace
} // namespace rubato::step::newton_history_test
