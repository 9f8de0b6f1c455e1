// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/friction_cones.hpp"
#include "rubato/step/interface/normal_problem.hpp"

#include <gtest/gtest.h>

#include <random>

namespace rubato::step::friction_cones_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Few motions that every point takes part in, far softer than what each point gives itself: a body on weak
/// springs.
MatrixXd compliance_of_a_body(Index size, std::mt19937& random) {
  std::uniform_real_distribution<double> any(-1, 1);
  const auto filled = [&](Index rows, Index columns) {
    MatrixXd matrix(rows, columns);
    for (auto& value : matrix.reshaped())
      value = any(random);
    return matrix;
  };
  const MatrixXd rigid = filled(size, 3);
  const MatrixXd own = filled(size, size);
  return 1e3 * rigid * rigid.transpose() + own * own.transpose() / static_cast<double>(size) +
         MatrixXd::Identity(size, size);
}

TEST(Complementarity, OfASoftlyHeldBodyIsSolvedToItsEnd) {
  Progress progress;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const Index size : {1, 3, 12, 40}) {
    const MatrixXd matrix = compliance_of_a_body(size, random);
    VectorXd values(size);
    for (auto& value : values)
      value = any(random);
    VectorXd forces = VectorXd::Ones(size);
    ASSERT_TRUE(solve_complementarity(matrix, values, forces, progress)) << size;
    const VectorXd open = values + matrix * forces;
    EXPECT_GE(forces.minCoeff(), 0) << size;
    EXPECT_GE(open.minCoeff(), -1e-8) << size;
    EXPECT_NEAR(forces.dot(open), 0, 1e-8) << size;
  }
}

/// A point that is pushed along a plane, pressed by one unit of gap over one of give.
FrictionCones pushed(double push, Index components) {
  FrictionCones cones{MatrixXd::Identity(components, components), VectorXd::Zero(components),
                      VectorXd::Constant(1, 0.5)};
  cones.values[0] = -1;
  cones.values[1] = push;
  return cones;
}

TEST(FrictionCones, APointSticksBelowItsLimitAndSlipsAtIt) {
  Progress progress;
  for (const Index components : {2, 3}) {
    const auto sticks = solve_friction(pushed(0.4, components), VectorXd::Zero(components), progress);
    ASSERT_TRUE(sticks);
    EXPECT_NEAR((*sticks)[0], 1, 1e-9);
    EXPECT_NEAR((*sticks)[1], -0.4, 1e-9);
    const auto slips = solve_friction(pushed(2, components), VectorXd::Zero(components), progress);
    ASSERT_TRUE(slips);
    EXPECT_NEAR((*slips)[0], 1, 1e-9);
    EXPECT_NEAR((*slips)[1], -0.5, 1e-9);
  }
}

TEST(FrictionCones, APointThatIsApartHasNoForce) {
  Progress progress;
  auto cones = pushed(0.4, 3);
  cones.values[0] = 0.1;
  const auto forces = solve_friction(cones, VectorXd::Ones(3), progress);
  ASSERT_TRUE(forces);
  EXPECT_TRUE(forces->isZero(0));
}

TEST(FrictionCones, PointsOfASoftlyHeldBodyFulfilCoulombsLaw) {
  Progress progress;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(-1, 1);
  int solved = 0;
  constexpr Index points = 4;
  constexpr int samples = 20;
  for (int sample = 0; sample < samples; ++sample) {
    FrictionCones cones{compliance_of_a_body(3 * points, random), VectorXd(3 * points),
                        VectorXd::Constant(points, 0.3)};
    for (auto& value : cones.values)
      value = any(random);
    const auto forces = solve_friction(cones, VectorXd::Zero(3 * points), progress);
    if (!forces)
      continue;
    ++solved;
    const VectorXd w = cones.values + cones.matrix * *forces;
    for (Index k = 0; k < points; ++k) {
      const double normal = (*forces)[3 * k];
      const Eigen::Vector2d along = forces->segment<2>(3 * k + 1);
      const Eigen::Vector2d slip = w.segment<2>(3 * k + 1);
      EXPECT_GE(normal, 0);
      EXPECT_GE(w[3 * k], -1e-6);
      EXPECT_NEAR(normal * w[3 * k], 0, 1e-6);
      EXPECT_LE(along.norm(), 0.3 * normal * (1 + 1e-9) + 1e-12);
      EXPECT_NEAR(along.dot(slip) + along.norm() * slip.norm(), 0, 1e-6) << "friction against the slip";
      if (along.norm() < 0.3 * normal * (1 - 1e-6)) {
        EXPECT_NEAR(slip.norm(), 0, 1e-6);
      }
    }
  }
  EXPECT_GE(solved, samples / 2) << "the method has no guarantee, but comes to its end mostly";
}

} // namespace
} // namespace rubato::step::friction_cones_test
