// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/surface_normals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace rubato::model::surface_normals_test {
namespace {

using Eigen::Vector3d;

/// Triangles or quadrangles between places of a sphere, oriented outward.
struct Sphere {
  mesh::Mesh mesh;
  contact::Surface surface;
};

/// `rows` of `around` faces each between two circles of latitude, nodes moved by up to `uneven` of a face.
Sphere sphere_band(int rows, int around, bool triangles, double radius, double uneven = 0.3) {
  Sphere sphere;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-uneven, uneven);
  for (int i = 0; i <= rows; ++i)
    for (int j = 0; j < around; ++j) {
      const double up = -0.8 + 1.6 * (i + shift(random)) / rows;
      const double angle = 2 * std::numbers::pi * (j + shift(random)) / around;
      sphere.mesh.points.push_back(
          radius * Vector3d(std::cos(up) * std::cos(angle), std::cos(up) * std::sin(angle), std::sin(up)));
    }
  std::vector<contact::Face> faces;
  const auto add = [&](std::vector<mesh::NodeIndex> nodes) {
    contact::Face face;
    face.type = nodes.size() == 3 ? CellType::tria3 : CellType::quad4;
    face.node_count = static_cast<int>(nodes.size());
    std::ranges::copy(nodes, face.nodes.begin());
    faces.push_back(face);
  };
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < around; ++j) {
      const int a = i * around + j, b = i * around + (j + 1) % around;
      if (triangles) {
        add({a, b, b + around});
        add({a, b + around, a + around});
      } else {
        add({a, b, b + around, a + around});
      }
    }
  sphere.surface = contact::make_surface(sphere.mesh, faces);
  return sphere;
}

/// N. Max, 1999: exact however the nodes are spaced, on triangles; a rim has one side only.
TEST(AveragedNormals, AreTheRadiiOfASphere) {
  const auto sphere = sphere_band(6, 9, true, 3);
  const auto normals = averaged_normals(sphere.surface, face_corners(sphere.mesh, sphere.surface));
  const auto rim = rim_of(sphere.surface);
  int inner = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    EXPECT_NEAR(normals[i].norm(), 1, 1e-14);
    if (rim[i] != 0)
      continue;
    ++inner;
    const auto& place = sphere.mesh.points[static_cast<std::size_t>(sphere.surface.nodes[i])];
    EXPECT_LT((normals[i] - place / 3).norm(), 1e-13) << i;
  }
  EXPECT_EQ(inner, 5 * 9);
}

TEST(RimOfASurface, IsWhereItEnds) {
  for (const bool triangles : {true, false}) {
    const auto rim = rim_of(sphere_band(4, 7, triangles, 1).surface);
    EXPECT_EQ(std::ranges::count(rim, 1), 2 * 7);
  }
}

/// Segments between unevenly spaced places of a circle.
TEST(AveragedNormals, AreTheRadiiOfACircle) {
  mesh::Mesh mesh;
  mesh.dimension = 2;
  std::vector<contact::Face> faces;
  constexpr int count = 11;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.4 * std::sin(5. * i)) / count;
    mesh.points.emplace_back(2 * std::cos(angle), 2 * std::sin(angle), 0);
  }
  for (int i = 0; i + 1 < count; ++i) { // one is left out: the line has two ends
    contact::Face face;
    face.node_count = 2;
    face.nodes = {i, i + 1};
    faces.push_back(face);
  }
  const auto surface = contact::make_surface(mesh, faces);
  const auto corners = face_corners(mesh, surface);
  const auto normals = averaged_normals(surface, corners);
  const auto rim = rim_of(surface);
  EXPECT_EQ(std::ranges::count(rim, 1), 2);
  for (std::size_t i = 1; i + 1 < normals.size(); ++i)
    EXPECT_LT((normals[i] - mesh.points[i] / 2).norm(), 1e-14) << i;
  double length = 0, perimeter = 0;
  for (const auto& corner : corners)
    length += corner.area;
  for (std::size_t i = 0; i + 1 < count; ++i)
    perimeter += (mesh.points[i + 1] - mesh.points[i]).norm();
  EXPECT_NEAR(length, perimeter, 1e-13);
}

TEST(FaceCorners, ShareTheAreaOfTheirFaces) {
  for (const bool triangles : {true, false}) {
    const auto sphere = sphere_band(20, 40, triangles, 1, 0.1);
    double area = 0;
    for (const auto& corner : face_corners(sphere.mesh, sphere.surface)) {
      area += corner.area;
      const auto& place = sphere.mesh.points[static_cast<std::size_t>(
          sphere.surface.nodes[static_cast<std::size_t>(corner.position)])];
      EXPECT_GT(corner.normal.dot(place), 0.8) << "out of the ball";
    }
    EXPECT_NEAR(area, 4 * std::numbers::pi * std::sin(0.8), 0.05) << "but for its facets and uneven rims";
  }
}

} // namespace
} // namespace rubato::model::surface_normals_test
