// SPDX-License-Identifier: LGPL-3.0-or-later
// Gap, slip and frame of points whose answers are known; their derivatives: tangent_test.cpp.
#include "rubato/contact/kinematics.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace rubato::contact::kinematics_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// A small slave face above a master face of side 2 around 0 that looks up: nodes 0 to 3 and 4 to 7 in space,
/// 0, 1 and 2, 3 in the plane.
class Above : public testing::Test {
protected:
  explicit Above(int dimension) : dimension_(dimension) {
    dofs_.components = mesh_.dimension = dimension;
    settings_.name = "zone";
    settings_.friction = 0.3;
  }

  void add(const std::vector<Vector3d>& places) {
    for (const auto& place : places) {
      dofs_.first_dof.push_back(mesh_.node_count() * dimension_);
      dofs_.nodes.push_back(mesh_.node_count());
      mesh_.points.push_back(place);
    }
    dofs_.dof_count = mesh_.node_count() * dimension_;
    u_ = start_ = VectorXd::Zero(dofs_.dof_count);
  }

  Surface face_from(mesh::NodeIndex first) const {
    Face face;
    face.type = dimension_ == 3 ? CellType::quad4 : CellType::seg2;
    face.node_count = dimension_ == 3 ? 4 : 2;
    for (int i = 0; i < face.node_count; ++i)
      face.nodes[static_cast<std::size_t>(i)] = first + i;
    return make_surface(mesh_, {face});
  }

  void make() {
    const mesh::NodeIndex slave = dimension_ == 3 ? 4 : 2;
    zone_ = make_zone(mesh_, settings_, face_from(0), face_from(slave), {}, {dimension_, 1.0, {}});
  }

  Configuration configuration() const { return {&mesh_, &dofs_, &u_, &start_}; }
  Kinematics kinematics(std::size_t point = 0) const {
    const auto pairs = find_pairs(zone_, configuration());
    EXPECT_TRUE(pairs[point].paired());
    return evaluate_kinematics(zone_, zone_.points[point], pairs[point], configuration());
  }
  void move(mesh::NodeIndex node, const Vector3d& by) {
    u_.segment(node * dimension_, dimension_) += by.head(dimension_);
  }
  void move_all(const Vector3d& by) {
    for (mesh::NodeIndex node = 0; node < mesh_.node_count(); ++node)
      move(node, by);
  }
  void turn_all(const Eigen::Matrix3d& turn) {
    for (mesh::NodeIndex node = 0; node < mesh_.node_count(); ++node) {
      const Vector3d x = configuration().position(node);
      move(node, turn * x - x);
    }
  }

  int dimension_;
  mesh::Mesh mesh_;
  domain::DofMap dofs_;
  study::ContactZone settings_;
  Zone zone_;
  VectorXd u_, start_;
};

class AboveAPlate : public Above {
protected:
  AboveAPlate() : Above(3) {
    add({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
    add({{0.1, 0.1, 0.25}, {0.1, 0.3, 0.25}, {0.3, 0.3, 0.25}, {0.3, 0.1, 0.25}});
    make();
  }
};

TEST_F(AboveAPlate, TheGapIsTheHeightAndTheFrameThePlates) {
  const auto k = kinematics();
  EXPECT_EQ(k.parametric_dimension, 2);
  EXPECT_NEAR(k.gap, 0.25, 1e-15);
  EXPECT_EQ(k.normal, Vector3d(0, 0, 1));
  EXPECT_EQ(k.tangents.col(0), Vector3d(1, 0, 0));
  EXPECT_EQ(k.tangents.col(1), Vector3d(0, 1, 0));
  EXPECT_EQ(k.slip, Eigen::Vector2d::Zero());
  EXPECT_EQ(k.stencil.nodes, (std::vector<mesh::NodeIndex>{4, 0, 1, 2, 3}));
  // Bilinear shape functions at (0.1, 0.1).
  const std::vector<double> weights{1, -0.81 / 4, -0.99 / 4, -1.21 / 4, -0.99 / 4};
  for (std::size_t i = 0; i < weights.size(); ++i)
    EXPECT_NEAR(k.stencil.weights[static_cast<Eigen::Index>(i)], weights[i], 1e-15);
}

TEST_F(AboveAPlate, APenetrationIsNegative) {
  move(4, {0, 0, -0.3});
  EXPECT_NEAR(kinematics().gap, -0.05, 1e-15);
}

TEST_F(AboveAPlate, TheSlipIsTheRelativeMotionAlongItSinceTheStepBegan) {
  move(4, {0.01, 0.02, 0});
  start_ = u_;
  EXPECT_EQ(kinematics().slip, Eigen::Vector2d::Zero()) << "nothing has moved since";
  for (mesh::NodeIndex master = 0; master < 4; ++master)
    move(master, {0.01, -0.02, 0.05});
  move(4, {0.04, 0.02, -0.03});
  const auto k = kinematics();
  EXPECT_NEAR(k.slip[0], 0.03, 1e-15);
  EXPECT_NEAR(k.slip[1], 0.04, 1e-15);
  EXPECT_NEAR(k.gap, 0.25 - 0.08, 1e-15);
}

TEST_F(AboveAPlate, MovingAsOneChangesNothing) {
  u_ = VectorXd::LinSpaced(u_.size(), -0.03, 0.05);
  const auto before = kinematics();
  move_all({3, -2, 5});
  const auto shifted = kinematics();
  EXPECT_NEAR(shifted.gap, before.gap, 1e-14);
  EXPECT_LE((shifted.slip - before.slip).norm(), 1e-14);
  EXPECT_LE((shifted.normal - before.normal).norm(), 1e-14);
  for (int component = 0; component < 3; ++component) {
    double gap = 0;
    Eigen::Vector2d slip = Eigen::Vector2d::Zero();
    for (Eigen::Index node = 0; node < before.stencil.weights.size(); ++node) {
      gap += before.d_gap[3 * node + component];
      slip += before.d_slip.col(3 * node + component);
    }
    EXPECT_NEAR(gap, 0, 1e-14);
    EXPECT_LE(slip.norm(), 1e-14);
  }
}

TEST_F(AboveAPlate, TurningAsOneTurnsTheFrameAndKeepsTheGap) {
  u_ = VectorXd::LinSpaced(u_.size(), -0.03, 0.05);
  const auto before = kinematics();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  turn_all(turn);
  const auto after = kinematics();
  EXPECT_NEAR(after.gap, before.gap, 1e-14);
  EXPECT_LE((after.normal - turn * before.normal).norm(), 1e-14);
  EXPECT_LE((after.tangents - turn * before.tangents).norm(), 1e-14);
  EXPECT_LE((after.stencil.weights - before.stencil.weights).norm(), 1e-13);
}

TEST_F(AboveAPlate, AForceAcrossThePlateIsSharedAsTheGapIs) {
  const auto k = kinematics();
  for (Eigen::Index node = 0; node < k.stencil.weights.size(); ++node) {
    EXPECT_NEAR(k.d_gap[3 * node + 2], k.stencil.weights[node], 1e-14);
    EXPECT_NEAR(k.d_slip(0, 3 * node), k.stencil.weights[node], 1e-14);
    EXPECT_NEAR(k.d_slip(1, 3 * node + 1), k.stencil.weights[node], 1e-14);
    EXPECT_NEAR(k.d_slip(0, 3 * node + 1), 0, 1e-14);
  }
}

/// Beyond its border the place is the border's, the normal the plate's.
TEST_F(AboveAPlate, APointBesideItSeesItsBorder) {
  move(4, {1.2, 0, 0}); // to x = 1.3
  const auto k = kinematics();
  EXPECT_NEAR(k.gap, 0.25, 1e-15);
  EXPECT_EQ(k.normal, Vector3d(0, 0, 1));
  EXPECT_NEAR(k.stencil.weights[1], 0, 1e-15) << "the far side";
  EXPECT_NEAR(k.stencil.weights[4], 0, 1e-15);
  EXPECT_NEAR(k.stencil.weights[2], -0.45, 1e-15);
  EXPECT_NEAR(k.stencil.weights[3], -0.55, 1e-15);
}

TEST_F(AboveAPlate, TheOffsetOfTheZoneIsAddedToTheGapAlone) {
  const auto without = kinematics();
  zone_.offset.terms.push_back({.length = {.number = 0.125, .expression = {}, .function = {}}});
  const auto with = kinematics();
  EXPECT_NEAR(with.gap, 0.375, 1e-15);
  EXPECT_NEAR(with.gap_origin, -0.125, 1e-15);
  EXPECT_EQ(without.gap_origin, 0);
  EXPECT_EQ(with.d_gap, without.d_gap);
}

/// The slave turned by an angle about y: its normal leans, and so does half of that the average.
TEST_F(AboveAPlate, NormalsAreTheMastersTheSlavesOrBetween) {
  constexpr double angle = 0.4;
  for (const mesh::NodeIndex node : {6, 7})
    move(node, Vector3d(0.2 * std::cos(angle) - 0.2, 0, 0.2 * std::sin(angle)));
  for (const auto& [normal, part] : {std::pair(study::ContactNormal::master, 0.0),
                                     {study::ContactNormal::slave, 1.0},
                                     {study::ContactNormal::average, 0.5}}) {
    settings_.normal = normal;
    make();
    const auto k = kinematics();
    const Vector3d expected(-std::sin(part * angle), 0, std::cos(part * angle));
    EXPECT_LE((k.normal - expected).norm(), 1e-14) << part;
    EXPECT_NEAR(k.tangents.col(0).dot(k.normal), 0, 1e-15);
    EXPECT_LE((k.tangents.col(1) - k.normal.cross(k.tangents.col(0))).norm(), 1e-15);
    EXPECT_NEAR(k.gap, 0.25 * std::cos(part * angle), 1e-14);
  }
}

TEST_F(AboveAPlate, TheStorageOfAnotherPointIsWrittenOver) {
  auto storage = kinematics(2);
  move(4, {0.03, 0.02, -0.1});
  const auto fresh = kinematics(0);
  evaluate_kinematics(zone_, zone_.points[0], find_pairs(zone_, configuration())[0], configuration(),
                      storage);
  EXPECT_EQ(storage.stencil.nodes, fresh.stencil.nodes);
  EXPECT_EQ(storage.stencil.weights, fresh.stencil.weights);
  EXPECT_EQ(storage.gap, fresh.gap);
  EXPECT_EQ(storage.slip, fresh.slip);
  EXPECT_EQ(storage.d_gap, fresh.d_gap);
  EXPECT_EQ(storage.d_slip, fresh.d_slip);
}

class AboveALine : public Above {
protected:
  AboveALine() : Above(2) {
    add({{1, 0, 0}, {-1, 0, 0}}); // runs to −x: it looks up
    add({{-0.5, 0.1, 0}, {-0.25, 0.1, 0}});
    make();
  }
};

TEST_F(AboveALine, OneTangentCountsInThePlane) {
  move(2, {0.02, -0.15, 0});
  const auto k = kinematics();
  EXPECT_EQ(k.parametric_dimension, 1);
  EXPECT_NEAR(k.gap, -0.05, 1e-15);
  EXPECT_LE((k.normal - Vector3d(0, 1, 0)).norm(), 1e-15);
  EXPECT_LE((k.tangents.col(0) - Vector3d(-1, 0, 0)).norm(), 1e-15);
  EXPECT_NEAR(k.slip[0], -0.02, 1e-15) << "against the line's direction";
  EXPECT_EQ(k.slip[1], 0);
  EXPECT_EQ(k.d_slip.row(1).norm(), 0);
  EXPECT_NEAR(k.stencil.weights[1], -0.26, 1e-15);
  EXPECT_NEAR(k.stencil.weights[2], -0.74, 1e-15);
}

TEST_F(AboveALine, AQuarterTurnTakesTheFrameAlong) {
  turn_all(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitZ()).toRotationMatrix());
  const auto k = kinematics();
  EXPECT_NEAR(k.gap, 0.1, 1e-15);
  EXPECT_LE((k.normal - Vector3d(-1, 0, 0)).norm(), 1e-15);
  EXPECT_LE((k.tangents.col(0) - Vector3d(0, -1, 0)).norm(), 1e-15);
}

} // namespace
} // namespace rubato::contact::kinematics_test
