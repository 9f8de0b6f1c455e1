// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/facets.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/bulk_cells.hpp"
#include "support/patch_mesh.hpp"
#include <numbers>

namespace rubato::plot::facets_test {
namespace {

using Eigen::Vector3d;

Vector3d area_of(const std::vector<Vector3d>& outline) {
  Vector3d area = Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < outline.size(); ++i)
    area += (outline[i] - outline[0]).cross(outline[i + 1] - outline[0]) / 2;
  return area;
}

std::vector<double> values_of(const mesh::Mesh& mesh, double (*value)(const Vector3d&)) {
  std::vector<double> values;
  for (const auto& point : mesh.points)
    values.push_back(value(point));
  return values;
}

class FacetsOfACell : public testing::TestWithParam<test::BulkCase> {};

TEST_P(FacetsOfACell, CoverTheSurfaceAndTurnOutward) {
  const auto type = GetParam().type;
  const bool solid = cell::topology(type).dimension == 3;
  const auto mesh = test::patch_mesh(type, 2, [](const Vector3d& x) { return x; });
  const auto found =
      facets(mesh, mesh.points, values_of(mesh, [](const Vector3d& x) { return x.x() + 2 * x.y(); }));
  double patches = 0;
  double outlines = 0;
  for (const auto& facet : found) {
    outlines += area_of(facet.outline).norm();
    const Vector3d from_centre = facet.outline.front() - Vector3d::Constant(0.5);
    if (solid) {
      EXPECT_GT(area_of(facet.outline).dot(from_centre), 0);
    }
    for (const auto& patch : facet.patches) {
      patches += area_of(patch.corners).norm();
      Vector3d centre = Vector3d::Zero();
      for (const auto& corner : patch.corners)
        centre += corner / static_cast<double>(patch.corners.size());
      EXPECT_NEAR(patch.value, centre.x() + 2 * centre.y(), 1e-12) << "a linear field";
    }
  }
  EXPECT_NEAR(patches, solid ? 6 : 1, 1e-12);
  EXPECT_NEAR(outlines, solid ? 6 : 1, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(OfEveryType, FacetsOfACell, testing::ValuesIn(test::every_bulk_case()),
                         [](const auto& entry) { return test::name_of(entry.param); });

TEST(Facets, OfCurvedSidesAreCurved) {
  // A quarter of a disc: the middle nodes of the outer edges on the circle.
  auto mesh = test::patch_mesh(CellType::tria6, 1, [](const Vector3d& x) { return x; });
  for (auto& point : mesh.points)
    if (std::abs(point.x() + point.y() - 1) < 1e-12 && point.x() > 0 && point.y() > 0)
      point *= 1.1;
  const auto lines = border_lines(mesh, mesh.points);
  EXPECT_EQ(lines.size(), 4U);
  double length = 0;
  for (const auto& line : lines) {
    EXPECT_EQ(line.size(), 5U);
    for (std::size_t i = 1; i < line.size(); ++i)
      length += (line[i] - line[i - 1]).norm();
  }
  EXPECT_NEAR(length, 4, 1e-12) << "the diagonal is inside";
}

TEST(Facets, OfLargeMeshesAreFewEnoughForAFile) {
  const auto mesh = test::patch_mesh(CellType::quad4, 100, [](const Vector3d& x) { return x; });
  const auto found = facets(mesh, mesh.points, std::vector<double>(mesh.points.size(), 1.0));
  std::size_t patches = 0;
  for (const auto& facet : found)
    patches += facet.patches.size();
  EXPECT_EQ(found.size(), 10'000U);
  EXPECT_LE(patches, 20'000U);
}

} // namespace
} // namespace rubato::plot::facets_test
