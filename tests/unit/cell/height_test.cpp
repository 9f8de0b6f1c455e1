// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/height.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace rubato::cell::height_test {
namespace {

using Eigen::Vector3d;

const std::vector<Vector3d> box{{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0},
                                {0, 0, 5}, {3, 0, 5}, {3, 2, 5}, {0, 2, 5}};

TEST(LeastHeight, IsTheLeastSideOfABoxHoweverItStands) {
  EXPECT_NEAR(least_height(CellType::hexa8, box), 2, 1e-14);
  auto turned = box;
  const Eigen::AngleAxisd turn(0.7, Vector3d(1, 2, 3).normalized());
  for (auto& x : turned)
    x = turn * x + Vector3d(7, -3, 1);
  EXPECT_NEAR(least_height(CellType::hexa8, turned), 2, 1e-13);
}

TEST(LeastHeight, IsTheHeightOfASlantedQuadrangle) {
  const std::vector<Vector3d> slanted{{0, 0, 0}, {2, 0, 0}, {5, 1, 0}, {3, 1, 0}};
  EXPECT_NEAR(least_height(CellType::quad4, slanted), 2 / std::sqrt(10.0), 1e-14);
  const std::vector<Vector3d> flat{{0, 0, 0}, {2.5, 0, 0}, {2.5, 0.4, 0}, {0, 0.4, 0}};
  EXPECT_NEAR(least_height(CellType::quad8, flat), 0.4, 1e-14);
}

TEST(LeastHeight, IsAPartOfTheHeightOfSimplices) {
  const std::vector<Vector3d> triangle{{0, 0, 0}, {4, 0, 0}, {1, 1, 0}};
  EXPECT_NEAR(least_height(CellType::tria3, triangle), 0.5, 1e-14);
  const std::vector<Vector3d> tetrahedron{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 1}};
  EXPECT_NEAR(least_height(CellType::tetra4, tetrahedron), 16.0 / 6 / std::sqrt(72.0), 1e-14);
  const std::vector<Vector3d> prism{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 1}, {4, 0, 1}, {0, 4, 1}};
  EXPECT_NEAR(least_height(CellType::penta6, prism), 1, 1e-14);
}

TEST(LeastHeight, IsNegativeInsideOut) {
  auto mirrored = box;
  for (auto& x : mirrored)
    x[2] = -x[2];
  EXPECT_NEAR(least_height(CellType::hexa8, mirrored), -2, 1e-14);
  const std::vector<Vector3d> clockwise{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}};
  EXPECT_NEAR(least_height(CellType::quad4, clockwise), -1, 1e-14);
}

} // namespace
} // namespace rubato::cell::height_test
