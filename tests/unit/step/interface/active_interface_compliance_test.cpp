// SPDX-License-Identifier: LGPL-3.0-or-later
// The compliance between the active dofs of contact points against that of the whole interface.
#include "rubato/step/interface/active_interface_compliance.hpp"

#include <gtest/gtest.h>

#include "unit/step/interface/two_blocks_compliance.hpp"
#include <algorithm>
#include <random>
#include <stdexcept>
#include <vector>

namespace rubato::step::active_interface_compliance_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::compliance_of_two_blocks;
using test::interface_dofs_of;

class ActiveDofs : public testing::Test {
protected:
  MatrixXd random_matrix(Index rows, Index columns) {
    std::uniform_real_distribution<double> number(-1, 1);
    return MatrixXd::NullaryExpr(rows, columns, [&] { return number(random_); });
  }
  void take(const std::vector<int>& interface_dofs) {
    surface_.add(interface_dofs);
    surface_.touch_added();
  }
  /// S between the active dofs.
  MatrixXd expected() {
    return whole_.between(interface_dofs_of(whole_))(surface_.interface_dofs(), surface_.interface_dofs());
  }

  /// Forces and equations of a point over some of the active dofs.
  PointRows point(std::vector<int> active_dofs, Index rows) {
    const auto columns = static_cast<Index>(active_dofs.size());
    return {std::move(active_dofs), random_matrix(rows, columns), random_matrix(rows, columns)};
  }
  /// A point's rows over all active dofs.
  MatrixXd spread(const MatrixXd& rows, const PointRows& of) const {
    MatrixXd all = MatrixXd::Zero(rows.rows(), surface_.size());
    for (std::size_t q = 0; q < of.active_dofs.size(); ++q)
      all.col(of.active_dofs[q]) += rows.col(static_cast<Index>(q));
    return all;
  }

  Compliance compliance_ = compliance_of_two_blocks(5000);
  Compliance whole_ = compliance_of_two_blocks(5000);
  ActiveInterfaceCompliance surface_{compliance_};
  int body_ = static_cast<int>(compliance_.size()) / 2; ///< where the second one begins

private:
  std::mt19937 random_{29};
};

/// Dofs of both blocks, in no order.
std::vector<int> some_dofs(int body) {
  return {body + 7, 3, 90, body + 1, 40, body + 30, 0};
}

TEST_F(ActiveDofs, AreNumberedInTheOrderOfTheInterfaceEachOnce) {
  surface_.add(std::vector{9, 2, 9});
  surface_.add(std::vector{2, body_ + 4});
  surface_.touch_added();
  EXPECT_EQ(surface_.interface_dofs(), (std::vector{2, 9, body_ + 4}));
  EXPECT_EQ(surface_.size(), 3);
  EXPECT_EQ(surface_.active_dof_of(2), 0);
  EXPECT_EQ(surface_.active_dof_of(9), 1);
  EXPECT_EQ(surface_.active_dof_of(body_ + 4), 2);
  EXPECT_EQ(surface_.active_dof_of(5), -1);
}

TEST_F(ActiveDofs, AreNumberedAnewWhenThereAreMore) {
  take({9, 20});
  take({9, 4});
  EXPECT_EQ(surface_.interface_dofs(), (std::vector{4, 9, 20}));
  EXPECT_EQ(surface_.active_dof_of(9), 1);
}

TEST_F(ActiveDofs, AreForgotten) {
  take(some_dofs(body_));
  surface_.forget();
  EXPECT_EQ(surface_.size(), 0);
  for (const int dof : some_dofs(body_))
    EXPECT_EQ(surface_.active_dof_of(dof), -1);
  take({body_ + 2, 5});
  const VectorXd force = random_matrix(2, 1);
  VectorXd moved;
  surface_.multiply(force, moved);
  EXPECT_LE((moved - expected() * force).norm(), 1e-14 * moved.norm());
}

TEST_F(ActiveDofs, MoveAsTheWholeInterfaceByForcesOnThem) {
  for (const auto& dofs :
       {some_dofs(body_), std::vector{body_ + 3, body_ + 4, body_ + 100}, std::vector{8}}) {
    surface_.forget();
    take(dofs);
    const VectorXd force = random_matrix(surface_.size(), 1);
    const VectorXd wanted = expected() * force;
    VectorXd moved = VectorXd::Constant(99, 7);
    surface_.multiply(force, moved);
    ASSERT_EQ(moved.size(), surface_.size());
    EXPECT_LE((moved - wanted).norm(), 1e-13 * wanted.norm());
  }
}

TEST_F(ActiveDofs, MoveByForcesGivenAtSomeOfThem) {
  take(some_dofs(body_));
  const std::vector<int> at{6, 0, 3}; // on both blocks, one of them without a force
  const Eigen::RowVectorXd force{{1.5, 0, -2}};
  VectorXd all = VectorXd::Zero(surface_.size());
  all[6] = 1.5;
  all[3] = -2;
  const VectorXd before = random_matrix(surface_.size(), 1);
  VectorXd moved = before;
  surface_.add_motion(at, force, moved.data());
  const VectorXd wanted = before + expected() * all;
  EXPECT_LE((moved - wanted).norm(), 1e-13 * wanted.norm());
}

TEST_F(ActiveDofs, OfOneBlockDoNotMoveByForcesOnTheOther) {
  take(some_dofs(body_));
  VectorXd force = VectorXd::Zero(surface_.size()), moved;
  force[0] = 1;
  surface_.multiply(force, moved);
  for (Index i = 0; i < moved.size(); ++i)
    EXPECT_EQ(moved[i] != 0, surface_.interface_dofs()[static_cast<std::size_t>(i)] < body_) << i;
}

TEST_F(ActiveDofs, SeeWhatPointsForcesMove) {
  take(some_dofs(body_));
  for (const Index rows : {1, 2, 3, 4, 5}) {
    const std::vector<PointRows> points{point({0, 4, 2}, rows), point({1, 3, 5, 6}, rows), point({2}, rows)};
    std::vector<const PointRows*> all;
    for (const auto& each : points)
      all.push_back(&each);
    const auto between = between_points(surface_, all, rows, -0.7);
    ASSERT_EQ(between.rows(), 3 * rows);
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = 0; j < points.size(); ++j) {
        const MatrixXd wanted = -0.7 * spread(points[i].left, points[i]) * expected() *
                                spread(points[j].right, points[j]).transpose();
        EXPECT_LE(
            (between.block(static_cast<Index>(i) * rows, static_cast<Index>(j) * rows, rows, rows) - wanted)
                .norm(),
            1e-13 * expected().norm())
            << i << ", " << j;
      }
  }
}

TEST_F(ActiveDofs, MoveByUnitForcesOfAPoint) {
  take(some_dofs(body_));
  const auto some = point({5, 1, 2}, 4);
  for (const Index rows : {2, 4}) {
    const MatrixXd wanted = expected() * spread(some.right.topRows(rows), some).transpose();
    const auto found = moved_by(surface_, some, rows);
    ASSERT_EQ(found.cols(), rows);
    EXPECT_LE((found - wanted).norm(), 1e-13 * wanted.norm());
  }
}

TEST_F(ActiveDofs, ArePointsOfOneToFiveUnknowns) {
  take({1});
  const auto some = point({0}, 6);
  const PointRows* const one = &some;
  EXPECT_THROW(between_points(surface_, {&one, 1}, 6, 1), std::invalid_argument);
  EXPECT_THROW(between_points(surface_, {&one, 1}, 0, 1), std::invalid_argument);
}

TEST(RowsOfAPoint, AreFilledUpWithZeros) {
  PointRows rows{{3, 1}, MatrixXd::Ones(2, 2), MatrixXd::Constant(3, 2, 5)};
  rows.fill_up(3);
  EXPECT_EQ(rows.left, (MatrixXd(3, 2) << 1, 1, 1, 1, 0, 0).finished());
  EXPECT_EQ(rows.right, MatrixXd::Constant(3, 2, 5)) << "it has as many";
  rows.fill_up(1);
  EXPECT_EQ(rows.left.rows(), 3);
}

} // namespace
} // namespace rubato::step::active_interface_compliance_test
