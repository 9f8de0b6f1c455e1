// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/integration.hpp"
#include "rubato/contact/projection.hpp"

#include <gtest/gtest.h>

#include "two_faces.hpp"

namespace rubato::projection_test {
namespace {

using contact::FaceCoordinates;
using Eigen::Vector2d;
using Eigen::Vector3d;

FaceCoordinates flat(CellType type, double size) {
  const auto& cell = cell::reference_cell(type);
  FaceCoordinates nodes(3, cell.node_count);
  for (int i = 0; i < cell.node_count; ++i)
    nodes.col(i) = size * cell.nodes[static_cast<std::size_t>(i)];
  return nodes;
}

class EveryFace : public testing::TestWithParam<CellType> {};

TEST_P(EveryFace, ProjectsOrthogonallyOnItself) {
  const auto nodes = flat(GetParam(), 3.0);
  const bool segment = cell::topology(GetParam()).dimension == 1;
  const Vector3d point(0.6, segment ? -2.0 : 0.9, segment ? 0.0 : 5.0);
  const auto projection = contact::project(GetParam(), nodes, point);
  EXPECT_TRUE(projection.converged);
  EXPECT_TRUE(projection.inside());
  EXPECT_NEAR(projection.xi[0], 0.2, 1e-14);
  if (!segment) {
    EXPECT_NEAR(projection.xi[1], 0.3, 1e-14);
  }
}

TEST_P(EveryFace, ClampsToTheReferenceCell) {
  const auto nodes = flat(GetParam(), 1.0);
  const auto projection = contact::project(GetParam(), nodes, Vector3d(1.25, 0, 0.1));
  EXPECT_NEAR(projection.overshoot, 0.25, 1e-13);
  EXPECT_NEAR(projection.clamped[0], 1.0, 1e-13);
  EXPECT_NEAR(projection.clamp_derivative(0, 0), 0.0, 1e-14);
}

TEST_P(EveryFace, DistanceIsStationaryOnWarpedFaces) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    test::TwoFacesOptions options;
    options.master = options.slave = GetParam();
    options.seed = seed;
    const auto setup = test::two_faces(options);
    const auto configuration = setup.configuration(setup.u);
    const auto nodes = contact::deformed(setup.zone.master.faces.front(), configuration);
    const Vector3d point =
        nodes.rowwise().mean() + Vector3d(0.1, 0.1, cell::topology(GetParam()).dimension == 1 ? 0 : 0.2);
    const auto projection = contact::project(GetParam(), nodes, point);
    ASSERT_TRUE(projection.converged);
    const auto at = contact::face_geometry(GetParam(), nodes, projection.xi);
    for (int a = 0; a < cell::topology(GetParam()).dimension; ++a)
      EXPECT_NEAR(at.tangents.col(a).dot(point - at.position), 0, 1e-13);
  }
}

TEST_P(EveryFace, NodalWeightsAddUpToTheFace) {
  double sum = 0;
  for (const auto& point : contact::nodal_rule(GetParam()))
    sum += point.weight;
  const auto corners = cell::topology(GetParam()).corner_count;
  EXPECT_NEAR(sum, corners == 2 ? 2.0 : corners == 3 ? 0.5 : 4.0, 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Faces, EveryFace,
                         testing::Values(CellType::seg2, CellType::seg3, CellType::tria3, CellType::tria6,
                                         CellType::tria7, CellType::quad4, CellType::quad8, CellType::quad9),
                         [](const auto& face) { return std::string(cell::topology(face.param).name); });

TEST(TriangleClamp, GoesToTheNearestEdgeInTheParametricPlane) {
  contact::Projection p;
  p.xi = Vector2d(0.8, 0.8);
  contact::clamp_to_face(CellType::tria3, p);
  EXPECT_NEAR(p.clamped[0], 0.5, 1e-15);
  EXPECT_NEAR(p.clamped[1], 0.5, 1e-15);
  EXPECT_NEAR(p.overshoot, 0.3 * std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(p.clamp_derivative(0, 0), 0.5, 1e-15);
  EXPECT_NEAR(p.clamp_derivative(0, 1), -0.5, 1e-15);
}

TEST(TriangleClamp, GoesToACornerWhenBothEdgesEnd) {
  contact::Projection p;
  p.xi = Vector2d(-0.2, -0.3);
  contact::clamp_to_face(CellType::tria3, p);
  EXPECT_EQ(p.clamped.norm(), 0.0);
  EXPECT_EQ(p.clamp_derivative.norm(), 0.0);
}

TEST(BoxClamp, RoundingCountsAsInside) {
  contact::Projection p;
  p.xi = Vector2d(1 + 1e-13, 0.2);
  contact::clamp_to_face(CellType::quad4, p);
  EXPECT_TRUE(p.inside());
}

} // namespace
} // namespace rubato::projection_test
