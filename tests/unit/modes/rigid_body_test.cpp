// SPDX-License-Identifier: LGPL-3.0-or-later
/// Modes of bodies that relations make rigid, against rigid dynamics.
#include "rubato/model/model.hpp"
#include "rubato/modes/modes.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "support/dense.hpp"
#include "unit/modes/modal_model.hpp"
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace rubato::modes::rigid_body_test {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr double density = 3;
const Vector3d sides(2, 1, 0.5);
const Vector3d spring(50, 80, 30);

/// A box of 10 × 10 × 10 nodes that moves as a rigid body, its four lower corners on springs.
const std::string deck = R"(mesh:
  generate:
    - {name: box, box: {from: [0, 0, 0], to: [2, 1, 0.5]}, divisions: [9, 9, 9], cells: hexa8,
       points: {left_bottom_back: A, right_bottom_back: B, left_bottom_front: C, right_bottom_front: D}}
physics: solid
materials: {any: {young: 1000, poisson: 0.3, density: 3}}
relations: {body: {rigid: {on: box}}}
springs:
  - {on: A, x: 50, y: 80, z: 30}
  - {on: B, x: 50, y: 80, z: 30}
  - {on: C, x: 50, y: 80, z: 30}
  - {on: D, x: 50, y: 80, z: 30}
time: {scheme: newmark, step: 1, end: 1}
)";

Matrix3d cross_matrix(const Vector3d& a) {
  Matrix3d cross;
  cross << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return cross;
}

/// Circular frequencies squared of the rigid box on its springs, about its centre.
VectorXd squares_of_rigid_dynamics() {
  const double mass = density * sides.prod();
  Matrix6d m = Matrix6d::Zero();
  m.topLeftCorner<3, 3>() = mass * Matrix3d::Identity();
  for (int i = 0; i < 3; ++i)
    m(3 + i, 3 + i) = mass / 12 * (sides.squaredNorm() - sides[i] * sides[i]);
  Matrix6d k = Matrix6d::Zero();
  for (const double x : {0.0, sides[0]})
    for (const double z : {0.0, sides[2]}) {
      Eigen::Matrix<double, 3, 6> motion;
      motion << Matrix3d::Identity(), -cross_matrix(Vector3d(x, 0, z) - sides / 2);
      k += motion.transpose() * spring.asDiagonal() * motion;
    }
  return test::general_modes(k, m).values;
}

TEST(RigidBody, HasTheSixFrequenciesOfRigidDynamics) {
  const auto model = test::modal_model(deck);
  ASSERT_EQ(model.dofs.nodes.size(), 1000U);
  ASSERT_EQ(model.reduction.unknown_count(), 6);
  const auto modes = modes_of(model, {.number = 10});
  ASSERT_EQ(modes.frequencies.size(), 6);
  const VectorXd squares = squares_of_rigid_dynamics();
  for (Eigen::Index k = 0; k < 6; ++k) {
    const double wanted = std::sqrt(squares[k]) / (2 * std::numbers::pi);
    EXPECT_NEAR(modes.frequencies[k], wanted, 1e-10 * wanted) << k;
  }
  EXPECT_NEAR(modes.effective_masses.colwise().sum().minCoeff(), 1, 1e-10);
}

} // namespace
} // namespace rubato::modes::rigid_body_test
