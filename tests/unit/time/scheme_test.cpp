// SPDX-License-Identifier: LGPL-3.0-or-later
/// The table of schemes against the papers, and the step's arithmetic against Newmark's formulas.
#include <gtest/gtest.h>

#include "unit/time/schemes.hpp"
#include <cmath>
#include <set>
#include <stdexcept>

namespace rubato::time::scheme_test {
namespace {

void expect_weights(const Weights& weights, double now, double before) {
  EXPECT_DOUBLE_EQ(weights.now, now);
  EXPECT_DOUBLE_EQ(weights.before, before);
}

TEST(SchemeTable, NewmarkIsAverageAccelerationUnlessTold) {
  const auto scheme = test::newmark();
  EXPECT_DOUBLE_EQ(scheme.beta, 0.25);
  EXPECT_DOUBLE_EQ(scheme.gamma, 0.5);
  expect_weights(scheme.forces, 1, 0);
  expect_weights(scheme.inertia, 1, 0);

  study::TimeStepping settings;
  settings.scheme = study::SchemeKind::newmark;
  settings.beta = 1. / 6;
  settings.gamma = 0.5;
  const auto linear = make_scheme(settings);
  EXPECT_DOUBLE_EQ(linear.beta, 1. / 6);
  EXPECT_DOUBLE_EQ(linear.gamma, 0.5);
}

TEST(SchemeTable, HilberHughesTaylorWeighsForcesAndNothingElse) {
  for (const double alpha : {0., -0.1, -0.3, -1. / 3}) {
    const auto scheme = test::hht(alpha);
    EXPECT_DOUBLE_EQ(scheme.beta, (1 - alpha) * (1 - alpha) / 4);
    EXPECT_DOUBLE_EQ(scheme.gamma, 0.5 - alpha);
    expect_weights(scheme.forces, 1 + alpha, -alpha);
    expect_weights(scheme.inertia, 1, 0);
    expect_weights(scheme.damping, 1, 0);
  }
}

TEST(SchemeTable, ModifiedAverageAccelerationHasHilbersPairAndTheBalanceOfTheEnd) {
  const auto scheme = test::modified(-0.3);
  EXPECT_DOUBLE_EQ(scheme.beta, 1.69 / 4);
  EXPECT_DOUBLE_EQ(scheme.gamma, 0.8);
  expect_weights(scheme.forces, 1, 0);
}

TEST(SchemeTable, MoreauAndJeanWeighForcesByThetaAndContactByOne) {
  for (const double theta : {0.5, 0.8, 1.}) {
    const auto scheme = test::moreau_jean(theta);
    expect_weights(scheme.forces, theta, 1 - theta);
    expect_weights(scheme.damping, theta, 1 - theta);
    expect_weights(scheme.inertia, 1, 0);
    EXPECT_EQ(scheme.contact_weight(), 1);
    EXPECT_FALSE(scheme.remembers_contact());
  }
}

TEST(SchemeTable, EnergyMomentumIsMoreauAndJeanInTheMiddleWithForcesOfTheStep) {
  const auto scheme = test::energy_momentum();
  const auto other = test::moreau_jean(0.5);
  EXPECT_TRUE(scheme.nonsmooth);
  EXPECT_EQ(scheme.beta, other.beta);
  EXPECT_EQ(scheme.gamma, other.gamma);
  expect_weights(scheme.forces, 0.5, 0.5);
  expect_weights(scheme.damping, 0.5, 0.5);
  EXPECT_EQ(scheme.internal_weight(), 1);
  EXPECT_EQ(other.internal_weight(), 0.5);
  EXPECT_FALSE(scheme.remembers_internal());
  EXPECT_TRUE(other.remembers_internal());
  EXPECT_EQ(coefficients_of(scheme, 0.1).stiffness, 0.5);
}

/// u₁ = u₀ + h (θ v₁ + (1−θ) v₀), a₁ = (v₁ − v₀)/h, whatever a₀ was.
TEST(SchemeStep, OfMoreauAndJeanIsTheThetaMethodOnVelocities) {
  const double h = 0.3;
  const double theta = 0.7;
  const auto scheme = test::moreau_jean(theta);
  const auto start = test::motion(1.5, -2, 77);
  auto end = predict(scheme, h, start);
  correct(coefficients_of(scheme, h), Eigen::VectorXd::Constant(1, 0.4), end);
  EXPECT_NEAR(end.u[0], start.u[0] + h * (theta * end.v[0] + (1 - theta) * start.v[0]), 1e-14);
  EXPECT_NEAR(end.a[0], (end.v[0] - start.v[0]) / h, 1e-13);
}

TEST(SchemeTable, ChungAndHulbertFollowFromTheSpectralRadius) {
  for (const double rho : {0., 0.5, 0.8, 1.}) {
    const double alpha_m = (2 * rho - 1) / (rho + 1), alpha_f = rho / (rho + 1);
    const auto scheme = test::generalized_alpha(rho);
    EXPECT_DOUBLE_EQ(scheme.gamma, 0.5 - alpha_m + alpha_f);
    EXPECT_DOUBLE_EQ(scheme.beta, std::pow(1 - alpha_m + alpha_f, 2) / 4);
    expect_weights(scheme.forces, 1 - alpha_f, alpha_f);
    expect_weights(scheme.damping, 1 - alpha_f, alpha_f);
    expect_weights(scheme.inertia, 1 - alpha_m, alpha_m);
  }
}

TEST(SchemeTable, WoodBossakZienkiewiczWeighInertiaAndNothingElse) {
  for (const double alpha : {0., -0.1, -0.3, -1.}) {
    const auto scheme = test::wbz(alpha);
    EXPECT_DOUBLE_EQ(scheme.beta, (1 - alpha) * (1 - alpha) / 4);
    EXPECT_DOUBLE_EQ(scheme.gamma, 0.5 - alpha);
    expect_weights(scheme.inertia, 1 - alpha, alpha);
    expect_weights(scheme.forces, 1, 0);
    expect_weights(scheme.damping, 1, 0);
  }
}

TEST(SchemeTable, WeightsOfEveryDynamicSchemeSumToOne) {
  for (const auto& entry : study::schemes) {
    if (study::is_explicit(entry.kind))
      continue;
    const auto scheme = test::scheme_of(entry.kind, -0.2);
    EXPECT_DOUBLE_EQ(scheme.forces.now + scheme.forces.before, 1) << entry.name;
    EXPECT_DOUBLE_EQ(scheme.inertia.now + scheme.inertia.before, scheme.dynamic ? 1 : 0) << entry.name;
  }
}

TEST(SchemeTable, HasNoWeightsOfAnExplicitScheme) {
  EXPECT_THROW(test::scheme_of(study::SchemeKind::central_difference), std::invalid_argument);
}

TEST(SchemeTable, NamesEachSchemeOnce) {
  std::set<std::string_view> names;
  std::set<study::SchemeKind> kinds;
  for (const auto& entry : study::schemes) {
    names.insert(entry.name);
    kinds.insert(entry.kind);
  }
  for (const auto& entry : study::schemes)
    EXPECT_EQ(study::entry_of(entry.kind).name, entry.name);
  EXPECT_EQ(names.size(), study::schemes.size());
  EXPECT_EQ(kinds.size(), study::schemes.size());
}

TEST(Step, KeepsNewmarksFormulasWhateverTheCorrection) {
  const double h = 0.37, u0 = 1.3, v0 = -0.7, a0 = 2.9;
  for (const auto& scheme : {test::newmark(), test::hht(-0.3), test::modified(-0.2),
                             test::generalized_alpha(0.6), test::wbz(-0.4)})
    for (const double d : {0., 0.8, -11.}) {
      auto end = predict(scheme, h, test::motion(u0, v0, a0));
      correct(coefficients_of(scheme, h), Eigen::VectorXd::Constant(1, d), end);
      EXPECT_DOUBLE_EQ(end.u[0], u0 + d);
      EXPECT_NEAR(end.u[0], u0 + h * v0 + h * h * ((0.5 - scheme.beta) * a0 + scheme.beta * end.a[0]), 1e-13);
      EXPECT_NEAR(end.v[0], v0 + h * ((1 - scheme.gamma) * a0 + scheme.gamma * end.a[0]), 1e-12);
    }
}

TEST(Step, IsPredictedWhereItStartsAndIsExactForUniformAcceleration) {
  const double h = 0.1, v0 = 2, a0 = -3;
  for (const auto& scheme : {test::newmark(), test::hht(-0.1), test::generalized_alpha(0.)}) {
    auto end = predict(scheme, h, test::motion(5, v0, a0));
    EXPECT_DOUBLE_EQ(end.u[0], 5);
    correct(coefficients_of(scheme, h), Eigen::VectorXd::Constant(1, h * v0 + h * h * a0 / 2), end);
    EXPECT_NEAR(end.a[0], a0, 1e-12);
    EXPECT_NEAR(end.v[0], v0 + h * a0, 1e-12);
  }
}

TEST(Step, OfAStaticSchemeMovesNoMass) {
  const auto scheme = test::scheme_of(study::SchemeKind::static_steps);
  EXPECT_FALSE(scheme.dynamic);
  const auto c = coefficients_of(scheme, 0.1);
  EXPECT_EQ(c.mass, 0);
  EXPECT_EQ(c.damping, 0);
  EXPECT_EQ(c.velocity, 0);
  EXPECT_EQ(c.stiffness, 1);
  const auto end = predict(scheme, 0.1, test::motion(1, 2, 3));
  EXPECT_EQ(end.u[0], 1);
  EXPECT_EQ(end.v[0], 0);
  EXPECT_EQ(end.a[0], 0);
}

TEST(Step, HasTheEffectiveMatrixOfItsScheme) {
  const double h = 0.2;
  for (const auto& scheme : {test::newmark(), test::hht(-0.3), test::generalized_alpha(0.4)}) {
    const auto c = coefficients_of(scheme, h);
    EXPECT_DOUBLE_EQ(c.mass, scheme.inertia.now / (scheme.beta * h * h));
    EXPECT_DOUBLE_EQ(c.damping, scheme.damping.now * scheme.gamma / (scheme.beta * h));
    EXPECT_DOUBLE_EQ(c.stiffness, scheme.forces.now);
  }
}

} // namespace
} // namespace rubato::time::scheme_test
