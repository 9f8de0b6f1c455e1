// SPDX-License-Identifier: LGPL-3.0-or-later
// A point's equations without its multipliers against those with them.
#include "rubato/step/interface/active_point.hpp"

#include <gtest/gtest.h>

#include "support/dense.hpp"
#include <array>
#include <random>
#include <string>
#include <vector>

namespace rubato::step::active_point_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Sizes {
  int components, multipliers, n_xi;
};

/// What the multipliers' equations say.
enum class Law { of_all, of_motion_alone, of_multipliers_alone };

struct Case {
  Sizes sizes;
  Law law;
};

constexpr Index unknowns = 7;

class PointWith : public testing::TestWithParam<Case> {
protected:
  MatrixXd random_matrix(Index rows, Index columns) {
    std::uniform_real_distribution<double> number(-1, 1);
    return MatrixXd::NullaryExpr(rows, columns, [&] { return number(random_); });
  }

  ActivePoint made_up() {
    const auto [d, m, n_xi] = GetParam().sizes;
    ActivePoint point;
    auto& r = point.response;
    r.components = d;
    r.n_xi = n_xi;
    r.interpolation = random_matrix(d + n_xi, unknowns);
    r.d_du = random_matrix(d + m + n_xi, unknowns);
    r.by_multiplier = random_matrix(d + m, m);
    r.equations = random_matrix(m, 1);
    if (GetParam().law == Law::of_motion_alone)
      r.by_multiplier.bottomRows(m).setZero();
    if (GetParam().law == Law::of_multipliers_alone)
      r.d_du.middleRows(d, m).setZero();
    for (int q = 0; q < unknowns; ++q)
      point.interface_dofs.push_back(unknowns - 1 - q); // q stands there backwards
    return point;
  }

  /// Changes that fulfil E_q δq + E_m δm + e = 0.
  struct Changes {
    VectorXd q, m, z, xi;
  };
  Changes changes_of(const ActivePoint& point) {
    const auto& r = point.response;
    const Index d = r.components, m = r.multipliers();
    MatrixXd both(m, unknowns + m);
    both << r.d_du.middleRows(d, m), r.by_multiplier.bottomRows(m);
    VectorXd x = random_matrix(unknowns + m, 1);
    if (m > 0)
      x -= both.transpose() * test::inverse(both * both.transpose()) * (both * x + r.equations);
    Changes changes{x.head(unknowns), x.tail(m), {}, {}};
    changes.z = r.d_du.topRows(d) * changes.q + r.by_multiplier.topRows(d) * changes.m;
    changes.xi = r.d_du.bottomRows(r.n_xi) * changes.q;
    return changes;
  }

  void expect_fulfilled(const ActivePoint& point, const Changes& changes) const {
    const Index d = point.components();
    EXPECT_LE((point.by_force * changes.z + point.rows.left.topRows(d) * changes.q - point.right).norm(),
              1e-12 * (1 + changes.z.norm()));
    EXPECT_LE((point.rows.left.bottomRows(point.n_xi()) * changes.q + changes.xi).norm(), 1e-14);
    EXPECT_EQ(point.rows.right, point.response.interpolation);
  }

private:
  std::mt19937 random_{31};
};

TEST_P(PointWith, HasTheSameChangesWithoutItsMultipliers) {
  auto point = made_up();
  eliminate_multipliers(point);
  for (int trial = 0; trial < 5; ++trial)
    expect_fulfilled(point, changes_of(point));
}

/// As many as there are forces: they say no less than they did.
TEST_P(PointWith, HasAsManyEquationsLeftAsForces) {
  auto point = made_up();
  eliminate_multipliers(point);
  const Index d = point.components();
  MatrixXd both(d, d + unknowns);
  both << point.by_force, point.rows.left.topRows(d);
  EXPECT_EQ(test::rank(both), d);
}

TEST_P(PointWith, FindsItsMultipliersAgain) {
  auto point = made_up();
  eliminate_multipliers(point);
  const auto changes = changes_of(point);
  const VectorXd moved = changes.q.reverse();
  const VectorXd found = multiplier_change(point, std::vector(changes.z.begin(), changes.z.end()), moved);
  EXPECT_LE((found - changes.m).norm(), 1e-12 * (1 + changes.m.norm()));
}

TEST_P(PointWith, KeepsTheMultipliersThatItShares) {
  auto point = made_up();
  keep_multipliers(point);
  const auto& r = point.response;
  const Index d = r.components;
  EXPECT_EQ(point.by_force, MatrixXd::Identity(d, d));
  EXPECT_EQ(point.right, VectorXd::Zero(d));
  EXPECT_EQ(point.rows.left.topRows(d), -r.d_du.topRows(d));
  EXPECT_EQ(point.rows.left.bottomRows(r.n_xi), -r.d_du.bottomRows(r.n_xi));
  EXPECT_EQ(point.rows.right, r.interpolation);
}

TEST_P(PointWith, HasReducedEquationsThatSayTheSame) {
  auto point = made_up();
  eliminate_multipliers(point);
  reduce_equations(point, 0.01);
  for (int trial = 0; trial < 5; ++trial)
    expect_fulfilled(point, changes_of(point));
}

/// In whatever order and size it had them.
TEST_P(PointWith, HasReducedEquationsOfItsOwn) {
  auto point = made_up();
  eliminate_multipliers(point);
  auto other = point;
  const Index d = point.components();
  MatrixXd turned = MatrixXd::Zero(d, d);
  for (Index row = 0; row < d; ++row)
    turned(row, d - 1 - row) = row == 0 ? -3 : 0.5;
  other.by_force = (turned * point.by_force).eval();
  other.right = (turned * point.right).eval();
  other.rows.left.topRows(d) = (turned * point.rows.left.topRows(d)).eval();
  constexpr double compliance = 0.01;
  for (auto* each : {&point, &other})
    reduce_equations(*each, compliance);
  EXPECT_LE((point.by_force - other.by_force).norm(), 1e-11 * point.by_force.norm());
  EXPECT_LE((point.rows.left - other.rows.left).norm(), 1e-11 * point.rows.left.norm());
  EXPECT_LE((point.right - other.right).norm(), 1e-11 * (1 + point.right.norm()));
  MatrixXd both(d, d + unknowns);
  both << point.by_force, compliance * point.rows.left.topRows(d);
  Index units = 0;
  for (Index column = 0; column < both.cols() && units < d; ++column)
    units += (both.col(column) - VectorXd::Unit(d, units)).norm() < 1e-12 ? 1 : 0;
  EXPECT_EQ(units, d) << "a unit column each, in the order of the columns";
}

std::vector<Case> every_case() {
  std::vector<Case> all;
  for (const auto& sizes : {Sizes{3, 3, 2}, Sizes{2, 2, 1}, Sizes{3, 1, 2}, Sizes{2, 1, 0}, Sizes{3, 2, 0},
                            Sizes{1, 1, 0}, Sizes{3, 0, 2}, Sizes{2, 0, 1}}) {
    all.push_back({sizes, Law::of_all});
    if (sizes.multipliers > 0) {
      all.push_back({sizes, Law::of_motion_alone});
      all.push_back({sizes, Law::of_multipliers_alone});
    }
  }
  return all;
}

std::string name_of(const Case& one) {
  const std::string kind = one.law == Law::of_all            ? "AndMotion"
                           : one.law == Law::of_motion_alone ? "WithMotionAlone"
                                                             : "WithoutMotion";
  return "Of" + std::to_string(one.sizes.multipliers) + "For" + std::to_string(one.sizes.components) +
         "Forces" + kind;
}

INSTANTIATE_TEST_SUITE_P(Multipliers, PointWith, testing::ValuesIn(every_case()),
                         [](const auto& instance) { return name_of(instance.param); });

/// A multiplier that presses, with an equation for a gap that supports hold.
ActivePoint held_point(double rounding) {
  ActivePoint point;
  auto& r = point.response;
  r.components = 1;
  r.interpolation = MatrixXd::Constant(1, 1, 2);
  r.d_du = (MatrixXd(2, 1) << 0.5, rounding).finished();
  r.by_multiplier = (MatrixXd(2, 1) << 1, 0).finished();
  r.equations = VectorXd::Constant(1, 5);
  point.interface_dofs = {0};
  return point;
}

TEST(AMultiplierThatNothingFreeAnswersTo, StaysAsItIs) {
  for (const double rounding : {0.0, 1e-16}) {
    auto point = held_point(rounding);
    eliminate_multipliers(point);
    const VectorXd moved = VectorXd::Constant(1, 3);
    EXPECT_NEAR(multiplier_change(point, std::array{1.5}, moved)[0], 0, 1e-15);
    // The force changes by what moves alone: δz = 0.5 δq.
    EXPECT_NEAR(point.by_force(0, 0) * 1.5 + point.rows.left(0, 0) * 3, point.right[0], 1e-15);
    EXPECT_EQ(point.response.equations[0], 0);
  }
  auto point = held_point(0.1);
  eliminate_multipliers(point);
  EXPECT_NEAR(point.by_force(0, 0) * 9 + point.rows.left(0, 0) * -50, point.right[0], 1e-13)
      << "one that can move is held at −50, whatever the force";
}

TEST(EquationsThatSayTheSame, AreLeftAsTheyAre) {
  ActivePoint point;
  point.response.components = 2;
  point.by_force = (MatrixXd(2, 2) << 1, 2, 2, 4).finished();
  point.rows.left = (MatrixXd(2, 3) << 3, 0, 1, 6, 0, 2).finished();
  point.right = Eigen::Vector2d(1, 2);
  const auto before = point;
  reduce_equations(point, 0.5);
  EXPECT_EQ(point.by_force, before.by_force);
  EXPECT_EQ(point.rows.left, before.rows.left);
  EXPECT_EQ(point.right, before.right);
}

} // namespace
} // namespace rubato::step::active_point_test
