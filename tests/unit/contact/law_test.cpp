// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/law.hpp"
#include "rubato/contact/spring_friction.hpp"
#include "rubato/study/words.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <ostream>
#include <random>
#include <string>
#include <tuple>

namespace rubato::contact::law_test {
namespace {

using study::ContactMethod;
using study::FrictionMethod;

PointLaw law_of(ContactMethod method, FrictionMethod friction) {
  PointLaw law;
  law.method = method;
  law.friction_method = friction;
  law.friction = 0.4;
  law.normal = 50;
  law.tangential = 7;
  law.exponential = {.pressure = 3, .clearance = 0.4};
  return law;
}

const PointLaw steel = law_of(ContactMethod::augmented_lagrangian, FrictionMethod::augmented_lagrangian);
const PointLaw soft = law_of(ContactMethod::penalty, FrictionMethod::penalty);
const PointLaw spring = law_of(ContactMethod::nodal_penalty, FrictionMethod::nodal_penalty);

Eigen::Matrix<double, 6, 1> variables(const PointState& p) {
  Eigen::Matrix<double, 6, 1> v;
  v << p.gap, p.slip, p.pressure, p.semi;
  return v;
}

PointState from(const Eigen::Matrix<double, 6, 1>& v) {
  return {v[0], v.segment<2>(1), v[3], v.segment<2>(4)};
}

TEST(AugmentedLagrangianStatus, ClosesWhenPushedAndOpensWhenPulled) {
  EXPECT_EQ(wanted_status({0.1, {}, 0, {}}, steel), Status::open);
  EXPECT_EQ(wanted_status({-0.1, {0, 0}, 0, {0, 0}}, steel), Status::slip);
  EXPECT_EQ(wanted_status({0.0, {0, 0}, -3.0, {0, 0}}, steel), Status::open);
  EXPECT_EQ(wanted_status({0.0, {0, 0}, 3.0, {0.5, 0.5}}, steel), Status::stick);
  EXPECT_EQ(wanted_status({0.0, {0.1, 0}, 3.0, {0.5, 0.5}}, steel), Status::slip);
}

TEST(AugmentedLagrangianStatus, RoundingOfTheGapClosesNothing) {
  auto coefficients = steel;
  coefficients.gap_tolerance = 1e-12;
  EXPECT_EQ(wanted_status({-1e-13, {0, 0}, 0, {0, 0}}, coefficients), Status::open);
}

TEST(AugmentedLagrangianLaw, SlidingTractionOpposesTheSlip) {
  const auto response = respond({0.0, {0.5, 0}, 10.0, {1, 0}}, Status::slip, steel);
  EXPECT_DOUBLE_EQ(response.traction[0], 10.0);
  EXPECT_DOUBLE_EQ(response.traction[1], -0.4 * 10.0);
  EXPECT_DOUBLE_EQ(response.traction[2], 0.0);
  EXPECT_NEAR(response.equations.norm(), 0, 1e-15);
}

TEST(AugmentedLagrangianLaw, OpenPointsCarryNothing) {
  const auto response = respond({0.5, {0.5, 0}, 0.0, {0, 0}}, Status::open, steel);
  EXPECT_EQ(response.traction.norm(), 0.0);
  EXPECT_EQ(response.equations.norm(), 0.0);
}

TEST(PenaltyLaw, PressureIsStiffnessTimesPenetration) {
  EXPECT_EQ(wanted_status({0.01, {0, 0}, 0, {0, 0}}, soft), Status::open);
  EXPECT_DOUBLE_EQ(respond({-0.02, {0, 0}, 0, {0, 0}}, Status::slip, soft).traction[0], 1.0);
}

/// Or neither status would agree with the gap that it leads to.
TEST(PenaltyLaw, PressureBeginsWhereThePointCloses) {
  auto law = soft;
  law.gap_tolerance = 1e-6;
  EXPECT_EQ(wanted_status({.gap = -0.999e-6}, law), Status::open);
  EXPECT_NE(wanted_status({.gap = -1.001e-6}, law), Status::open);
  EXPECT_NEAR(respond({.gap = -1.001e-6}, Status::slip, law).traction[0], law.normal * 1e-9, 1e-12);
}

TEST(PenaltyLaw, FrictionGrowsWithSlipUpToItsLimit) {
  const PointState small{-0.02, {0.1, 0}, 0, {0, 0}};
  ASSERT_EQ(wanted_status(small, soft), Status::stick);
  EXPECT_DOUBLE_EQ(respond(small, Status::stick, soft).traction[1], -0.4 * 1.0 * 7 * 0.1);
  const PointState large{-0.02, {0, 3}, 0, {0, 0}};
  ASSERT_EQ(wanted_status(large, soft), Status::slip);
  EXPECT_DOUBLE_EQ(respond(large, Status::slip, soft).traction[2], -0.4);
}

/// On its way to a smaller slip: what grows with its friction is to grow with the limit.
TEST(PenaltyLaw, KeepsTheLimitOfASpringThatSticksBeyondIt) {
  const PointState far{-0.02, {3, 0}, 0, {0, 0}};
  for (auto law : {soft, spring}) {
    const auto passing = respond(far, Status::stick, law);
    const auto limited = respond(far, Status::slip, law);
    EXPECT_LT(passing.kept_friction, 1);
    EXPECT_NEAR(passing.kept_traction()[1], limited.traction[1], 1e-14 * std::abs(limited.traction[1]));
    EXPECT_EQ(passing.kept_traction()[0], passing.traction[0]);
  }
  EXPECT_EQ(respond({-0.02, {0.1, 0}, 0, {0, 0}}, Status::stick, soft).kept_friction, 1);
  auto passing = respond(far, Status::stick, soft);
  follow_limit(passing);
  EXPECT_NEAR(passing.d_traction(1, 0), respond(far, Status::slip, soft).d_traction(1, 0), 1e-12);
}

TEST(NodalPenaltyLaw, IsASpringUpToCoulombsLimit) {
  const PointState small{-0.2, {0.5, 0}, 0, {0, 0}};
  ASSERT_EQ(wanted_status(small, spring), Status::stick); // 7 · 0.5 < 0.4 · 10
  EXPECT_DOUBLE_EQ(respond(small, Status::stick, spring).traction[1], -3.5);
  const PointState large{-0.2, {0.6, 0}, 0, {0, 0}};
  ASSERT_EQ(wanted_status(large, spring), Status::slip);
  EXPECT_DOUBLE_EQ(respond(large, Status::slip, spring).traction[1], -4.0);
}

TEST(HeldThreshold, TakesThePlaceOfThePressure) {
  for (auto law : {steel, soft, spring}) {
    law.frozen_friction_pressure = 3;
    const PointState point{-0.2, {2, 0}, 10, {0, 0}};
    EXPECT_DOUBLE_EQ(respond(point, Status::slip, law).traction[1], -0.4 * 3);
    EXPECT_NE(friction_pressure(point, steel), 3);
  }
}

TEST(NodalPcgLaw, IsThatOfNodalLagrange) {
  auto law = steel;
  law.method = ContactMethod::nodal_lagrange;
  law.friction = 0;
  auto by_cg = law;
  by_cg.method = ContactMethod::nodal_pcg;
  int closed = 0;
  for (const double gap : {-0.1, 0.0, 0.2})
    for (const double pressure : {-1.0, 0.0, 5.0}) {
      const PointState point{gap, {0.1, 0}, pressure, {0, 0}};
      const auto status = wanted_status(point, law);
      closed += status != Status::open ? 1 : 0;
      EXPECT_EQ(wanted_status(point, by_cg), status) << gap << ' ' << pressure;
      const auto expected = respond(point, status, law);
      const auto found = respond(point, status, by_cg);
      EXPECT_EQ(found.traction, expected.traction) << gap << ' ' << pressure;
      EXPECT_EQ(found.d_traction, expected.d_traction) << gap << ' ' << pressure;
      EXPECT_EQ(found.equations, expected.equations) << gap << ' ' << pressure;
      EXPECT_EQ(found.d_equations, expected.d_equations) << gap << ' ' << pressure;
    }
  EXPECT_GT(closed, 2);
  EXPECT_LT(closed, 9);
}

struct LawVariant {
  const char* name;
  ContactMethod method;
  FrictionMethod friction;
};
void PrintTo(const LawVariant& variant, std::ostream* out) {
  *out << variant.name;
}

class LawTangent : public testing::TestWithParam<std::tuple<LawVariant, Status, bool>> {
protected:
  static PointLaw law() {
    const auto& [variant, status, held] = GetParam();
    auto law = law_of(variant.method, variant.friction);
    if (held)
      law.frozen_friction_pressure = 1.5;
    return law;
  }

  static void expect_derivatives(const PointLaw& law) {
    const auto status = std::get<Status>(GetParam());
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-1, 1);
    for (int trial = 0; trial < 50; ++trial) {
      Eigen::Matrix<double, 6, 1> v =
          Eigen::Matrix<double, 6, 1>::NullaryExpr([&] { return number(random); });
      v[0] = study::entry_of(law.method).exact ? v[0] : -0.5 + 0.4 * v[0];
      v[3] = 2 + number(random);
      const auto at = respond(from(v), status, law);
      for (int i = 0; i < 6; ++i) {
        constexpr double h = 1e-6;
        auto forward = v;
        auto backward = v;
        forward[i] += h;
        backward[i] -= h;
        const auto plus = respond(from(forward), status, law);
        const auto minus = respond(from(backward), status, law);
        EXPECT_LT(((plus.traction - minus.traction) / (2 * h) - at.d_traction.col(i)).norm(), 1e-6);
        EXPECT_LT(((plus.equations - minus.equations) / (2 * h) - at.d_equations.col(i)).norm(), 1e-6);
      }
    }
  }
};

TEST_P(LawTangent, IsTheDerivativeOfTheLaw) {
  expect_derivatives(law());
}

TEST_P(LawTangent, IsTheDerivativeOfFrictionAlongOneDirection) {
  auto along = law();
  along.rubs_along = Eigen::Vector2d(0.6, -0.8);
  expect_derivatives(along);
}

INSTANTIATE_TEST_SUITE_P(
    Laws, LawTangent,
    testing::Combine(
        testing::Values(
            LawVariant{"exact", ContactMethod::augmented_lagrangian, FrictionMethod::augmented_lagrangian},
            LawVariant{"exactWithPenalizedFriction", ContactMethod::augmented_lagrangian,
                       FrictionMethod::penalty},
            LawVariant{"penalty", ContactMethod::penalty, FrictionMethod::penalty},
            LawVariant{"penaltyWithExactFriction", ContactMethod::penalty,
                       FrictionMethod::augmented_lagrangian},
            LawVariant{"exponential", ContactMethod::exponential, FrictionMethod::penalty},
            LawVariant{"exponentialWithExactFriction", ContactMethod::exponential,
                       FrictionMethod::augmented_lagrangian},
            LawVariant{"nodalLagrange", ContactMethod::nodal_lagrange, FrictionMethod::nodal_penalty},
            LawVariant{"nodalPenalty", ContactMethod::nodal_penalty, FrictionMethod::nodal_penalty}),
        testing::Values(Status::open, Status::stick, Status::slip), testing::Bool()));

TEST(ExponentialLaw, HasItsPressureWhereTheSurfacesMeetAndNoneFromTheClearanceOn) {
  const auto law = law_of(ContactMethod::exponential, FrictionMethod::penalty);
  EXPECT_DOUBLE_EQ(respond({.gap = 0}, Status::slip, law).traction[0], 3);
  EXPECT_DOUBLE_EQ(respond({.gap = -0.4}, Status::slip, law).traction[0],
                   3 * 2 * (std::exp(2.0) - 1) / (std::numbers::e - 1));
  for (const double gap : {0.4, 0.5, std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(wanted_status({.gap = gap}, law), Status::open);
    EXPECT_EQ(respond({.gap = gap}, Status::slip, law).traction[0], 0) << "also while it counts as closed";
  }
}

class ExponentialCurves : public testing::TestWithParam<study::ExponentialCurve> {};

/// Closed forms, and the series that has its place near Abaqus' clearance.
TEST_P(ExponentialCurves, StoreTheIntegralOfTheirPressure) {
  const exponential::Numbers numbers{.pressure = 3, .clearance = 0.4, .curve = GetParam()};
  const double reach = exponential::reach(numbers);
  for (const double depth : {1e-3, 0.3, 0.6, 0.999, 1.001, 4.0}) {
    const double gap = reach - 0.4 * depth;
    double sum = 0;
    const int parts = 4000;
    for (int i = 0; i < parts; ++i) // the midpoint rule
      sum += exponential::pressure(gap + 0.4 * depth * (i + 0.5) / parts, numbers) * 0.4 * depth / parts;
    EXPECT_NEAR(exponential::energy_length(gap, numbers) * exponential::pressure(gap, numbers), sum,
                1e-5 * sum)
        << depth;
  }
}

TEST_P(ExponentialCurves, HaveOneGapForEachPressure) {
  const exponential::Numbers numbers{.pressure = 3, .clearance = 0.4, .curve = GetParam()};
  for (const double pressure : {1e-4, 0.01, 0.03, 0.1, 3.0, 500.0})
    EXPECT_NEAR(exponential::pressure(exponential::gap_of(pressure, numbers), numbers), pressure,
                1e-12 * pressure);
}

INSTANTIATE_TEST_SUITE_P(Both, ExponentialCurves,
                         testing::Values(study::ExponentialCurve::abaqus, study::ExponentialCurve::calculix));

/// A hundredth of p₀ is left at the clearance; the tangent there ends at c₀ (1 + 1/ln 100).
TEST(ExponentialLaw, IsThatOfCalculixUpToTheClearance) {
  const exponential::Numbers numbers{
      .pressure = 3, .clearance = 0.4, .curve = study::ExponentialCurve::calculix};
  EXPECT_DOUBLE_EQ(exponential::pressure(0, numbers), 3);
  EXPECT_NEAR(exponential::pressure(0.2, numbers), 0.3, 1e-15);
  EXPECT_NEAR(exponential::pressure(0.4, numbers), 0.03, 1e-16);
  EXPECT_NEAR(exponential::pressure(-0.4, numbers), 300, 1e-12);
  EXPECT_NEAR(exponential::reach(numbers), 0.4 * (1 + 1 / std::log(100.0)), 1e-15);
  EXPECT_EQ(exponential::pressure(exponential::reach(numbers), numbers), 0);
}

struct Spring {
  ContactMethod method;
  study::ExponentialCurve curve = study::ExponentialCurve::abaqus;
};

class SpringLaw : public testing::TestWithParam<Spring> {
protected:
  SpringLaw() {
    law_.exponential.curve = GetParam().curve;
    zone_.method = GetParam().method;
    zone_.pressure = law_.exponential.pressure;
    zone_.clearance = law_.exponential.clearance;
    zone_.curve = GetParam().curve;
  }

  double pressure(double gap) const { return respond({.gap = gap}, Status::slip, law_).traction[0]; }
  /// Held at a gap, an area [energy/area].
  double energy(double gap) const { return normal_.energy_length(gap, zone_) * pressure(gap); }

  static constexpr double h = 1e-6;
  static constexpr std::array gaps{-0.9, -0.3, -0.05};
  study::ContactZone zone_;
  PointLaw law_ = law_of(GetParam().method, study::usual_friction_method(GetParam().method));
  const NormalLaw& normal_ = normal_law(GetParam().method);
};

TEST_P(SpringLaw, HoldsTheEnergyWhoseSlopeIsItsPressure) {
  for (const double gap : gaps)
    EXPECT_NEAR((energy(gap + h) - energy(gap - h)) / (2 * h), -pressure(gap), 1e-6 * pressure(gap)) << gap;
  EXPECT_EQ(energy(normal_.reach(zone_)), 0);
}

TEST_P(SpringLaw, HasTheStiffnessThatIsTheSlopeOfItsPressure) {
  for (const double gap : gaps)
    EXPECT_NEAR((pressure(gap - h) - pressure(gap + h)) / (2 * h), normal_.stiffness({.gap = gap}, law_),
                1e-6 * normal_.stiffness({.gap = gap}, law_))
        << gap;
}

/// Whatever gap the point has: a prediction knows its force first.
TEST_P(SpringLaw, HasALineThroughTheGapThatBelongsToAPressure) {
  for (const double gap : gaps) {
    const auto line = normal_.line({.gap = 3, .pressure = pressure(gap)}, law_);
    EXPECT_NEAR(line.rest_gap - pressure(gap) / line.stiffness, gap, 1e-12);
    EXPECT_NEAR(line.stiffness, normal_.stiffness({.gap = gap}, law_), 1e-12 * line.stiffness);
  }
}

TEST_P(SpringLaw, PressesWithinItsReachOnly) {
  const double reach = normal_.reach(zone_);
  EXPECT_EQ(wanted_status({.gap = reach + h}, law_), Status::open);
  EXPECT_NE(wanted_status({.gap = reach - h}, law_), Status::open);
  EXPECT_GT(pressure(reach - h), 0);
}

INSTANTIATE_TEST_SUITE_P(
    Methods, SpringLaw,
    testing::Values(Spring{ContactMethod::penalty}, Spring{ContactMethod::exponential},
                    Spring{ContactMethod::exponential, study::ExponentialCurve::calculix}),
    [](const auto& spring) {
      return std::string(study::entry_of(spring.param.method).name) + "_" +
             std::string(study::word_of(study::exponential_curve_words, spring.param.curve));
    });

TEST(FrictionAlongOneDirection, IsThatOfOneTangent) {
  const Eigen::Vector2d only(0.6, -0.8);
  const Eigen::Vector2d across(0.8, 0.6);
  auto along = steel;
  along.rubs_along = only;
  for (const double relative : {0.3, 0.9, 1.2}) {
    const PointState one{0, {0, 0}, 3, {relative, 0}};
    const PointState turned{0, 0.4 * across, 3, relative * only + 2 * across};
    const auto status = wanted_status(one, steel);
    EXPECT_EQ(wanted_status(turned, along), status);
    const auto expected = respond(one, status, steel);
    const auto found = respond(turned, status, along);
    EXPECT_NEAR(found.traction.tail<2>().dot(only), expected.traction[1], 1e-14);
    EXPECT_NEAR(found.traction.tail<2>().dot(across), 0, 1e-14);
    EXPECT_NEAR(found.equations.tail<2>().dot(only), expected.equations[1], 1e-14);
    EXPECT_NEAR(found.equations.tail<2>().dot(across), 2, 1e-14) << "no multiplier across";
  }
}

TEST(PointVariables, KeepTheirOrder) {
  const PointState p{1, {2, 3}, 4, {5, 6}};
  EXPECT_EQ(from(variables(p)).semi[1], 6);
}

} // namespace
} // namespace rubato::contact::law_test
