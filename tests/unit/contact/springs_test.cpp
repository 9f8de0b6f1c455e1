// SPDX-License-Identifier: LGPL-3.0-or-later
// Rows of the tables of methods, and what springs and augmentations follow from them.
#include "rubato/contact/law.hpp"
#include "rubato/contact/springs.hpp"
#include "rubato/study/contact_methods.hpp"

#include <gtest/gtest.h>

namespace rubato::contact::springs_test {
namespace {

Zone zone_by(study::ContactMethod method) {
  Zone zone;
  zone.settings.method = method;
  zone.settings.friction = 0.3;
  zone.settings.friction_method = study::usual_friction_method(method);
  zone.points.resize(2);
  zone.points[0].weight = 0.5;
  zone.points[1].weight = 2;
  return zone;
}

const ZoneCoefficients coefficients{{10, 20}, {3, 50}, {}};

ZoneLaw law_of(const Zone& zone) {
  return {&zone, &coefficients, zone.settings.friction};
}

/// Of the second point, which is apart.
double stiffness_by(study::ContactMethod method) {
  const auto zone = zone_by(method);
  return spring_stiffness(law_of(zone), std::vector<PointEvaluation>(2))[1];
}

TEST(TablesOfMethods, HaveARowEachInTheOrderOfTheMethods) {
  for (const auto& entry : study::contact_methods) {
    EXPECT_EQ(&study::entry_of(entry.method), &entry) << entry.name;
    EXPECT_EQ(normal_law(entry.method).method, entry.method) << entry.name;
    EXPECT_NE(normal_law(entry.method).coefficient->is_spring, entry.exact) << entry.name;
    EXPECT_FALSE(study::entry_of(entry.softer).exact) << entry.name;
    EXPECT_EQ(study::entry_of(entry.softer).nodal, entry.nodal) << entry.name;
    for (const auto friction : entry.friction)
      EXPECT_EQ(study::entry_of(friction).nodal, entry.nodal) << entry.name;
  }
  for (const auto& entry : study::friction_methods) {
    EXPECT_EQ(&study::entry_of(entry.method), &entry) << entry.name;
    EXPECT_EQ(friction_law(entry.method).method, entry.method) << entry.name;
    EXPECT_NE(friction_law(entry.method).role->is_spring, entry.exact) << entry.name;
  }
}

TEST(Springs, GiveWayAndHoldEnergyWhereGapsDoNotClose) {
  const ZoneState pressed{
      {}, {Status::slip, Status::open}, {{.gap = -0.1, .normal = {0, 3, 4}}, {.gap = 0.2}}, {}, {}, {}};
  const auto soft = zone_by(study::ContactMethod::penalty);
  EXPECT_DOUBLE_EQ(penetration(law_of(soft), 0, 0.5, 0, -0.1).compliance, 1 / (10 * 0.5));
  EXPECT_EQ(penetration(law_of(soft), 0, 0.5, 0, -0.1).rest_gap, 0);
  EXPECT_DOUBLE_EQ(stored_energy(soft, pressed), 0.5 * 0.1 * 5);
  EXPECT_DOUBLE_EQ(spring_depth(soft, pressed.outcomes[0]), 0.1);
  const auto exact = zone_by(study::ContactMethod::augmented_lagrangian);
  EXPECT_EQ(penetration(law_of(exact), 0, 0.5, 0, -0.1, 7).compliance, 7);
  EXPECT_EQ(stored_energy(exact, pressed), 0);
  EXPECT_EQ(spring_depth(exact, pressed.outcomes[0]), 0);
}

TEST(Springs, OfFrictionCountWhereThePressureDoesNotChangeThem) {
  EXPECT_EQ(stiffness_by(study::ContactMethod::augmented_lagrangian), 0);
  EXPECT_DOUBLE_EQ(stiffness_by(study::ContactMethod::penalty), 2 * 20);
  EXPECT_DOUBLE_EQ(stiffness_by(study::ContactMethod::nodal_lagrange), 50);
  EXPECT_DOUBLE_EQ(stiffness_by(study::ContactMethod::nodal_penalty), 50);
  auto given = zone_by(study::ContactMethod::nodal_lagrange);
  given.settings.normal_coefficient = 7;
  given.settings.tangential_coefficient = 8;
  ASSERT_EQ(given_springs(given).size(), 1U);
  EXPECT_EQ(given_springs(given)[0].key, "tangential");
  EXPECT_EQ(given_springs(given)[0].value, 8);
  given.settings.friction = 0;
  EXPECT_TRUE(given_springs(given).empty());
  EXPECT_FALSE(has_augmentation(zone_by(study::ContactMethod::nodal_penalty)));
}

TEST(Augmentations, AreScaledAndLimitedWhereSpringsStay) {
  auto exact = coefficients;
  scale_augmentations(zone_by(study::ContactMethod::augmented_lagrangian), 2, 10, exact);
  EXPECT_EQ(exact.normal, (std::vector{20.0, 40.0}));
  EXPECT_EQ(exact.tangential, (std::vector{30.0, 500.0}));
  auto nodal = coefficients;
  scale_augmentations(zone_by(study::ContactMethod::nodal_lagrange), 2, 10, nodal);
  EXPECT_EQ(nodal.normal, (std::vector{20.0, 40.0}));
  EXPECT_EQ(nodal.tangential, coefficients.tangential);
  auto soft = coefficients;
  scale_augmentations(zone_by(study::ContactMethod::penalty), 2, 10, soft);
  limit_augmentations(zone_by(study::ContactMethod::penalty), 1, soft);
  EXPECT_EQ(soft.normal, coefficients.normal);
  auto limited = coefficients;
  limit_augmentations(zone_by(study::ContactMethod::augmented_lagrangian), 10, limited);
  EXPECT_EQ(limited.normal, (std::vector{10.0, 5.0}));
  auto given = zone_by(study::ContactMethod::augmented_lagrangian);
  given.settings.normal_coefficient = 7;
  limited = coefficients;
  limit_augmentations(given, 1, limited);
  EXPECT_EQ(limited.normal, coefficients.normal);
}

TEST(Springs, KeepTheirStiffnessWhateverTheStep) {
  const auto usual = ZoneCoefficients{{1, 2}, {3, 4}, {}};
  auto soft = coefficients;
  keep_springs(zone_by(study::ContactMethod::penalty), usual, soft);
  EXPECT_EQ(soft.normal, usual.normal);
  auto nodal = coefficients;
  keep_springs(zone_by(study::ContactMethod::nodal_lagrange), usual, nodal);
  EXPECT_EQ(nodal.normal, coefficients.normal);
  EXPECT_EQ(nodal.tangential, usual.tangential);
  auto exact = coefficients;
  keep_springs(zone_by(study::ContactMethod::augmented_lagrangian), usual, exact);
  EXPECT_EQ(exact.tangential, coefficients.tangential);
}

} // namespace
} // namespace rubato::contact::springs_test
