// SPDX-License-Identifier: LGPL-3.0-or-later
// Explicit simulations that ranks share against those of one.
#include "pressed_blocks.hpp"
#include "support/simulated_blocks.hpp"
#include "support/thread_ranks.hpp"
#include <optional>
#include <string>

namespace rubato::simulation {
namespace {

using namespace test::blocks;

struct Case {
  std::string name;
  study::Study study;
};

std::string name_of(const testing::TestParamInfo<Case>& info) {
  return info.param.name;
}

Start with(const Ranks& ranks) {
  Start start;
  start.workers = Workers(Threads(), ranks);
  return start;
}

void expect_near(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_LE((a - b).lpNorm<Eigen::Infinity>(), 1e-11 * a.lpNorm<Eigen::Infinity>());
}

void expect_near(const Simulation& one, const Simulation& several) {
  expect_near(one.state().motion.u, several.state().motion.u);
  expect_near(one.state().motion.v, several.state().motion.v);
  expect_near(one.state().motion.a, several.state().motion.a);
  expect_near(one.state().residual_force, several.state().residual_force);
  expect_near(one.state().contact_force, several.state().contact_force);
  expect_near(one.state().reaction, several.state().reaction);
  const auto& states = one.state().bulk_points.values;
  const auto& others = several.state().bulk_points.values;
  expect_near(Eigen::Map<const Eigen::VectorXd>(states.data(), std::ssize(states)),
              Eigen::Map<const Eigen::VectorXd>(others.data(), std::ssize(others)));
  const auto ledger = one.energy(), other = several.energy();
  const double allowed = 1e-12 * ledger.largest();
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

class ExplicitByRanks : public testing::TestWithParam<Case> {};

TEST_P(ExplicitByRanks, ComesToTheSame) {
  Simulation one(GetParam().study);
  test::go_to_end(one);
  EXPECT_GT(step::points_in_contact(one.state()), 20);
  for (const int count : {2, 3})
    test::as_ranks(count, [&](const Ranks& ranks) {
      Simulation several(GetParam().study, with(ranks));
      EXPECT_NE(several.model().parts, nullptr);
      test::go_to_end(several);
      expect_near(one, several);
    });
}

/// From any number of ranks to any other.
TEST_P(ExplicitByRanks, GoesOnWithAnotherNumber) {
  Simulation one(GetParam().study);
  ASSERT_TRUE(one.advance().accepted());
  std::optional<Memento> kept;
  test::as_ranks(3, [&](const Ranks& ranks) {
    Simulation three(GetParam().study, with(ranks));
    ASSERT_TRUE(three.advance().accepted());
    auto memento = three.memento();
    if (ranks.is_first())
      kept = std::move(memento);
  });
  test::go_to_end(one);
  for (const int count : {1, 2})
    test::as_ranks(count, [&](const Ranks& ranks) {
      auto start = with(count == 1 ? Ranks() : ranks);
      start.memento = &*kept;
      Simulation other(GetParam().study, start);
      test::go_to_end(other);
      expect_near(one, other);
    });
}

const std::string damped = ", rayleigh: {stiffness: 1e-8, mass: 10}";

INSTANTIATE_TEST_SUITE_P(
    Blocks, ExplicitByRanks,
    testing::Values(Case{"Elastic", pressed_blocks("", explicit_)},
                    Case{"Damped", pressed_blocks(damped, explicit_)},
                    Case{"Plastic", pressed_blocks(yields, explicit_)},
                    Case{"Reduced", pressed_blocks(yields + ", formulation: reduced", explicit_)},
                    Case{"Logarithmic", pressed_blocks(yields + ", strain: logarithmic", explicit_)}),
    name_of);

/// A cell turns inside out: all ranks end there, and name the same one as a process alone.
TEST(ExplicitRanks, AgreeOnAFailedCell) {
  const auto study = pressed_blocks(", strain: logarithmic", explicit_, "4e13");
  Simulation one(study);
  const auto expected = one.advance();
  ASSERT_TRUE(expected.report.failed_cell);
  test::as_ranks(3, [&](const Ranks& ranks) {
    Simulation several(study, with(ranks));
    const auto found = several.advance();
    ASSERT_TRUE(found.report.failed_cell);
    EXPECT_EQ(found.report.failed_cell->cell, expected.report.failed_cell->cell);
    EXPECT_EQ(found.report.failed_cell->reason, expected.report.failed_cell->reason);
    EXPECT_EQ(found.report.failed_cell->point, expected.report.failed_cell->point);
  });
}

} // namespace
} // namespace rubato::simulation
