// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/frames.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "unit/contact/mortar/surfaces.hpp"
#include <numbers>

namespace rubato::frames_test {
namespace {

using namespace contact::mortar;
using test::Vector3d;

/// A sheet along y that is folded at x = 1/2 by that angle, two faces along x; it looks up.
test::TwoSurfaces folded(CellType type, double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  const auto map = [=](double s, double t) -> Vector3d {
    const double beyond = std::max(0., s - 0.5), x = std::min(s, 0.5) + beyond * std::cos(angle);
    const double down = -beyond * std::sin(angle);
    return cell::topology(type).dimension == 1 ? Vector3d(x, down, 0) : Vector3d(x, t, down);
  };
  return test::two_surfaces({.type = type}, map, {.type = type, .along = 2, .across = 2}, map);
}

TEST(NodalNormals, AreTheMeanOfTheUnitNormalsOfTheFaces) {
  for (const auto type :
       {CellType::seg2, CellType::seg3, CellType::quad4, CellType::quad8, CellType::quad9}) {
    const auto two = folded(type, 40);
    const auto x = two.master_x();
    std::vector<Vector3d> normals;
    nodal_normals(two.master, x, {}, normals);
    const int up = cell::topology(type).dimension;
    for (std::size_t j = 0; j < x.size(); ++j) {
      const double degrees = std::abs(x[j][0] - 0.5) < 1e-9 ? 20 : x[j][0] < 0.5 ? 0 : 40;
      Vector3d expected = std::sin(degrees * std::numbers::pi / 180) * Vector3d::UnitX();
      expected[up] = std::cos(degrees * std::numbers::pi / 180);
      EXPECT_LE((normals[j] - expected).norm(), 1e-14) << test::name_of(type);
    }
  }
}

TEST(NodalNormals, LoseAHeldComponentWhereThatTurnsThemLittle) {
  for (const double degrees : {40., 80.}) { // turned by half of it
    const auto two = folded(CellType::quad4, degrees);
    std::vector<Vector3d> normals, symmetric;
    const std::vector<HeldComponents> held(two.master.nodes.size(), 1);
    nodal_normals(two.master, two.master_x(), {}, normals);
    nodal_normals(two.master, two.master_x(), held, symmetric);
    for (std::size_t j = 0; j < normals.size(); ++j)
      EXPECT_EQ(symmetric[j], normals[j][0] < 0.5 ? Vector3d(0, 0, 1) : normals[j]);
  }
}

TEST(NodalNormals, OfFacesWithoutAreaAreZero) {
  const auto two = folded(CellType::quad4, 0);
  auto x = two.master_x();
  for (auto& place : x)
    place[1] = 0;
  std::vector<Vector3d> normals;
  nodal_normals(two.master, x, {}, normals);
  for (const auto& normal : normals)
    EXPECT_TRUE(normal.isZero(0));
}

TEST(Frames, AreRightHandedAndLeaveTheMaster) {
  const auto frame = frame_of(Vector3d(0, 0, -1), Vector3d(2, 0, 5), 3);
  EXPECT_EQ(frame.normal, Vector3d(0, 0, 1));
  EXPECT_EQ(Vector3d(frame.tangents.col(0)), Vector3d(1, 0, 0));
  EXPECT_EQ(Vector3d(frame.tangents.col(1)), Vector3d(0, 1, 0));
  const auto plane = frame_of(Vector3d(0.6, -0.8, 0), Vector3d(1, 0, 0), 2);
  EXPECT_EQ(Vector3d(plane.tangents.col(0)), Vector3d(-0.8, -0.6, 0));
  EXPECT_LE((Vector3d(plane.tangents.col(1)) - Vector3d::UnitZ()).norm(), 1e-15);
}

TEST(Frames, AreOrthonormalWhereTheNeighbourIsAlongTheNormal) {
  const auto frame = frame_of(Vector3d(0, 0, -1), Vector3d(0, 0, 5), 3);
  EXPECT_LE((frame.tangents.transpose() * frame.tangents - Eigen::Matrix2d::Identity()).norm(), 1e-15);
  EXPECT_LE((frame.tangents.transpose() * frame.normal).norm(), 1e-15);
}

TEST(Frames, HaveANeighbourAlongAnEdge) {
  for (const auto type : test::solid_types) {
    mesh::Mesh mesh;
    const auto surface = contact::make_surface(
        mesh, test::add_grid(mesh, {.type = type}, [](double s, double t) { return Vector3d(s, t, 0); }));
    const auto neighbours = tangent_neighbours(surface);
    for (std::size_t j = 0; j < neighbours.size(); ++j) {
      const auto k = static_cast<std::size_t>(neighbours[j]);
      EXPECT_NE(j, k);
      const double length = (mesh.points[j] - mesh.points[k]).norm();
      EXPECT_LE(length, cell::topology(type).order == 2 ? 0.75 : 1.5) << test::name_of(type) << " node " << j;
    }
  }
}

TEST(SharpEdges, AreFoundAboveSixtyDegrees) {
  for (const auto type :
       {CellType::seg2, CellType::seg3, CellType::quad4, CellType::quad8, CellType::quad9}) {
    const auto gentle = folded(type, 59), sharp = folded(type, 61);
    EXPECT_FALSE(first_sharp_edge(gentle.master, gentle.master_x()).has_value());
    const auto found = first_sharp_edge(sharp.master, sharp.master_x());
    ASSERT_TRUE(found.has_value()) << test::name_of(type);
    // Segments are listed from s = 0 on, faces row by row.
    EXPECT_EQ(*found, std::pair(0, 1)) << test::name_of(type);
  }
}

} // namespace
} // namespace rubato::frames_test
