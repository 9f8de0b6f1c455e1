// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/obstacle_mortar.hpp"

#include <gtest/gtest.h>

#include "unit/contact/mortar/surfaces.hpp"

namespace rubato::obstacle_mortar_test {
namespace {

using namespace contact::mortar;
using test::Vector3d;

test::TwoSurfaces slave_at(CellType type, double height) {
  const auto map = [=](double s, double t) -> Vector3d {
    return cell::topology(type).dimension == 1 ? Vector3d(s, height, 0) : Vector3d(s, t, height);
  };
  return test::two_surfaces({.type = type, .along = 3, .across = 2}, map, {.type = type}, map);
}

Operators before(const test::TwoSurfaces& two, const contact::Obstacle& obstacle, const Options& options = {},
                 const contact::Pose& pose = {}) {
  Workspace workspace;
  Operators operators;
  integrate(two.slave, two.reference(), obstacle, pose, two.slave_x(), options, workspace, operators);
  return operators;
}

contact::Obstacle plane_for(CellType type) {
  return {.kind = study::ObstacleKind::plane,
          .direction = Vector3d::Unit(cell::topology(type).dimension),
          .move = {},
          .functions = {}};
}

TEST(MortarBeforeAnObstacle, SeesTheDistanceOfAPlaneAndHandsOnAUniformPressure) {
  for (const auto type : {CellType::seg2, CellType::seg3, CellType::tria3, CellType::tria6, CellType::tria7,
                          CellType::quad4, CellType::quad8, CellType::quad9}) {
    const auto two = slave_at(type, 0.05);
    const auto operators = before(two, plane_for(type));
    const auto forces = test::forces_of_unit_pressure(two, operators);
    const auto expected = test::integrals_of_shapes(two.mesh, two.slave);
    for (const auto node : two.slave.nodes)
      EXPECT_NEAR(forces[static_cast<std::size_t>(node)], expected[static_cast<std::size_t>(node)], 1e-14);
    for (const auto& node : operators.nodes) {
      ASSERT_TRUE(node.kept());
      EXPECT_NEAR(node.gap, 0.05, 1e-15);
      EXPECT_NEAR(node.stencil.weights.sum(), 1, 1e-13);
      EXPECT_NEAR(gap_vector(node, test::reading(two.mesh.points)).dot(node.normal), 0.05, 1e-14);
      EXPECT_LE((node.normal - plane_for(type).direction).norm(), 1e-15);
    }
  }
}

TEST(MortarBeforeAnObstacle, MovesWithIt) {
  const auto operators =
      before(slave_at(CellType::quad4, 0.05), plane_for(CellType::quad4), {}, {.offset = {0, 0, 0.02}});
  for (const auto& node : operators.nodes)
    EXPECT_NEAR(node.gap, 0.03, 1e-15);
}

TEST(MortarBeforeAnObstacle, IsCoveredWithinReachOnly) {
  contact::Obstacle sphere{.kind = study::ObstacleKind::sphere,
                           .point = Vector3d(0, 0, -1),
                           .radius = 1,
                           .move = {},
                           .functions = {}};
  const auto two = slave_at(CellType::quad4, 0);
  const auto operators = before(two, sphere, {.reach = 0.1});
  // A quarter of the circle where √(r² + 1) − 1 < 0.1; whole Gauss points count.
  EXPECT_NEAR(operators.covered_area, 0.165, 0.05);
}

TEST(MortarBeforeAnObstacle, HasItsBackFree) {
  auto plane = plane_for(CellType::quad4);
  plane.direction = -plane.direction;
  EXPECT_EQ(before(slave_at(CellType::quad4, 0.05), plane).covered_area, 0);
}

TEST(MortarBeforeAnObstacle, HasAGapWhoseSlopeIsTheRowToSecondOrderInTheFace) {
  // dg/du_i = Σ_q w_q Φ n_q N_i / w against n_j D_ji / w_j, on faces half as long.
  std::vector<double> errors;
  for (const int faces : {4, 8}) {
    const contact::Obstacle sphere{.kind = study::ObstacleKind::sphere,
                                   .point = Vector3d(0.5, 0.5, -4),
                                   .radius = 4,
                                   .move = {},
                                   .functions = {}};
    const auto map = [](double s, double t) { return Vector3d(s, t, 0.01); };
    auto two = test::two_surfaces({.type = CellType::quad4, .along = faces, .across = faces}, map,
                                  {.type = CellType::quad4}, map);
    const auto operators = before(two, sphere);
    const auto reference = two.reference();
    double error = 0;
    for (const std::size_t moved : {std::size_t{0}, two.slave.nodes.size() / 2})
      for (int c = 0; c < 3; ++c) {
        const double h = 1e-6;
        std::array<Operators, 2> sides;
        for (const std::size_t side : {0U, 1U}) {
          auto x = two.slave_x();
          x[moved][c] += side == 0 ? -h : h;
          Workspace workspace;
          integrate(two.slave, reference, sphere, {}, x, {}, workspace, sides[side]);
        }
        for (std::size_t j = 0; j < operators.nodes.size(); ++j) {
          const auto& node = operators.nodes[j];
          double row = 0;
          for (std::size_t i = 0; i < node.stencil.nodes.size(); ++i)
            if (node.stencil.nodes[i] == two.slave.nodes[moved])
              row = node.stencil.weights[static_cast<Eigen::Index>(i)] * node.normal[c];
          error = std::max(error, std::abs((sides[1].nodes[j].gap - sides[0].nodes[j].gap) / (2 * h) - row));
        }
      }
    errors.push_back(error);
  }
  EXPECT_LT(errors[0], 0.02);
  EXPECT_LT(errors[1], 0.6 * errors[0]);
}

} // namespace
} // namespace rubato::obstacle_mortar_test
