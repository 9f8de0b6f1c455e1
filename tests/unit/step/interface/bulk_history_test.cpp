// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/bulk_history.hpp"

#include <gtest/gtest.h>

namespace rubato::step::bulk_history_test {
namespace {

using contact::Status;
using Eigen::VectorXd;

using Statuses = std::vector<std::vector<Status>>;

/// A matrix too stiff along three directions leaves that much of an error there.
const VectorXd left = (VectorXd(5) << 0, 0.9, 0, 0.6, -0.5).finished();
const VectorXd solution = VectorXd::LinSpaced(5, -1, 2);

/// What is reached from a motion: velocities are twice the displacements, accelerations four times, forces
/// and multipliers five and six times.
BulkIterate reached_from(const VectorXd& u) {
  const VectorXd next = solution + left.cwiseProduct(u - solution);
  BulkIterate iterate{{next, 2 * next, 4 * next}, ContactForce(5), {6 * next}};
  iterate.force.all = 5 * next;
  return iterate;
}

void expect_consistent(const BulkIterate& iterate) {
  const auto& u = iterate.motion.u;
  EXPECT_LE((iterate.motion.v - 2 * u).norm(), 1e-10);
  EXPECT_LE((iterate.motion.a - 4 * u).norm(), 1e-10);
  EXPECT_LE((iterate.force.all - 5 * u).norm(), 1e-10);
  EXPECT_LE((iterate.multipliers[0] - 6 * u).norm(), 1e-10);
}

time::Motion at(const VectorXd& u) {
  return {u, 2 * u, 4 * u};
}

TEST(BulkHistory, EndsWithAnIterateForEachSlowDirection) {
  const Statuses stick{{Status::stick}};
  BulkHistory history;
  VectorXd u = VectorXd::Zero(5);
  for (int i = 0; i < 8; ++i) {
    auto next = reached_from(u);
    history.add(at(u), next, stick);
    if (history.is_slow())
      next = history.accelerated();
    expect_consistent(next);
    u = next.motion.u;
  }
  EXPECT_LE((u - solution).norm(), 1e-9);
}

TEST(BulkHistory, KnowsNothingOfIteratesWithOtherStatuses) {
  BulkHistory history;
  VectorXd u = VectorXd::Zero(5);
  for (const auto status : {Status::stick, Status::slip, Status::stick}) {
    const auto next = reached_from(u);
    history.add(at(u), next, Statuses{{status}});
    EXPECT_FALSE(history.is_slow());
    u = next.motion.u;
  }
  history.add(at(u), reached_from(u), Statuses{{Status::stick}});
  EXPECT_TRUE(history.is_slow());
  history.forget();
  EXPECT_FALSE(history.is_slow());
}

/// Two moves in one direction tell, of others it takes three.
TEST(BulkHistory, KnowsWhetherMovesAreSteadilySlow) {
  const Statuses stick{{Status::stick}};
  const auto slow_after = [&](double part) {
    BulkHistory history;
    double u = 1;
    for (int moves = 1; moves < 6; ++moves) {
      const VectorXd next = VectorXd::Constant(5, part * u);
      history.add(at(VectorXd::Constant(5, u)), {{next, next, next}, ContactForce(5), {}}, stick);
      if (history.is_steadily_slow())
        return moves;
      u *= part;
    }
    return 0;
  };
  EXPECT_EQ(slow_after(0.9), 2);
  EXPECT_EQ(slow_after(-0.6), 3);
  EXPECT_EQ(slow_after(-1.1), 0) << "grows";
  EXPECT_EQ(slow_after(0.01), 0) << "converges";
}

} // namespace
} // namespace rubato::step::bulk_history_test
