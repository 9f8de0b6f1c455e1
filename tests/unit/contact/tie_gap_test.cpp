// SPDX-License-Identifier: LGPL-3.0-or-later
// The gap vector of a tie: its rotation, its derivative, the moment of its forces.
#include "rubato/contact/tie_gap.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace rubato::contact::tie_gap_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Four nodes of a master with some gradients of their functions, which sum to zero.
struct Surface {
  std::vector<Vector3d> x;
  std::vector<SurfaceGradient> gradients;
  Stencil stencil;
  Vector3d normal, gap;

  NodePlace place() const {
    return [this](mesh::NodeIndex node) { return x[static_cast<std::size_t>(node)]; };
  }
};

Surface surface(int components) {
  Surface s;
  s.stencil.components = components;
  s.stencil.nodes = {0, 1, 2, 3};
  s.stencil.weights = Eigen::Vector4d(0.5, 0.2, 0.2, 0.1);
  if (components == 2) {
    s.x = {{0, 0, 0}, {1, 0.1, 0}, {2.1, 0, 0}, {3, 0.2, 0}};
    s.gradients = {{0, {-0.3, 0.01, 0}}, {1, {-0.5, 0, 0}}, {2, {0.6, 0.02, 0}}, {3, {0.2, -0.03, 0}}};
    s.normal = Vector3d(0.1, 1, 0).normalized();
    s.gap = {0.05, 0.3, 0};
  } else {
    s.x = {{0, 0, 0}, {1, 0.1, 0.1}, {1.1, 0.9, 0}, {0, 1, 0.2}};
    s.gradients = {{0, {-0.6, -0.4, 0.1}}, {1, {0.7, -0.6, 0}}, {2, {0.3, 0.6, -0.1}}, {3, {-0.4, 0.4, 0}}};
    s.normal = Vector3d(0.1, -0.1, 1).normalized();
    s.gap = {0.05, -0.08, 0.3};
  }
  return s;
}

TieGap gap_of(const Surface& s) {
  auto gap = make_tie_gap(s.stencil, s.gradients, s.gap, s.normal, s.place());
  gap.rows = {true, true, true};
  return gap;
}

Matrix3d rotation(int components) {
  const Vector3d axis = components == 2 ? Vector3d(0, 0, 1) : Vector3d(1, -2, 0.7).normalized();
  return Eigen::AngleAxisd(2.1, axis).toRotationMatrix();
}

TEST(TieGap, IsTheGivenVectorAtFirst) {
  for (const int components : {2, 3}) {
    auto s = surface(components);
    const auto gap = gap_of(s);
    const auto turned = turn(std::array{gap}, s.place(), s.stencil);
    EXPECT_LT((turned.gap - s.gap).norm(), 1e-15);
    EXPECT_LT((turned.facing - s.normal).norm(), 1e-15);
  }
}

TEST(TieGap, TurnsWithTheMaster) {
  for (const int components : {2, 3}) {
    auto s = surface(components);
    const auto gap = gap_of(s);
    const Matrix3d q = rotation(components);
    for (auto& x : s.x)
      x = q * x + Vector3d(5, -3, components == 2 ? 0 : 2);
    const auto turned = turn(std::array{gap}, s.place(), s.stencil);
    EXPECT_LT((turned.gap - q * s.gap).norm(), 1e-14);
    EXPECT_LT((turned.facing - q * s.normal).norm(), 1e-14);
  }
}

TEST(TieGap, KeepsItsLengthWhereTheMasterStretches) {
  for (const int components : {2, 3}) {
    auto s = surface(components);
    const auto gap = gap_of(s);
    for (auto& x : s.x)
      x = {1.3 * x[0], 0.8 * x[1], components == 2 ? 0 : 1.1 * x[2] + 0.2 * x[0]};
    EXPECT_NEAR(turn(std::array{gap}, s.place(), s.stencil).gap.norm(), s.gap.norm(), 1e-15);
  }
}

TEST(TieGap, HasTheDerivativeOfFiniteDifferences) {
  constexpr double step = 1e-6;
  for (const int components : {2, 3}) {
    auto s = surface(components);
    const auto gap = gap_of(s);
    const Matrix3d q = rotation(components);
    for (auto& x : s.x)
      x = q * x + Vector3d(0.1 * x[1], 0.05 * x[0], components == 2 ? 0 : 0.1 * x[0]);
    turn(std::array{gap}, s.place(), s.stencil);
    const auto turning = s.stencil.turning;
    for (std::size_t node = 0; node < s.x.size(); ++node)
      for (int of = 0; of < components; ++of) {
        const double at = s.x[node][of];
        s.x[node][of] = at + step;
        const Vector3d after = turn(std::array{gap}, s.place(), s.stencil).gap;
        s.x[node][of] = at - step;
        const Vector3d before = turn(std::array{gap}, s.place(), s.stencil).gap;
        s.x[node][of] = at;
        const Vector3d difference = (before - after) / (2 * step);
        for (int row = 0; row < components; ++row)
          EXPECT_NEAR(turning[node](row, of), difference[row], 1e-9) << components << node << of << row;
      }
  }
}

/// Σ x × f of the forces that a traction T has on the master's nodes balances T × G.
TEST(TieGap, HasForcesWhoseMomentIsThatOfItsTraction) {
  const Vector3d traction(0.7, -0.4, 1.1);
  for (const int components : {2, 3}) {
    auto s = surface(components);
    const auto gap = gap_of(s);
    const Matrix3d q = rotation(components);
    for (auto& x : s.x)
      x = q * x;
    const auto turned = turn(std::array{gap}, s.place(), s.stencil);
    Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();
    for (std::size_t node = 0; node < s.x.size(); ++node) {
      const Vector3d of_node = s.stencil.turning[node].transpose() * traction;
      force += of_node;
      moment += s.x[node].cross(of_node);
    }
    const Vector3d expected = -turned.gap.cross(traction);
    EXPECT_LT(force.norm(), 1e-14);
    for (int axis = components == 2 ? 2 : 0; axis < 3; ++axis)
      EXPECT_NEAR(moment[axis], expected[axis], 1e-14);
  }
}

TEST(TieGap, IsNoneWhereTheMasterHasNoSurface) {
  auto s = surface(3);
  for (auto& x : s.x)
    x = {x[0], 0, 0};
  EXPECT_TRUE(make_tie_gap(s.stencil, s.gradients, s.gap, s.normal, s.place()).places.empty());
}

} // namespace
} // namespace rubato::contact::tie_gap_test
