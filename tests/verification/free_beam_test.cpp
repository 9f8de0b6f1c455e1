// SPDX-License-Identifier: LGPL-3.0-or-later
/// V11, cases/v11_free_beam: a clamped beam is bent and let go. Its first mode, found by a dense eigenvalue
/// solution of its own, must move as the closed-form amplification of the scheme says, and be the mode of
/// beam theory.

#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "verification/free_beam.hpp"
#include <numbers>

namespace rubato::verification::free_beam_test {
namespace {

class FreeBeam : public testing::Test {
protected:
  FreeBeamRuns beam_;
};

TEST_F(FreeBeam, HasTheFirstFrequencyOfTimoshenkosBeam) {
  const double omega = first_mode(test::BuiltModel(beam_.study("newmark"))).omega;
  EXPECT_NEAR(omega, timoshenko, 1e-3 * timoshenko);
  EXPECT_LT(omega, bernoulli);
  RecordProperty("frequency", std::to_string(omega / (2 * std::numbers::pi)));
}

TEST_F(FreeBeam, IsBentByTheForceAsBeamTheoryHasIt) {
  EXPECT_TRUE(beam_.bent().checks_hold());
  EXPECT_EQ(beam_.bent().checks.size(), 1u);
}

TEST_F(FreeBeam, HasThePeriodOfNewmarksClosedFormAndKeepsItsAmplitude) {
  const auto run = beam_.vibration("newmark");
  const auto found = measured_amplification(run.amplitude);
  EXPECT_NEAR(std::arg(found), 2 * std::atan(run.omega * run.h / 2), 1e-6 * run.omega * run.h);
  EXPECT_NEAR(std::abs(found), 1, 1e-9);
}

TEST_F(FreeBeam, HasThePeriodAndDampingOfHilberHughesTaylor) {
  const double alpha = -0.1;
  const auto run = beam_.vibration("hht");
  const auto expected =
      principal(amplification(0, -alpha, (1 - alpha) * (1 - alpha) / 4, 0.5 - alpha, run.omega * run.h));
  const auto found = measured_amplification(run.amplitude);
  EXPECT_NEAR(std::arg(found), std::arg(expected), 1e-6 * run.omega * run.h);
  EXPECT_NEAR(std::log(std::abs(found)), std::log(std::abs(expected)), 1e-9);
  EXPECT_LT(std::abs(expected), 1 - 1e-5);
}

TEST_F(FreeBeam, HasThePeriodAndDampingOfChungAndHulbert) {
  const double rho = 0.8, alpha_m = (2 * rho - 1) / (rho + 1), alpha_f = rho / (rho + 1);
  const double shift = 1 - alpha_m + alpha_f;
  const auto run = beam_.vibration("generalized_alpha");
  const auto expected =
      principal(amplification(alpha_m, alpha_f, shift * shift / 4, shift - 0.5, run.omega * run.h));
  const auto found = measured_amplification(run.amplitude);
  EXPECT_NEAR(std::arg(found), std::arg(expected), 1e-6 * run.omega * run.h);
  EXPECT_NEAR(std::log(std::abs(found)), std::log(std::abs(expected)), 1e-9);
}

/// Every step, not only the mean: the mode starts at rest with the acceleration of its spring.
TEST_F(FreeBeam, FollowsTheAmplificationStepByStep) {
  const double alpha = -0.1;
  const auto run = beam_.vibration("hht");
  const Eigen::Matrix3d step =
      amplification(0, -alpha, (1 - alpha) * (1 - alpha) / 4, 0.5 - alpha, run.omega * run.h);
  Eigen::Vector3d expected(1, 0, -std::pow(run.omega * run.h, 2));
  double largest = 0;
  for (const double q : run.amplitude) {
    largest = std::max(largest, std::abs(q / run.amplitude.front() - expected[0]));
    expected = step * expected;
  }
  EXPECT_EQ(run.amplitude.size(), 201u);
  EXPECT_LT(largest, 1e-7);
  RecordProperty("largest_deviation", std::to_string(largest * 1e12) + "e-12");
}

} // namespace
} // namespace rubato::verification::free_beam_test
