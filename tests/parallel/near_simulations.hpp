// SPDX-License-Identifier: LGPL-3.0-or-later
/// What simulations that ranks share are held against one of a process alone by.
#pragma once

#include "rubato/simulation/time_integration.hpp"

#include <gtest/gtest.h>

namespace rubato::test {

inline simulation::Start of_ranks(const Ranks& ranks) {
  simulation::Start start;
  start.workers = Workers(Threads(), ranks);
  return start;
}

inline void expect_near(const Eigen::VectorXd& a, const Eigen::VectorXd& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_LE((a - b).lpNorm<Eigen::Infinity>(), tolerance * a.lpNorm<Eigen::Infinity>());
}

/// States that tell what the cells of all ranks remember.
inline void expect_near(const step::State& one, const step::State& several, double tolerance) {
  expect_near(one.motion.u, several.motion.u, tolerance);
  expect_near(one.motion.v, several.motion.v, tolerance);
  expect_near(one.motion.a, several.motion.a, tolerance);
  expect_near(one.residual_force, several.residual_force, tolerance);
  expect_near(one.contact_force, several.contact_force, tolerance);
  expect_near(one.reaction, several.reaction, tolerance);
  const auto& states = one.bulk_points.values;
  const auto& others = several.bulk_points.values;
  expect_near(Eigen::Map<const Eigen::VectorXd>(states.data(), std::ssize(states)),
              Eigen::Map<const Eigen::VectorXd>(others.data(), std::ssize(others)), tolerance);
}

inline void expect_near(const step::EnergyLedger& ledger, const step::EnergyLedger& other, double tolerance) {
  const double allowed = tolerance * ledger.largest();
  EXPECT_NEAR(ledger.kinetic, other.kinetic, allowed);
  EXPECT_NEAR(ledger.strain, other.strain, allowed);
  EXPECT_NEAR(ledger.contact, other.contact, allowed);
  EXPECT_NEAR(ledger.external_work, other.external_work, allowed);
  EXPECT_NEAR(ledger.damping, other.damping, allowed);
  EXPECT_NEAR(ledger.friction, other.friction, allowed);
  EXPECT_NEAR(ledger.plastic, other.plastic, allowed);
  EXPECT_NEAR(ledger.impact, other.impact, allowed);
  EXPECT_NEAR(ledger.bulk_scheme, other.bulk_scheme, allowed);
  EXPECT_NEAR(ledger.hourglass, other.hourglass, allowed);
  EXPECT_NEAR(ledger.rounding, other.rounding, 1e-6 * ledger.rounding);
}

} // namespace rubato::test
