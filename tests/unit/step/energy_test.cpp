// SPDX-License-Identifier: LGPL-3.0-or-later
// The ledger of implicit steps is an identity of every scheme's formulas: it closes for whatever a step does.
#include "rubato/deck/read.hpp"
#include "rubato/domain/domain.hpp"
#include "rubato/step/advance.hpp"
#include "rubato/step/energy.hpp"
#include "rubato/step/start.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/model_parts.hpp"
#include "support/walk.hpp"
#include "unit/step/any_state.hpp"
#include <cmath>
#include <string>
#include <vector>

namespace rubato::step::energy_test {
namespace {

using Eigen::VectorXd;

using test::AnyStates;
using test::NamedScheme;

class Ledger : public testing::TestWithParam<NamedScheme> {
protected:
  AnyStates any_{GetParam()};
  const test::ModelParts& model_ = any_.model;
  const time::Scheme& scheme_ = any_.scheme;
};

TEST_P(Ledger, ClosesWhateverAStepDoes) {
  const auto start = any_.any_state();
  EnergyAccount account(model_, scheme_, start);
  auto before = start;
  for (const double h : {0.5, 0.1, 2.0, 0.7}) {
    const auto now = any_.any_step_from(before, h);
    account.enter(before, now);
    EXPECT_LE(std::abs(account.ledger().balance()), 1e-12 * account.ledger().largest());
    before = now;
  }
}

TEST_P(Ledger, HoldsTheWorkOfWhatIsLeftUnbalanced) {
  const auto before = any_.any_state();
  const auto now = any_.any_step_from(before, 0.5);
  EnergyAccount account(model_, scheme_, before);
  account.enter(before, now);
  const VectorXd left = any_.left_side(before, now);
  const VectorXd moved = now.motion.u - before.motion.u;
  const double work = model_.reduction.gather(left).dot(model_.reduction.gather(moved));
  EXPECT_NEAR(account.ledger().unbalanced, work, 1e-11 * account.ledger().largest());
}

TEST_P(Ledger, MeasuresWorksByTheMeanOfBothEnds) {
  const auto before = any_.any_state();
  const auto now = any_.any_step_from(before, 0.5);
  EnergyAccount account(model_, scheme_, before);
  account.enter(before, now);
  const auto& ledger = account.ledger();
  const VectorXd moved = now.motion.u - before.motion.u;
  const auto work = [&](const VectorXd& a, const VectorXd& b) { return 0.5 * moved.dot(a + b); };
  EXPECT_NEAR(ledger.kinetic, scheme_.dynamic ? 0.5 * now.motion.v.dot(model_.mass * now.motion.v) : 0.0,
              1e-9);
  EXPECT_NEAR(ledger.strain, 0.5 * now.motion.u.dot(model_.domain.initial_tangent() * now.motion.u), 1e-9);
  EXPECT_NEAR(ledger.external_work, work(before.external_force, now.external_force), 1e-9);
  const auto contact_work = [&](const VectorXd& a, const VectorXd& b) {
    return scheme_.nonsmooth ? moved.dot(b) : work(a, b);
  };
  EXPECT_NEAR(ledger.friction, contact_work(before.friction_force, now.friction_force), 1e-9);
  EXPECT_NEAR(ledger.friction + ledger.impact, contact_work(before.contact_force, now.contact_force), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Of, Ledger, testing::ValuesIn(test::every_implicit_scheme),
                         [](const auto& chosen) { return chosen.param.name; });

/// Vibration under a load that stays: all that is lost is what the scheme dissipates. In parts of the largest
/// energy.
double lost_part(std::vector<deck::Setting> changes, double& numerical_part) {
  changes.push_back({"materials.rubber.rayleigh", ""});
  changes.push_back({"supports", "[{on: clamp, fix: [x, y]}]"});
  changes.push_back({"loads", "[{gravity: {y: -2}}]"});
  changes.push_back({"time.end", "10"});
  test::Walk walk(test::pulled_block, changes);
  EnergyAccount account(walk.model, walk.scheme, walk.state());
  while (!walk.finished()) {
    EXPECT_TRUE(walk.advance());
    account.enter(walk.before, walk.state());
  }
  const auto& ledger = account.ledger();
  EXPECT_LE(std::abs(ledger.balance()), 1e-11 * ledger.largest());
  numerical_part = ledger.numerical / ledger.largest();
  return (ledger.external_work - ledger.stored()) / ledger.largest();
}

TEST(NumericalDissipation, IsNoneInAverageAcceleration) {
  double numerical = 0;
  EXPECT_NEAR(lost_part({}, numerical), 0, 1e-11);
  EXPECT_NEAR(numerical, 0, 1e-11);
}

TEST(NumericalDissipation, IsAllThatVibrationsLoseInSchemesThatDamp) {
  double numerical = 0;
  const double lost = lost_part({{"time.scheme", "hht"}, {"time.alpha", "-0.3"}}, numerical);
  EXPECT_GT(lost, 1e-3);
  EXPECT_NEAR(numerical, lost, 1e-11);
}

TEST(EnergyOfContact, OfPenaltySpringsIsWhatTheyTookUp) {
  test::Walk walk(test::two_beams, {{"contact.interface.method", "penalty"}});
  EnergyAccount account(walk.model, walk.scheme, walk.state());
  double largest = 0;
  while (!walk.finished()) {
    ASSERT_TRUE(walk.advance());
    account.enter(walk.before, walk.state());
    largest = std::max(largest, account.ledger().contact);
    EXPECT_LE(std::abs(account.ledger().balance()), 1e-10 * account.ledger().largest());
  }
  EXPECT_GT(largest, 0);
}

/// ½ ∫ k ⟨−g⟩² over the surface by the points of each rule, from gaps alone.
TEST(EnergyOfContact, OfPenaltySpringsIsTheIntegralOverTheSurface) {
  for (const char* integration : {"auto", "{gauss: 2}", "{gauss: 3}"}) {
    std::vector<deck::Setting> changes{{"contact.interface.method", "penalty"}};
    if (std::string(integration) != "auto")
      changes.push_back({"contact.interface.integration", integration});
    test::Walk walk(test::two_beams, changes);
    const auto system = make_effective_system(walk.model, walk.scheme, walk.length());
    EnergyAccount account(walk.model, walk.scheme, walk.state());
    double largest = 0;
    while (!walk.finished()) {
      ASSERT_TRUE(walk.advance());
      account.enter(walk.before, walk.state());
      const auto& zone = walk.model.zones.front();
      const auto& outcomes = walk.state().zones.front().outcomes;
      double integral = 0;
      for (std::size_t i = 0; i < outcomes.size(); ++i)
        if (!zone.points[i].excluded && outcomes[i].gap < 0)
          integral +=
              0.5 * zone.points[i].area * system.zones.front().normal[i] * std::pow(outcomes[i].gap, 2);
      EXPECT_NEAR(account.ledger().contact, integral, 1e-9 * account.ledger().largest()) << integration;
      largest = std::max(largest, integral);
    }
    EXPECT_GT(largest, 1e-6 * account.ledger().largest()) << integration;
  }
}

/// Between nodes points of exact contact sink in a little, as gaps close on average: there is no spring.
TEST(EnergyOfContact, IsNoneWhereGapsCloseOnAverage) {
  test::Walk walk(test::two_beams, {{"contact.interface.integration", "{gauss: 3}"}});
  EnergyAccount account(walk.model, walk.scheme, walk.state());
  double deepest = 0;
  while (!walk.finished()) {
    ASSERT_TRUE(walk.advance());
    account.enter(walk.before, walk.state());
    for (const auto& outcome : walk.state().zones.front().outcomes)
      if (outcome.pressure > 0)
        deepest = std::min(deepest, outcome.gap);
    EXPECT_EQ(account.ledger().contact, 0);
    EXPECT_LE(std::abs(account.ledger().balance()), 1e-10 * account.ledger().largest());
  }
  EXPECT_LT(deepest, 0) << "some points are to sink in";
}

TEST(EnergyRecord, KeepsTheLargestGainWithItsInstantAndCauses) {
  EnergyRecord record;
  record.note(1, {.kinetic = 3, .external_work = 2, .impact = 0.25, .numerical = -1.25});
  record.note(2, {.kinetic = 2.5, .external_work = 2, .numerical = -0.5});
  EXPECT_EQ(record.gain, 1);
  EXPECT_EQ(record.gained_at, 1);
  EXPECT_EQ(record.by_impact, -0.25);
  EXPECT_EQ(record.by_scheme, 1.25);
  EXPECT_EQ(record.largest, 3);
  EXPECT_EQ(record.largest_balance, 0);
}

} // namespace
} // namespace rubato::step::energy_test
