// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/law.hpp"

#include <gtest/gtest.h>

#include <random>

namespace rubato::contact {
namespace {

constexpr PointCoefficients steel{0.4, 50.0, 7.0, 0.0, 2};

Eigen::Matrix<double, 6, 1> variables(const PointState& p) {
  Eigen::Matrix<double, 6, 1> v;
  v << p.gap, p.slip, p.pressure, p.semi;
  return v;
}

PointState from(const Eigen::Matrix<double, 6, 1>& v) {
  return {v[0], v.segment<2>(1), v[3], v.segment<2>(4)};
}

TEST(AugmentedLagrangianStatus, ClosesWhenPushedAndOpensWhenPulled) {
  EXPECT_EQ(augmented_lagrangian_status({0.1, {}, 0, {}}, steel), Status::open);
  EXPECT_EQ(augmented_lagrangian_status({-0.1, {0, 0}, 0, {0, 0}}, steel), Status::slip);
  EXPECT_EQ(augmented_lagrangian_status({0.0, {0, 0}, -3.0, {0, 0}}, steel), Status::open);
  EXPECT_EQ(augmented_lagrangian_status({0.0, {0, 0}, 3.0, {0.5, 0.5}}, steel), Status::stick);
  EXPECT_EQ(augmented_lagrangian_status({0.0, {0.1, 0}, 3.0, {0.5, 0.5}}, steel), Status::slip);
}

TEST(AugmentedLagrangianStatus, RoundingOfTheGapClosesNothing) {
  auto coefficients = steel;
  coefficients.gap_tolerance = 1e-12;
  EXPECT_EQ(augmented_lagrangian_status({-1e-13, {0, 0}, 0, {0, 0}}, coefficients), Status::open);
}

TEST(AugmentedLagrangianLaw, SlidingTractionOpposesTheSlip) {
  const auto response = augmented_lagrangian({0.0, {0.5, 0}, 10.0, {1, 0}}, Status::slip, steel);
  EXPECT_DOUBLE_EQ(response.traction[0], 10.0);
  EXPECT_DOUBLE_EQ(response.traction[1], -0.4 * 10.0);
  EXPECT_DOUBLE_EQ(response.traction[2], 0.0);
  EXPECT_NEAR(response.equations.norm(), 0, 1e-15);
}

TEST(AugmentedLagrangianLaw, OpenPointsCarryNothing) {
  const auto response = augmented_lagrangian({0.5, {0.5, 0}, 0.0, {0, 0}}, Status::open, steel);
  EXPECT_EQ(response.traction.norm(), 0.0);
  EXPECT_EQ(response.equations.norm(), 0.0);
}

class LawTangent : public testing::TestWithParam<Status> {};

TEST_P(LawTangent, IsTheDerivativeOfTheLaw) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    Eigen::Matrix<double, 6, 1> v = Eigen::Matrix<double, 6, 1>::NullaryExpr([&] { return number(random); });
    v[3] = 2 + number(random);
    const auto at = augmented_lagrangian(from(v), GetParam(), steel);
    for (int i = 0; i < 6; ++i) {
      constexpr double h = 1e-6;
      auto forward = v;
      auto backward = v;
      forward[i] += h;
      backward[i] -= h;
      const auto plus = augmented_lagrangian(from(forward), GetParam(), steel);
      const auto minus = augmented_lagrangian(from(backward), GetParam(), steel);
      EXPECT_LT(((plus.traction - minus.traction) / (2 * h) - at.d_traction.col(i)).norm(), 1e-6);
      EXPECT_LT(((plus.equations - minus.equations) / (2 * h) - at.d_equations.col(i)).norm(), 1e-6);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Statuses, LawTangent, testing::Values(Status::open, Status::stick, Status::slip));

TEST(AugmentedLagrangianLaw, VariablesKeepTheirOrder) {
  const PointState p{1, {2, 3}, 4, {5, 6}};
  EXPECT_EQ(from(variables(p)).semi[1], 6);
}

} // namespace
} // namespace rubato::contact
