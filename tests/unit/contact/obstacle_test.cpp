// SPDX-License-Identifier: LGPL-3.0-or-later
// Planes, cylinders and spheres: where they are, and every derivative against central differences.
#include "rubato/contact/frozen_frame.hpp"
#include "rubato/contact/obstacle.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "contact_system.hpp"
#include "obstacles.hpp"
#include <random>

namespace rubato::contact::obstacle_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using study::ObstacleKind;
using study::ObstacleSide;
using study::Physics;

constexpr double h = 1e-6;

PlaceOnObstacle seen(const study::Obstacle& obstacle, const Vector3d& x, Physics physics = Physics::solid) {
  return place_on(make_obstacle(obstacle, physics, {}), {}, x, x);
}

void expect_at(const PlaceOnObstacle& place, double gap, const Vector3d& normal) {
  EXPECT_NEAR(place.gap, gap, 1e-15);
  EXPECT_LT((place.normal - normal).norm(), 1e-15);
}

TEST(Obstacles, AreWhereTheDeckPutsThem) {
  expect_at(seen({.point = {0, 1, 0}, .direction = {0, -3, 0}}, {7, 0.25, 5}), 0.75, {0, -1, 0});
  const study::Obstacle pipe{
      .kind = ObstacleKind::cylinder, .point = {0, 0, 9}, .direction = {0, 0, 2}, .radius = 2};
  expect_at(seen(pipe, {3, 4, 1}), 3, {0.6, 0.8, 0});
  const study::Obstacle ball{.kind = ObstacleKind::sphere, .point = {1, 1, 1}, .radius = 4};
  expect_at(seen(ball, {1, 1, 4}), -1, {0, 0, 1});
}

TEST(Obstacles, TouchFromOutsideOrInside) {
  study::Obstacle bowl{
      .kind = ObstacleKind::sphere, .point = {1, 1, 1}, .radius = 4, .side = ObstacleSide::inside};
  expect_at(seen(bowl, {1, 1, 4}), 1, {0, 0, -1});
  bowl.kind = ObstacleKind::cylinder;
  bowl.direction = {0, 1, 0};
  expect_at(seen(bowl, {6, 0, 1}), -1, {-1, 0, 0});
}

TEST(Obstacles, AreCirclesInPlanePhysicsAndAroundTheAxisOfRevolution) {
  const study::Obstacle circle{
      .kind = ObstacleKind::cylinder, .point = {1, 0, 0}, .direction = {0, 0, 1}, .radius = 1};
  const auto beside = seen(circle, {1, 3, 0}, Physics::plane_stress);
  expect_at(beside, 2, {0, 1, 0});
  EXPECT_EQ(beside.tangent, Vector3d(-1, 0, 0));
  const study::Obstacle ball{.kind = ObstacleKind::sphere, .point = {0, 1, 0}, .radius = 1};
  expect_at(seen(ball, {3, 5, 0}, Physics::axisymmetric), 4, {0.6, 0.8, 0});
  study::Obstacle shaft{.kind = ObstacleKind::cylinder, .radius = 2};
  expect_at(seen(shaft, {3, 5, 0}, Physics::axisymmetric), 1, {1, 0, 0});
  shaft.side = ObstacleSide::inside;
  expect_at(seen(shaft, {0.5, 5, 0}, Physics::axisymmetric), 1.5, {-1, 0, 0});
}

TEST(Obstacles, FollowTheirFunctionsOfTime) {
  study::Obstacle plane{.direction = {0, 1, 0}};
  plane.move = {study::Amplitude{2, "ramp"}, study::Amplitude{-1, {}}, {}};
  const auto obstacle = make_obstacle(plane, Physics::plane_strain, {{"ramp", {{0, 4}, {0, 1}, {}}}});
  EXPECT_TRUE(obstacle.moves());
  EXPECT_EQ(obstacle.pose(1).offset, Vector3d(0.5, -1, 0));
  EXPECT_EQ(obstacle.pose(9).offset, Vector3d(2, -1, 0));
  plane.move[0].reset();
  EXPECT_FALSE(make_obstacle(plane, Physics::plane_strain, {}).moves());
}

TEST(Obstacles, GiveANormalEvenInTheirMiddle) {
  for (const auto kind : {ObstacleKind::cylinder, ObstacleKind::sphere}) {
    const auto place = seen({.kind = kind, .direction = {0, 0, 1}, .radius = 2}, Vector3d::Zero());
    EXPECT_EQ(place.gap, -2);
    EXPECT_EQ(place.normal.norm(), 1);
    EXPECT_TRUE(place.curvature.isZero(0));
  }
}

/// Half way round a ball, where its frame has no least turn to come from.
TEST(Obstacles, GiveAFrameOppositeToWhereItStarted) {
  const auto ball = make_obstacle({.kind = ObstacleKind::sphere, .radius = 1}, Physics::solid, {});
  const auto place = place_on(ball, {}, {0, 0, -2}, {0, 0, 2});
  EXPECT_NEAR(place.tangent.norm(), 1, 1e-15);
  EXPECT_EQ(place.tangent.dot(place.normal), 0);
}

class SlaveBefore : public testing::TestWithParam<test::NamedObstacle> {
protected:
  test::TwoFaces setup_ = test::two_faces(GetParam().options);

  Kinematics of(std::size_t point, const VectorXd& u) const {
    return evaluate_kinematics(setup_.zone, setup_.zone.points[point], Pair::before_obstacle(),
                               setup_.configuration(u));
  }
};

TEST_P(SlaveBefore, HasAnOrthonormalFrameAndItsFootOnTheSurface) {
  for (std::size_t p = 0; p < setup_.zone.points.size(); ++p) {
    const auto k = of(p, setup_.u);
    Eigen::Matrix3d frame;
    frame << k.tangents, k.normal;
    EXPECT_LT((frame.transpose() * frame - Eigen::Matrix3d::Identity()).norm(), 1e-14);
    EXPECT_NEAR(frame.determinant(), 1, 1e-14);
    const auto& obstacle = *setup_.zone.obstacle;
    const auto foot = place_on(obstacle, obstacle.pose(setup_.t), k.closest_point, k.closest_point);
    EXPECT_NEAR(foot.gap, 0, 1e-15);
    EXPECT_LT((foot.normal - k.normal).norm(), 1e-14);
    if (k.stencil.components == 2) {
      EXPECT_LT((k.tangents.col(1) - Vector3d::UnitZ()).norm(), 1e-15);
    }
  }
}

TEST_P(SlaveBefore, VariesAsItsKinematicsSay) {
  for (std::size_t p = 0; p < setup_.zone.points.size(); ++p) {
    const auto at = of(p, setup_.u);
    for (Eigen::Index column = 0; column < at.unknowns(); ++column) {
      const auto node = at.stencil.nodes[static_cast<std::size_t>(column / at.stencil.components)];
      const auto dof = setup_.dofs.dof(node, static_cast<int>(column % at.stencil.components));
      const auto plus = of(p, test::moved(setup_.u, dof, h));
      const auto minus = of(p, test::moved(setup_.u, dof, -h));
      EXPECT_NEAR((plus.gap - minus.gap) / (2 * h), at.d_gap[column], 1e-9);
      EXPECT_LT(((plus.normal - minus.normal) / (2 * h) - at.d_normal.col(column)).norm(), 1e-9);
      EXPECT_LT(((plus.slip - minus.slip) / (2 * h) - at.d_slip.col(column)).norm(), 1e-9);
      for (std::size_t a = 0; a < 2; ++a) {
        const auto tangent = static_cast<Eigen::Index>(a);
        const Vector3d change = (plus.tangents.col(tangent) - minus.tangents.col(tangent)) / (2 * h);
        EXPECT_LT((change - at.d_tangent[a].col(column)).norm(), 1e-9);
      }
    }
  }
}

TEST_P(SlaveBefore, HasTheExactTangentOfForcesAndEquations) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(0.5, 1.5);
  const VectorXd multipliers =
      VectorXd::NullaryExpr(setup_.zone.multiplier_count(), [&] { return number(random); });
  const auto dofs = setup_.dofs.dof_count;
  for (const auto status : {Status::open, Status::stick, Status::slip}) {
    const auto at = test::system_at(setup_, setup_.u, multipliers, status);
    for (Eigen::Index i = 0; i < at.residual.size(); ++i) {
      const auto residual = [&](double by) {
        return i < dofs ? test::system_at(setup_, test::moved(setup_.u, i, by), multipliers, status).residual
                        : test::system_at(setup_, setup_.u, test::moved(multipliers, i - dofs, by), status)
                              .residual;
      };
      const VectorXd difference = (residual(h) - residual(-h)) / (2 * h);
      EXPECT_LT((difference - at.tangent.col(i)).lpNorm<Eigen::Infinity>(), 1e-8) << "unknown " << i;
    }
  }
}

/// Where the place of an obstacle comes that is at x.
Vector3d carried(const Obstacle& obstacle, const Vector3d& x, double from, double to) {
  const auto before = obstacle.pose(from), now = obstacle.pose(to);
  return obstacle.point + now.offset +
         now.turn * before.turn.transpose() * (x - obstacle.point - before.offset);
}

/// A body that goes with the obstacle does not rub on it, one that stays does.
TEST_P(SlaveBefore, SlipsAgainstTheMotionOfTheObstacle) {
  const auto& obstacle = *setup_.zone.obstacle;
  const auto start = setup_.configuration(setup_.u_start);
  const int d = setup_.dofs.components;
  VectorXd along = setup_.u_start;
  for (const auto node : setup_.dofs.nodes) {
    const Vector3d x = start.position(node);
    along.segment(setup_.dofs.dof(node, 0), d) +=
        (carried(obstacle, x, setup_.t_start, setup_.t) - x).head(d);
  }
  for (std::size_t p = 0; p < setup_.zone.points.size(); ++p) {
    EXPECT_LT(of(p, along).slip.norm(), 1e-15);
    const auto resting = of(p, setup_.u_start);
    const Vector3d x = position(setup_.zone.points[p], start);
    const Vector3d way = obstacle.way(x, x, setup_.t_start, setup_.t);
    for (int a = 0; a < resting.stencil.components - 1; ++a)
      EXPECT_NEAR(resting.slip[a], -way.dot(resting.tangents.col(a)), 1e-15);
  }
}

/// Half the chord of what is there at first and half that of what comes there: along the circle.
TEST(Turning, ComesAlongTheCircleUnderAPointThatStays) {
  auto disc = make_obstacle({.kind = ObstacleKind::cylinder, .direction = {0, 0, 1}, .radius = 2},
                            Physics::plane_strain, {});
  disc.rotation = constraint::Rotation{{}, Vector3d::UnitZ(), {.function = Function({0, 1}, {0, 1})}};
  const Vector3d top(0, 2, 0);
  for (const double angle : {0.1, 0.7}) {
    EXPECT_LT((disc.way(top, top, 0.1, 0.1 + angle) - Vector3d(-2 * std::sin(angle), 0, 0)).norm(), 1e-15);
    const Vector3d end = carried(disc, top, 0.1, 0.1 + angle);
    EXPECT_LT((disc.way(top, end, 0.1, 0.1 + angle) - (end - top)).norm(), 1e-15);
    EXPECT_EQ(place_on(disc, disc.pose(angle), top, top).gap, 0);
  }
  EXPECT_TRUE(disc.moves());
}

/// Normal, axis and centre go round, the line itself with what moves the obstacle.
TEST(Turning, TakesNormalsAxesAndCentresAlong) {
  auto plane = make_obstacle({.point = {1, 0, 0}, .direction = {0, 1, 0}}, Physics::solid, {});
  plane.move = {0, 0, 5};
  plane.rotation =
      constraint::Rotation{{}, Vector3d::UnitZ(), {.number = M_PI_2, .function = Function({0, 1}, {0, 1})}};
  const auto place =
      place_on(plane, plane.pose(1), {-3, 7, 5}, {-3, 7, 5}); // the plane is x = 0, body at x < 0
  EXPECT_NEAR(place.gap, 3, 1e-14);
  EXPECT_LT((place.normal - Vector3d(-1, 0, 0)).norm(), 1e-15);
  auto tube =
      make_obstacle({.kind = ObstacleKind::cylinder, .point = {2, 0, 0}, .direction = {1, 0, 0}, .radius = 1},
                    Physics::solid, {});
  tube.rotation = plane.rotation; // its axis becomes y
  EXPECT_NEAR(place_on(tube, tube.pose(1), {3, 9, 0}, {3, 9, 0}).gap, 2, 1e-14);
  auto ball =
      make_obstacle({.kind = ObstacleKind::sphere, .point = {2, 0, 0}, .radius = 1}, Physics::solid, {});
  ball.rotation = plane.rotation;
  EXPECT_NEAR(place_on(ball, ball.pose(1), {0, 4, 0}, {0, 4, 0}).gap, 1, 1e-14);
}

TEST_P(SlaveBefore, MeasuresTheSameInTheFrameItHolds) {
  for (std::size_t p = 0; p < setup_.zone.points.size(); ++p) {
    const auto k = of(p, setup_.u);
    auto held = with_frozen_frame(k);
    measure_in_frozen_frame(held, setup_.configuration(setup_.u));
    EXPECT_NEAR(held.gap, k.gap, 1e-15);
    EXPECT_LT((held.slip - k.slip).norm(), 1e-15);
    const VectorXd step = 0.01 * VectorXd::Random(setup_.u.size());
    double change = 0;
    for (Eigen::Index q = 0; q < held.unknowns(); ++q)
      change +=
          held.d_gap[q] *
          step[setup_.dofs.dof(held.stencil.nodes[static_cast<std::size_t>(q / held.stencil.components)],
                               static_cast<int>(q % held.stencil.components))];
    measure_in_frozen_frame(held, setup_.configuration(setup_.u + step));
    EXPECT_NEAR(held.gap, k.gap + change, 1e-15);
  }
}

INSTANTIATE_TEST_SUITE_P(A, SlaveBefore, testing::ValuesIn(test::every_obstacle()),
                         [](const auto& chosen) { return chosen.param.name; });

} // namespace
} // namespace rubato::contact::obstacle_test
