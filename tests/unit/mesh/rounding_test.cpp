// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/rounding.hpp"

#include <gtest/gtest.h>

#include "bodies.hpp"
#include <cmath>
#include <limits>

namespace rubato::mesh::rounding_test {
namespace {

/// A plane body as meshers write it: three coordinates, z constant but for noise.
Mesh in_space(double z, double noise) {
  auto mesh = test::mesh_of(CellType::quad8);
  mesh.dimension = 3;
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    mesh.points[i].z() = z + noise * std::cos(static_cast<double>(i));
  return mesh;
}

TEST(PlaneMesh, WithThreeCoordinatesIsLaidFlat) {
  const auto plane = test::mesh_of(CellType::quad8);
  for (const double scale : {1e-3, 1.0, 1e4})
    for (const auto& [z, noise] : {std::pair{0.0, 0.0}, {12.5, 0.0}, {-3.0, 1e-13}, {0.0, 1e-11}}) {
      auto mesh = in_space(z, noise);
      for (auto& point : mesh.points)
        point *= scale;
      EXPECT_TRUE(lay_flat(mesh));
      EXPECT_EQ(mesh.dimension, 2);
      for (std::size_t i = 0; i < mesh.points.size(); ++i)
        EXPECT_EQ(mesh.points[i], (plane.points[i] * scale).eval());
    }
}

TEST(PlaneMesh, IsNotMadeOfWhatIsNone) {
  auto bent = in_space(0, 0);
  bent.points[3].z() = 1e-3;
  EXPECT_FALSE(lay_flat(bent));
  auto solid = test::mesh_of(CellType::hexa8);
  EXPECT_FALSE(lay_flat(solid));
  auto nowhere = in_space(0, 0);
  nowhere.points[3].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(lay_flat(nowhere));
  Mesh empty;
  EXPECT_FALSE(lay_flat(empty));
}

TEST(Axis, TakesNodesThatAreOffItByRoundingAlone) {
  auto mesh = test::mesh_of(CellType::quad4);
  const double size = diagonal(mesh);
  mesh.points[0].x() = -1.2e-15 * size;
  mesh.points[1].x() = 1.2e-15 * size;
  mesh.points[2].x() = -1e-6 * size;
  const auto elsewhere = mesh.points[3];
  snap_to_axis(mesh);
  EXPECT_EQ(mesh.points[0].x(), 0.0);
  EXPECT_EQ(mesh.points[1].x(), 0.0);
  EXPECT_EQ(mesh.points[2].x(), -1e-6 * size);
  EXPECT_EQ(mesh.points[3], elsewhere);
}

} // namespace
} // namespace rubato::mesh::rounding_test
