// SPDX-License-Identifier: LGPL-3.0-or-later
// Frames that a loop holds: gap and slip follow the bodies, place, normal and tangents don't.
#include "rubato/contact/discretisation.hpp"
#include "rubato/contact/frozen_frame.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "unit/contact/two_faces.hpp"
#include <cmath>
#include <string>
#include <vector>

namespace rubato::contact::frozen_frame_test {
namespace {

using Eigen::VectorXd;
using test::two_faces;
using test::TwoFaces;

struct Pairing {
  std::string name;
  test::TwoFacesOptions options;
};

class FrozenFrame : public testing::TestWithParam<Pairing> {
protected:
  std::vector<Kinematics> paired_points() const {
    std::vector<Kinematics> points;
    for (auto& point : evaluate(faces_.zone, VectorXd::Zero(faces_.zone.multiplier_count()),
                                faces_.configuration(faces_.u)))
      if (point.kinematics)
        points.push_back(*point.kinematics);
    return points;
  }

  TwoFaces faces_ = two_faces(GetParam().options);
};

TEST_P(FrozenFrame, MeasuresWhereItWasTakenWhatItWasTakenFrom) {
  ASSERT_FALSE(paired_points().empty());
  for (const auto& k : paired_points()) {
    auto held = with_frozen_frame(k);
    measure_in_frozen_frame(held, faces_.configuration(faces_.u));
    EXPECT_NEAR(held.gap, k.gap, 1e-14);
    EXPECT_LT((held.slip - k.slip).norm(), 1e-14);
    EXPECT_EQ(held.normal, k.normal);
    EXPECT_EQ(held.tangents, k.tangents);
  }
}

/// Gap and slip are linear in the motion: derivatives tell any difference, however large. Also where the gap
/// has weights of its own.
TEST_P(FrozenFrame, FollowsTheBodiesAsItsDerivativesSay) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> move(-1, 1);
  const VectorXd away = VectorXd::NullaryExpr(faces_.dofs.dof_count, [&] { return move(random); });
  const VectorXd there = faces_.u + away;
  auto points = paired_points();
  for (auto k : paired_points()) {
    k.gap_weights = k.stencil.weights.unaryExpr([&](double weight) { return weight + move(random); });
    const auto place = [&](auto node) { return faces_.configuration(faces_.u).position(node); };
    k.gap_origin = k.normal.dot(k.gap_vector(place)) - k.gap;
    points.push_back(k);
  }
  for (const auto& k : points) {
    const auto held = with_frozen_frame(k);
    auto now = held;
    measure_in_frozen_frame(now, faces_.configuration(faces_.u));
    EXPECT_NEAR(now.gap, held.gap, k.gap_weights.size() > 0 ? 1e-13 : 1e-14);
    measure_in_frozen_frame(now, faces_.configuration(there));
    VectorXd local(held.unknowns());
    for (std::size_t node = 0; node < held.stencil.nodes.size(); ++node)
      for (int i = 0; i < held.stencil.components; ++i)
        local[static_cast<Eigen::Index>(node) * held.stencil.components + i] =
            away[faces_.dofs.dof(held.stencil.nodes[node], i)];
    EXPECT_NEAR(now.gap - held.gap, held.d_gap.dot(local), 1e-13);
    EXPECT_LT((now.slip - held.slip - held.d_slip * local).norm(), 1e-13);
  }
}

TEST_P(FrozenFrame, IsHeldOnItsWayToo) {
  for (const auto& k : paired_points()) {
    const auto held = with_frozen_frame(k);
    EXPECT_TRUE(held.d_normal.isZero(0));
    EXPECT_TRUE(held.d_projection.isZero(0));
    EXPECT_TRUE(held.shape_slope.isZero(0));
  }
}

/// Of two faces that claim a point in turn.
TEST_P(FrozenFrame, BetweenTwoIsOrthonormalAndMeasuresTheirMean) {
  const auto points = paired_points();
  ASSERT_GE(points.size(), 2U);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto &a = points[i - 1], &b = points[i];
    auto between = frozen_between(a, b);
    Eigen::Matrix3d frame;
    frame << between.tangents, between.normal;
    EXPECT_LT((frame.transpose() * frame - Eigen::Matrix3d::Identity()).norm(), 1e-14);
    EXPECT_NEAR(between.normal.dot(a.normal), between.normal.dot(b.normal), 1e-14);
    EXPECT_EQ(between.gap, 0.5 * (a.gap + b.gap));
    EXPECT_EQ(between.stencil.nodes.size(), a.stencil.nodes.size() + b.stencil.nodes.size());
    EXPECT_NEAR(between.stencil.weights.sum(), 0.5 * (a.stencil.weights.sum() + b.stencil.weights.sum()),
                1e-14);
    EXPECT_EQ(between.d_gap.size(), between.unknowns());
    EXPECT_EQ(between.gap_weights.size(), 0);
    auto lifted = b;
    lifted.gap_weights = 3 * b.stencil.weights;
    const auto followed = frozen_between(a, lifted).gap_weights;
    ASSERT_EQ(followed.size(), between.stencil.weights.size());
    EXPECT_EQ(followed.head(a.stencil.weights.size()), 0.5 * a.stencil.weights);
    EXPECT_EQ(followed.tail(b.stencil.weights.size()), 0.5 * lifted.gap_weights);
  }
}

TEST_P(FrozenFrame, BetweenTheSameTwiceIsThatFrame) {
  for (const auto& k : paired_points()) {
    auto between = frozen_between(k, k);
    measure_in_frozen_frame(between, faces_.configuration(faces_.u));
    EXPECT_NEAR(between.gap, k.gap, 1e-14);
    EXPECT_LT((between.normal - k.normal).norm(), 1e-14);
    EXPECT_LT((between.tangents.col(0) - k.tangents.col(0)).norm(), 1e-14);
  }
}

INSTANTIATE_TEST_SUITE_P(
    On, FrozenFrame,
    testing::Values(Pairing{"Segments", {.slave = CellType::seg2, .master = CellType::seg2}},
                    Pairing{"QuadraticSegments", {.slave = CellType::seg3, .master = CellType::seg3}},
                    Pairing{"Quadrangles", {}},
                    Pairing{"QuadraticQuadrangles", {.slave = CellType::quad9, .master = CellType::quad8}},
                    Pairing{"Triangles", {.slave = CellType::tria6, .master = CellType::tria3}},
                    Pairing{"SlaveNormals", {.normal = study::ContactNormal::slave}},
                    Pairing{"BesideTheBorder", {.shift = 0.3}}),
    [](const auto& pairing) { return pairing.param.name; });

} // namespace
} // namespace rubato::contact::frozen_frame_test
