// SPDX-License-Identifier: LGPL-3.0-or-later
/// A mass on a spring: order of convergence, and the amplification matrix, which maps (u, h v, h² a) over a
/// step, against its closed forms (T. J. R. Hughes, The Finite Element Method, ch. 9; J. Chung and
/// G. M. Hulbert, J. Appl. Mech. 60, 1993). Ω = ω h.
#include <Eigen/Core>
#include <gtest/gtest.h>

#include "support/dense.hpp"
#include "unit/time/schemes.hpp"
#include <cmath>
#include <complex>
#include <numbers>

namespace rubato::time::oscillator_test {
namespace {

using Eigen::Matrix3d;

Matrix3d amplification(const Scheme& scheme, double big_omega) {
  Matrix3d matrix;
  for (int column = 0; column < 3; ++column) {
    const auto end = test::step(scheme, {big_omega}, 1,
                                test::motion(column == 0 ? 1 : 0, column == 1 ? 1 : 0, column == 2 ? 1 : 0));
    matrix.col(column) << end.u[0], end.v[0], end.a[0];
  }
  return matrix;
}

double spectral_radius(const Matrix3d& matrix) {
  return test::eigenvalues(matrix).cwiseAbs().maxCoeff();
}

/// The eigenvalue of the motion itself: the one of largest angle; the third is spurious and real.
std::complex<double> principal(const Matrix3d& matrix) {
  const Eigen::Vector3cd values = test::eigenvalues(matrix);
  Eigen::Index largest = 0;
  values.imag().maxCoeff(&largest);
  return values[largest];
}

/// Error at t = 1 of a damped oscillator started with u = 1, v = 0.
double error_at_one(const Scheme& scheme, int steps) {
  const test::Oscillator spring{2 * std::numbers::pi * 0.8, 0.05};
  auto motion = test::motion(1, 0, -spring.stiffness());
  for (int i = 0; i < steps; ++i)
    motion = test::step(scheme, spring, 1. / steps, motion);
  const double decay = spring.ratio * spring.omega;
  const double damped = spring.omega * std::sqrt(1 - spring.ratio * spring.ratio);
  const double exact = std::exp(-decay) * (std::cos(damped) + decay / damped * std::sin(damped));
  return std::abs(motion.u[0] - exact);
}

double order(const Scheme& scheme) {
  return std::log2(error_at_one(scheme, 400) / error_at_one(scheme, 800));
}

TEST(Oscillator, ConvergesAtSecondOrder) {
  EXPECT_NEAR(order(test::newmark()), 2, 0.02);
  EXPECT_NEAR(order(test::generalized_alpha(0.8)), 2, 0.02);
  EXPECT_NEAR(order(test::generalized_alpha(0)), 2, 0.02);
  EXPECT_NEAR(order(test::moreau_jean(0.5)), 2, 0.02);
}

TEST(Oscillator, ConvergesAtSecondOrderUnderWoodBossakZienkiewiczDampedOrNot) {
  for (const double alpha : {-0.05, -0.3, -1.})
    EXPECT_NEAR(order(test::wbz(alpha)), 2, 0.03) << alpha;
}

/// Of steps that resolve the motion; longer ones may overshoot in their first few.
TEST(Oscillator, LosesEnergyUnderWoodBossakZienkiewicz) {
  for (const double alpha : {-0.05, -0.1, -0.3, -0.6})
    for (const double omega : {0.1, 0.5, 1.}) {
      const test::Oscillator spring{omega};
      auto motion = test::motion(1, 0, -spring.stiffness());
      const auto energy = [&] {
        return motion.v[0] * motion.v[0] + spring.stiffness() * motion.u[0] * motion.u[0];
      };
      const double start = energy();
      for (int i = 0; i < 300; ++i) {
        motion = test::step(test::wbz(alpha), spring, 1, motion);
        EXPECT_LE(energy(), start) << alpha << " " << omega;
      }
      EXPECT_LT(energy(), 0.9999 * start) << alpha << " " << omega;
    }
}

/// hht's γ = 1/2 − α makes up for the weights of the forces; damping, which is unweighted, keeps first order.
TEST(Oscillator, ConvergesAtSecondOrderUnderHilberHughesTaylorWhenUndamped) {
  const auto error = [](double alpha, int steps) {
    const test::Oscillator spring{2 * std::numbers::pi * 0.8};
    auto motion = test::motion(1, 0, -spring.stiffness());
    for (int i = 0; i < steps; ++i)
      motion = test::step(test::hht(alpha), spring, 1. / steps, motion);
    return std::abs(motion.u[0] - std::cos(spring.omega));
  };
  for (const double alpha : {-0.05, -0.3})
    EXPECT_NEAR(std::log2(error(alpha, 400) / error(alpha, 800)), 2, 0.03) << alpha;
}

TEST(Oscillator, ConvergesAtFirstOrderUnderModifiedAverageAcceleration) {
  EXPECT_NEAR(order(test::modified(-0.3)), 1, 0.03);
}

TEST(Oscillator, ConvergesAtFirstOrderUnderMoreauAndJeanBeyondTheMiddle) {
  EXPECT_NEAR(order(test::moreau_jean(0.7)), 1, 0.03);
}

TEST(Oscillator, KeepsItsEnergyUnderMoreauAndJeanInTheMiddle) {
  const test::Oscillator spring{5};
  auto motion = test::motion(1, 2, 0);
  const auto energy = [&] {
    return motion.v[0] * motion.v[0] + spring.stiffness() * motion.u[0] * motion.u[0];
  };
  const double start = energy();
  for (int i = 0; i < 1000; ++i)
    motion = test::step(test::moreau_jean(0.5), spring, 0.7, motion);
  EXPECT_NEAR(energy(), start, 1e-11 * start);
}

TEST(Amplification, OfHilberHughesTaylorIsHughessMatrix) {
  for (const double alpha : {0., -0.1, -0.3})
    for (const double omega : {0.01, 0.5, 3., 100.}) {
      const auto scheme = test::hht(alpha);
      const double beta = scheme.beta, gamma = scheme.gamma, w = omega * omega, one = 1 + alpha;
      Matrix3d expected;
      expected << 1 + alpha * beta * w, 1, 0.5 - beta,                                        //
          -gamma * w, 1 - one * (gamma - beta) * w, 1 - gamma - one * (gamma / 2 - beta) * w, //
          -w, -one * w, -(0.5 - beta) * one * w;
      expected /= 1 + one * beta * w;
      const Matrix3d found = amplification(scheme, omega);
      EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-11 * std::max(1., w)) << alpha << " " << omega;
    }
}

TEST(Amplification, OfAverageAccelerationKeepsAmplitudeAndHasAPeriodErrorInClosedForm) {
  for (const double omega : {0.01, 0.3, 1., 10.}) {
    const auto value = principal(amplification(test::newmark(), omega));
    EXPECT_NEAR(std::abs(value), 1, 1e-12);
    EXPECT_NEAR(std::arg(value), 2 * std::atan(omega / 2), 1e-11);
  }
}

/// Damping ratio ξ̄ = −ln|λ| / arg λ.
TEST(Amplification, DampingOfHilberHughesTaylorVanishesWithTheCubeOfTheStep) {
  const auto ratio = [](double omega) {
    const auto value = principal(amplification(test::hht(-0.3), omega));
    return -std::log(std::abs(value)) / std::arg(value);
  };
  EXPECT_NEAR(std::log2(ratio(0.04) / ratio(0.02)), 3, 0.01);
  EXPECT_GT(ratio(0.02), 0);
}

TEST(Amplification, DampsHighFrequenciesByTheRadiusAskedFor) {
  for (const double rho : {0., 0.3, 0.8, 1.})
    EXPECT_NEAR(spectral_radius(amplification(test::generalized_alpha(rho), 1e5)), rho, 1e-3) << rho;
  for (const double alpha : {-0.05, -0.2, -0.3, -1. / 3})
    EXPECT_NEAR(spectral_radius(amplification(test::hht(alpha), 1e4)), (1 + alpha) / (1 - alpha), 2e-3)
        << alpha;
  for (const double alpha : {0., -0.05, -0.3, -0.6})
    EXPECT_NEAR(spectral_radius(amplification(test::wbz(alpha), 1e4)), (1 + alpha) / (1 - alpha), 1e-6)
        << alpha;
  EXPECT_LT(spectral_radius(amplification(test::wbz(-1), 1e5)), 1e-3);
}

TEST(Amplification, IsStableAtEveryStep) {
  for (const auto& scheme :
       {test::newmark(), test::hht(-0.05), test::hht(-0.3), test::modified(-0.3), test::generalized_alpha(0),
        test::generalized_alpha(0.8), test::wbz(-0.05), test::wbz(-0.3), test::wbz(-1)})
    for (double omega = 1e-3; omega < 1e4; omega *= 1.3)
      EXPECT_LE(spectral_radius(amplification(scheme, omega)), 1 + 1e-9) << omega;
}

TEST(Amplification, OfAllFamiliesAgreesWhereTheyAreOneScheme) {
  for (const double omega : {0.1, 2., 30.}) {
    EXPECT_LT((amplification(test::hht(0), omega) - amplification(test::newmark(), omega)).norm(), 1e-12);
    EXPECT_LT((amplification(test::wbz(0), omega) - amplification(test::newmark(), omega)).norm(), 1e-12);
    EXPECT_LT((amplification(test::modified(0), omega) - amplification(test::newmark(), omega)).norm(),
              1e-12);
  }
}

} // namespace
} // namespace rubato::time::oscillator_test
