// SPDX-License-Identifier: LGPL-3.0-or-later
// How far slave faces look for their masters in a step.
#include "rubato/contact/mortar/reach.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <vector>

namespace rubato::contact::mortar::reach_test {
namespace {

using Eigen::Vector3d;

/// A row of segments from x = 0 to `length`, that looks down or up.
Surface row(mesh::Mesh& mesh, int parts, double length, double y, bool down) {
  const auto first = static_cast<mesh::NodeIndex>(mesh.points.size());
  for (int i = 0; i <= parts; ++i)
    mesh.points.emplace_back(length * i / parts, y, 0);
  std::vector<Face> faces;
  for (mesh::NodeIndex i = first; i < first + parts; ++i) {
    Face face;
    face.type = CellType::seg2;
    face.node_count = 2;
    face.nodes = {down ? i : i + 1, down ? i + 1 : i};
    faces.push_back(face);
  }
  return make_surface(mesh, faces);
}

std::vector<Vector3d> places(const mesh::Mesh& mesh, const Surface& surface,
                             const Vector3d& moved = {0, 0, 0}) {
  std::vector<Vector3d> x;
  for (const auto node : surface.nodes)
    x.push_back(mesh.points[static_cast<std::size_t>(node)] + moved);
  return x;
}

class ReachOfTwoRows : public testing::Test {
protected:
  std::vector<double> reach(const Vector3d& start, const Vector3d& slave_way, const Vector3d& master_way,
                            double Reach::*which = &Reach::ahead) {
    ReachInStep reach;
    reach.begin(slave_, master_, places(mesh_, slave_, start), places(mesh_, master_), 0.25);
    const auto at = reach.at(places(mesh_, slave_, start + slave_way), places(mesh_, master_, master_way));
    std::vector<double> reaches;
    std::ranges::transform(at, std::back_inserter(reaches), which);
    return reaches;
  }

  mesh::Mesh mesh_;
  Surface slave_ = row(mesh_, 4, 1, 0, true), master_ = row(mesh_, 3, 1, 0, false);
};

TEST_F(ReachOfTwoRows, IsTheLongestFaceAtRest) {
  EXPECT_EQ(reach({0, 0.1, 0}, {0, 0, 0}, {0, 0, 0}), std::vector<double>(4, 0.25));
  EXPECT_EQ(reach({0, 5, 0}, {0, 0, 0}, {0, 0, 0}), std::vector<double>(4, 0.25));
}

TEST_F(ReachOfTwoRows, GrowsByTheirRelativeMotionOnly) {
  for (const double r : reach({0, 5, 0}, {0, -6, 0}, {0, 0, 0}))
    EXPECT_NEAR(r, 6.25, 1e-14);
  for (const double r : reach({0, 5, 0}, {0, -6, 0}, {0, -6, 0}))
    EXPECT_NEAR(r, 0.25, 1e-14);
  for (const double r : reach({0, 5, 0}, {0, 0, 0}, {0, 6, 0}))
    EXPECT_NEAR(r, 6.25, 1e-14);
}

TEST_F(ReachOfTwoRows, SeesTheMasterFromBehind) {
  for (const double r : reach({0, -0.8, 0}, {0, 0, 0}, {0, 0, 0}))
    EXPECT_GE(r, 0.8 + 0.25);
  for (const double r : reach({0, -0.8, 0}, {0, 0, 0}, {0, 0, 0}, &Reach::behind))
    EXPECT_GE(r, 0.8);
}

TEST_F(ReachOfTwoRows, GoesNoDeeperThanTheSagOfFacetsBehindAMasterThatIsAhead) {
  for (const double r : reach({0, 0.1, 0}, {0, 0, 0}, {0, 0, 0}, &Reach::behind))
    EXPECT_NEAR(r, 0.25 / 3, 1e-15);
  for (const double r : reach({0, 0.1, 0}, {0, -0.4, 0}, {0, 0, 0}, &Reach::behind))
    EXPECT_NEAR(r, 0.4 + 0.25 / 3, 1e-15);
}

} // namespace
} // namespace rubato::contact::mortar::reach_test
