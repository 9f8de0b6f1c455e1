// SPDX-License-Identifier: LGPL-3.0-or-later
/// The points' linear system against the equations it stands for, with made-up points on two elastic blocks.
#include "rubato/step/interface/interface_newton_system.hpp"

#include <gtest/gtest.h>

#include "support/dense.hpp"
#include "unit/linalg/elastic_block.hpp"
#include <limits>
#include <numeric>
#include <random>

namespace rubato::step::interface_newton_system_test {
namespace {

using contact::FactoredResponse;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double force_weight = 0.7;

class Random {
public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double number() { return std::uniform_real_distribution<double>(-1, 1)(engine_); }
  MatrixXd matrix(Index rows, Index columns) {
    return MatrixXd::NullaryExpr(rows, columns, [&] { return number(); });
  }
  int below(int end) { return std::uniform_int_distribution<int>(0, end - 1)(engine_); }

private:
  std::mt19937 engine_;
};

/// A point of eight displacements, three forces and two coordinates on its master, its multipliers three.
FactoredResponse made_up(Random& random, int dofs, double slope_size) {
  FactoredResponse response;
  response.components = 3;
  response.n_xi = 2;
  while (response.dofs.size() < 8)
    if (const int dof = random.below(dofs);
        std::find(response.dofs.begin(), response.dofs.end(), dof) == response.dofs.end())
      response.dofs.push_back(dof);
  response.force = random.matrix(3, 1);
  response.interpolation = random.matrix(5, 8);
  response.interpolation.bottomRows(2) *= slope_size;
  response.d_du = random.matrix(8, 8);
  response.by_multiplier = random.matrix(6, 3);
  response.equations = random.matrix(3, 1);
  return response;
}

struct Bulk {
  linalg::SparseMatrix matrix = test::elastic_block(5, 4, 3);
  MatrixXd s; ///< of all dofs
  Compliance compliance;

  /// All but a few unknowns are on the surface; every unknown is its own dof.
  Bulk()
      : s(test::inverse(matrix)),
        compliance(factored(), constraint::Reduction(static_cast<int>(matrix.rows()), {})) {}
  std::vector<int> numbers() const {
    std::vector<int> all(static_cast<std::size_t>(matrix.rows()));
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  linalg::SplitFactor factored() const {
    auto surface = numbers();
    surface.resize(surface.size() - 5);
    return *linalg::SplitFactor::of(matrix, surface, std::numeric_limits<std::size_t>::max());
  }
};

/// Of all points, one a position.
VectorXd force_of(std::span<const ActivePoint> points, const Compliance& compliance) {
  VectorXd force = VectorXd::Zero(compliance.size());
  for (const auto& point : points)
    for (std::size_t q = 0; q < point.response.dofs.size(); ++q)
      force[compliance.interface_dof_of_dof()[static_cast<std::size_t>(point.response.dofs[q])]] +=
          point.response.interpolation.col(static_cast<Index>(q)).head(3).dot(point.response.force);
  return force;
}

struct Points {
  double slope_size;
  std::size_t count;
};

/// How far the changes that a system comes to are from fulfilling the equations of its points.
void expect_solved(InterfaceNewtonSystem& system, Bulk& bulk, const VectorXd& d0, double tolerance = 1e-7) {
  const auto& dofs = bulk.compliance.dof_of_interface_dof();
  VectorXd force = force_of(system.points(), bulk.compliance);
  const auto change = system.solve(d0, force, bulk.matrix);
  ASSERT_TRUE(change);
  const MatrixXd s = bulk.s(dofs, dofs);
  system.add_force(*change, force);
  const VectorXd moved = d0 - force_weight * s * force;
  for (const auto& point : system.points()) {
    const auto& r = point.response;
    const VectorXd m = system.multipliers_of(point, *change, moved);
    VectorXd q(8);
    for (Index k = 0; k < 8; ++k)
      q[k] =
          moved[bulk.compliance
                    .interface_dof_of_dof()[static_cast<std::size_t>(r.dofs[static_cast<std::size_t>(k)])]];
    const VectorXd z = change->force.segment(point.first, 3);
    const double size = std::max(1.0, z.lpNorm<Eigen::Infinity>());
    EXPECT_LE((r.d_du.topRows(3) * q + r.by_multiplier.topRows(3) * m - z).lpNorm<Eigen::Infinity>(),
              tolerance * size);
    EXPECT_LE((r.d_du.middleRows(3, 3) * q + r.by_multiplier.bottomRows(3) * m + r.equations)
                  .lpNorm<Eigen::Infinity>(),
              tolerance * size);
    EXPECT_LE((r.d_du.bottomRows(2) * q - change->xi.segment(point.first_slope, 2)).lpNorm<Eigen::Infinity>(),
              tolerance * size);
  }
}

class InterfaceNewtonSystemWith : public testing::TestWithParam<Points> {
protected:
  std::vector<FactoredResponse> points() {
    std::vector<FactoredResponse> all;
    for (std::size_t i = 0; i < GetParam().count; ++i) {
      all.push_back(made_up(random, static_cast<int>(bulk.matrix.rows()) - 5, GetParam().slope_size));
      // In units that make the compliance of order one.
      all.back().interpolation /= bulk.s.diagonal().maxCoeff();
    }
    return all;
  }
  VectorXd way() { return random.matrix(bulk.compliance.size(), 1); }
  void take(const std::vector<FactoredResponse>& points) {
    for (std::size_t i = 0; i < points.size(); ++i)
      system.add(0, i) = points[i];
  }

  Bulk bulk;
  Random random{17};
  ActiveInterfaceCompliance surface{bulk.compliance};
  InterfaceNewtonSystem system{bulk.compliance, surface, force_weight};
};

TEST_P(InterfaceNewtonSystemWith, SolvesEachPointsEquations) {
  take(points());
  expect_solved(system, bulk, way());
}

TEST_P(InterfaceNewtonSystemWith, SolvesThemByProductsWithTheComplianceToo) {
  InterfaceNewtonSystem by_products(bulk.compliance, surface, force_weight,
                                    {.formed = 0, .left_by_products = 1e-4});
  const auto some = points();
  for (std::size_t i = 0; i < some.size(); ++i)
    by_products.add(0, i) = some[i];
  expect_solved(by_products, bulk, way(), 1e-3);
}

// With the factors of points that differ little, of points that differ much, and of others.
TEST_P(InterfaceNewtonSystemWith, SolvesThoseOfTheNextIterations) {
  auto some = points();
  take(some);
  expect_solved(system, bulk, way());
  for (const double change : {1e-6, 1e-3, 1.0}) {
    for (auto& point : some)
      point.d_du += change * random.matrix(point.d_du.rows(), point.d_du.cols());
    system.clear();
    take(some);
    expect_solved(system, bulk, way());
  }
  some.erase(some.begin() + 3);
  system.clear();
  take(some);
  expect_solved(system, bulk, way());
}

// Where points come to other places, S between the places that they have left is not formed again.
TEST_P(InterfaceNewtonSystemWith, ForgetsPlacesThatAreMoreThanHalfOfAll) {
  InterfaceNewtonSystem forgetful(bulk.compliance, surface, force_weight, {.kept = 1});
  const auto some = points();
  for (std::size_t i = 0; i < some.size(); ++i)
    forgetful.add(0, i) = some[i];
  expect_solved(forgetful, bulk, way());
  const auto all = surface.size();
  for (const std::size_t only : {2U, 5U}) {
    forgetful.clear();
    forgetful.add(0, only) = some[only];
    expect_solved(forgetful, bulk, way());
    EXPECT_LE(surface.size(), 2 * static_cast<Index>(some[only].dofs.size()));
  }
  EXPECT_GT(all, 2 * 8);
}

// From places that hardly matter to ones that matter as much as forces. Few points are solved for at once,
// of many the forces first, refined with the places.
INSTANTIATE_TEST_SUITE_P(Few, InterfaceNewtonSystemWith,
                         testing::Values(Points{0, 12}, Points{1e-3, 12}, Points{1e-1, 12}, Points{1, 12},
                                         Points{10, 12}));
INSTANTIATE_TEST_SUITE_P(Many, InterfaceNewtonSystemWith,
                         testing::Values(Points{0, 20}, Points{1e-3, 20}, Points{1e-1, 20}, Points{1, 20},
                                         Points{10, 20}));

TEST(InterfaceNewtonSystem, SharesAForceAmongPointsThatSayTheSame) {
  Bulk bulk;
  const double unit = 1 / bulk.s.diagonal().maxCoeff();
  FactoredResponse held; // one displacement held at 1 by a force along it
  held.components = 1;
  held.dofs = {7};
  held.force = VectorXd::Zero(1);
  held.interpolation = MatrixXd::Constant(1, 1, unit);
  held.d_du = (MatrixXd(2, 1) << 0, 1).finished();
  held.by_multiplier = (MatrixXd(2, 1) << 1, 0).finished();
  held.equations = VectorXd::Constant(1, -1);
  ActiveInterfaceCompliance surface(bulk.compliance);
  InterfaceNewtonSystem system(bulk.compliance, surface, force_weight);
  system.add(0, 0) = held;
  system.add(0, 1) = held;
  const VectorXd none = VectorXd::Zero(bulk.compliance.size());
  const auto change = system.solve(none, none, bulk.matrix);
  ASSERT_TRUE(change);
  EXPECT_NEAR(change->force[0], change->force[1], 1e-9 * std::abs(change->force[0]));
  const double moved = -force_weight * bulk.s(7, 7) * unit * (change->force[0] + change->force[1]);
  EXPECT_NEAR(moved, 1, 1e-9);
}

/// Points that share the multipliers of five nodes, some of them apart.
class SharedBy : public testing::TestWithParam<Points> {
protected:
  static constexpr int nodes = 5;

  struct Point {
    FactoredResponse response;
    std::vector<MultiplierShare> shares;
    bool open = false;
  };

  /// Those apart are between the last two nodes, of which only the last one has no other points.
  std::vector<Point> points() {
    std::vector<Point> all;
    for (std::size_t i = 0; i < GetParam().count; ++i) {
      Point point;
      point.open = i % 4 == 3;
      point.response = made_up(random, static_cast<int>(bulk.matrix.rows()) - 5, GetParam().slope_size);
      point.response.interpolation /= bulk.s.diagonal().maxCoeff();
      const int first = point.open ? nodes - 2 : random.below(nodes - 2);
      for (int node = first; node < first + 2; ++node)
        point.shares.push_back({3 * node, random.number()});
      if (point.open)
        point.response.by_multiplier.bottomRows(3) = -MatrixXd::Identity(3, 3);
      all.push_back(std::move(point));
    }
    return all;
  }

  void take(const std::vector<Point>& points) {
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points[i].open)
        system.add_open(points[i].shares, points[i].response.multiplier_equations());
      else
        system.add(0, i, points[i].shares) = points[i].response;
  }

  /// δm at a point.
  static VectorXd interpolated(const Point& point, const VectorXd& multipliers) {
    VectorXd m = VectorXd::Zero(3);
    for (const auto& share : point.shares)
      m += share.shape * multipliers.segment(share.first, 3);
    return m;
  }

  void expect_solved(const std::vector<Point>& points, const VectorXd& d0) {
    const auto& dofs = bulk.compliance.dof_of_interface_dof();
    VectorXd force = force_of(system.points(), bulk.compliance);
    const auto change = system.solve(d0, force, bulk.matrix);
    ASSERT_TRUE(change);
    VectorXd multipliers = VectorXd::Zero(3 * nodes);
    system.for_each_shared(*change, [&](int i, double by) { multipliers[i] = by; });
    system.add_force(*change, force);
    const VectorXd moved = d0 - force_weight * bulk.s(dofs, dofs) * force;
    VectorXd equations = VectorXd::Zero(3 * nodes);
    for (const auto& point : system.points()) {
      const auto& r = point.response;
      const VectorXd m = interpolated(points[point.index], multipliers);
      VectorXd q(8);
      for (Index k = 0; k < 8; ++k)
        q[k] =
            moved[bulk.compliance
                      .interface_dof_of_dof()[static_cast<std::size_t>(r.dofs[static_cast<std::size_t>(k)])]];
      const VectorXd z = change->force.segment(point.first, 3);
      EXPECT_LE((r.d_du.topRows(3) * q + r.by_multiplier.topRows(3) * m - z).lpNorm<Eigen::Infinity>(),
                1e-7 * std::max(1.0, z.lpNorm<Eigen::Infinity>()));
      for (const auto& share : point.shares)
        equations.segment(share.first, 3) +=
            share.shape * (r.d_du.middleRows(3, 3) * q + r.by_multiplier.bottomRows(3) * m + r.equations);
    }
    for (const auto& point : points)
      if (const auto& r = point.response; point.open)
        for (const auto& share : point.shares)
          equations.segment(share.first, 3) +=
              share.shape * (r.by_multiplier.bottomRows(3) * interpolated(point, multipliers) + r.equations);
    EXPECT_LE(equations.lpNorm<Eigen::Infinity>(),
              1e-7 * std::max(1.0, multipliers.lpNorm<Eigen::Infinity>()));
  }

  Bulk bulk;
  Random random{23};
  ActiveInterfaceCompliance surface{bulk.compliance};
  InterfaceNewtonSystem system{bulk.compliance, surface, force_weight};
};

TEST_P(SharedBy, TheSumsOfPointsEquationsAreSolved) {
  auto some = points();
  const VectorXd d0 = random.matrix(bulk.compliance.size(), 1);
  take(some);
  expect_solved(some, d0);
  for (const double change : {1e-6, 1e-2}) {
    for (auto& point : some)
      point.response.d_du += change * random.matrix(8, 8);
    system.clear();
    take(some);
    expect_solved(some, d0);
  }
}

TEST_P(SharedBy, PointsThatOpenLeaveTheirMultipliersToTheOthers) {
  auto some = points();
  const VectorXd d0 = random.matrix(bulk.compliance.size(), 1);
  take(some);
  expect_solved(some, d0);
  for (auto& point : some) {
    point.open = true;
    point.response.by_multiplier.bottomRows(3) = -MatrixXd::Identity(3, 3);
    point.response.equations = -interpolated(point, VectorXd::Ones(3 * nodes));
  }
  system.clear();
  take(some);
  const auto change = system.solve(d0, VectorXd::Zero(d0.size()), bulk.matrix);
  ASSERT_TRUE(change);
  EXPECT_EQ(change->shared.size(), 0);
  // λ = 1 everywhere is to vanish.
  std::vector<double> by;
  system.for_each_shared(*change, [&](int, double change_of) { by.push_back(change_of); });
  EXPECT_EQ(by.size(), 3U * nodes);
  for (const double value : by)
    EXPECT_NEAR(value, -1, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Few, SharedBy, testing::Values(Points{0, 8}, Points{1e-2, 8}, Points{1, 12}));
INSTANTIATE_TEST_SUITE_P(Many, SharedBy, testing::Values(Points{0, 24}, Points{1e-2, 24}));

// Between parts that are held nothing can be said of its multiplier: it stays.
TEST(SharedMultipliers, StayWhereNoDisplacementIsFree) {
  SharedMultipliers shared;
  const std::vector<MultiplierShare> held{{0, 1.0}}, free{{1, 1.0}};
  contact::PointEquations pressed;
  pressed.values = VectorXd::Constant(1, 0.3);
  pressed.by_multiplier = MatrixXd::Zero(1, 1);
  shared.add_pressed(held, pressed);
  shared.add_pressed(free, pressed);
  ASSERT_TRUE(shared.number());
  shared.see(shared.unknown_of(1), 4, 2.0);
  shared.assemble(6);
  EXPECT_EQ(shared.right()[0], 0);
  EXPECT_EQ(shared.by_unknown()(0, 0), 1);
  EXPECT_DOUBLE_EQ(shared.right()[1], -0.3);
  EXPECT_EQ(shared.by_unknown()(1, 1), 0);
}

TEST(InterfaceNewtonSystem, WithoutPointsChangesNothing) {
  Bulk bulk;
  ActiveInterfaceCompliance surface(bulk.compliance);
  InterfaceNewtonSystem system(bulk.compliance, surface, force_weight);
  const auto size = bulk.compliance.size();
  VectorXd force = VectorXd::Zero(size);
  const auto change = system.solve(VectorXd::Ones(size), force, bulk.matrix);
  ASSERT_TRUE(change);
  EXPECT_EQ(change->force.size(), 0);
  system.add_force(*change, force);
  EXPECT_TRUE(force.isZero(0));
}

TEST(ActivePoint, HasReducedEquationsHoweverItsMultipliersWereEliminated) {
  Random random(5);
  ActivePoint point;
  point.response = made_up(random, 8, 1);
  eliminate_multipliers(point);
  auto mixed = point;
  const Eigen::Matrix3d mix = random.matrix(3, 3);
  mixed.by_force = (mix * point.by_force).eval();
  mixed.right = (mix * point.right).eval();
  mixed.rows.left.topRows(3) = (mix * point.rows.left.topRows(3)).eval();
  const double give = 0.01;
  reduce_equations(point, give);
  reduce_equations(mixed, give);
  EXPECT_LE((point.by_force - mixed.by_force).norm(), 1e-10 * point.by_force.norm());
  EXPECT_LE((point.rows.left - mixed.rows.left).norm(), 1e-10 * point.rows.left.norm());
  EXPECT_LE((point.right - mixed.right).norm(), 1e-10 * point.right.norm());
}

TEST(ActivePoint, KeepsEquationsThatSayTheSame) {
  ActivePoint point;
  point.response.components = 2;
  point.by_force = Eigen::Matrix2d::Ones();
  point.right = Eigen::Vector2d(3, 3);
  point.rows.left = MatrixXd::Constant(2, 4, 5);
  reduce_equations(point, 0.1);
  EXPECT_EQ(point.by_force, MatrixXd::Ones(2, 2));
  EXPECT_EQ(point.rows.left, MatrixXd::Constant(2, 4, 5));
  EXPECT_EQ(point.right, VectorXd::Constant(2, 3));
}

TEST(ActiveInterfaceCompliance, TakesMoreAndKeepsWhatItHas) {
  Bulk bulk;
  ActiveInterfaceCompliance surface(bulk.compliance);
  surface.add(std::vector<int>{9, 4, 9});
  surface.touch_added();
  EXPECT_EQ(surface.interface_dofs(), (std::vector<int>{4, 9}));
  surface.add(std::vector<int>{6, 4});
  surface.touch_added();
  EXPECT_EQ(surface.interface_dofs(), (std::vector<int>{4, 6, 9}));
  EXPECT_EQ(surface.active_dof_of(6), 1);
  const Eigen::Vector3d force(1, -2, 3);
  VectorXd moved;
  surface.multiply(force, moved);
  const auto& dofs = bulk.compliance.dof_of_interface_dof();
  const std::vector<int> at{dofs[4], dofs[6], dofs[9]};
  EXPECT_LE((moved - bulk.s(at, at) * force).norm(), 1e-12 * moved.norm());
}

} // namespace
} // namespace rubato::step::interface_newton_system_test
