// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/slip.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "unit/contact/mortar/surfaces.hpp"
#include <numbers>

namespace rubato::slip_test {
namespace {

using namespace contact::mortar;
using test::Vector3d;

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

/// Two surfaces with a gap of 0.05, flat or curved.
test::TwoSurfaces apart(CellType slave, CellType master, double curvature) {
  const int dimension = cell::topology(slave).dimension;
  const auto map = [=](double low, double high, double height) {
    return [=](double s, double t) -> Vector3d {
      const double x = low + s * (high - low), y = low + t * (high - low);
      if (dimension == 1)
        return {x, height + curvature * x * x, 0};
      return {x, y, height + curvature * (x * x + 0.5 * y * y)};
    };
  };
  return test::two_surfaces({.type = slave, .along = 3, .across = 3}, map(0, 1, 0.05),
                            {.type = master, .along = 4, .across = 4}, map(-0.3, 1.1, 0));
}

/// Those of the end, turned back with the slave.
Eigen::Matrix<double, 3, 2> start_tangents(const Operators& end, const Operators& start, std::size_t node) {
  return turned(end.nodes[node].tangents, end.nodes[node].slave_frame, start.nodes[node].slave_frame);
}

using Case = std::array<CellType, 2>;
constexpr std::array cases{Case{CellType::seg2, CellType::seg3},   Case{CellType::seg3, CellType::seg2},
                           Case{CellType::quad4, CellType::quad4}, Case{CellType::tria3, CellType::quad4},
                           Case{CellType::quad8, CellType::tria6}, Case{CellType::quad9, CellType::quad8},
                           Case{CellType::tria7, CellType::quad9}, Case{CellType::tria6, CellType::tria3}};

TEST(Slip, OfARigidRotationIsZeroWhateverTheGap) {
  for (const auto& [slave, master] : cases)
    for (const double curvature : {0., 0.2})
      for (const double degrees : {1., 10., 60.}) {
        const auto two = apart(slave, master, curvature);
        const bool plane = cell::topology(slave).dimension == 1;
        const Vector3d axis = plane ? Vector3d(Vector3d::UnitZ()) : Vector3d(1, 2, 3).normalized();
        const Eigen::AngleAxisd turn(radians(degrees), axis);
        auto end = two.mesh.points;
        for (auto& x : end)
          x = turn * x;
        const auto before = two.operators(), after = two.operators_at(end);
        ASSERT_EQ(after.kept_count, before.kept_count);
        ASSERT_GT(after.kept_count, 0);
        for (std::size_t j = 0; j < after.nodes.size(); ++j)
          EXPECT_LE(slip(after.nodes[j], test::reading(end), start_tangents(after, before, j),
                         test::reading(two.mesh.points))
                        .norm(),
                    1e-14)
              << test::name_of(slave) << " on " << test::name_of(master) << " by " << degrees;
      }
}

TEST(Slip, OfASlaveThatSlidesIsItsMotionAlongTheTangents) {
  for (const auto& [slave, master] : cases) {
    const auto two = apart(slave, master, 0);
    const bool plane = cell::topology(slave).dimension == 1;
    const Vector3d moved(0.01, plane ? 0. : -0.02, 0);
    auto end = two.mesh.points;
    for (const auto node : two.slave.nodes)
      end[static_cast<std::size_t>(node)] += moved;
    const auto before = two.operators(), after = two.operators_at(end);
    for (std::size_t j = 0; j < after.nodes.size(); ++j) {
      const auto& node = after.nodes[j];
      const auto by =
          slip(node, test::reading(end), start_tangents(after, before, j), test::reading(two.mesh.points));
      EXPECT_LE((by - node.tangents.transpose() * moved).norm(), 1e-14);
    }
  }
}

TEST(Slip, BeforeAnObstacleThatMovesIsCountedFromItsMotion) {
  Node node;
  node.cover = Cover::kept;
  node.stencil.nodes = {0};
  node.stencil.weights = Eigen::VectorXd::Ones(1);
  node.tangents << Vector3d::UnitX(), Vector3d::UnitY();
  node.anchor = Vector3d(0.5, 0, 0);
  const std::vector<Vector3d> end{{0.5, 0.3, 0}}, start{{0.2, 0, 0}};
  const auto by = slip(node, test::reading(end), node.tangents, test::reading(start), {0.1, 0.3, 0});
  EXPECT_NEAR(by[0], 0.3 - 0.1, 1e-15);
  EXPECT_NEAR(by[1], 0, 1e-15);
}

} // namespace
} // namespace rubato::slip_test
