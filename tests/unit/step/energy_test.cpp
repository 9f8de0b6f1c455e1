// SPDX-License-Identifier: LGPL-3.0-or-later
// The ledger of implicit steps is an identity of every scheme's formulas: it closes for whatever a step does.
#include "rubato/deck/read.hpp"
#include "rubato/step/advance.hpp"
#include "rubato/step/energy.hpp"
#include "rubato/step/start.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/walk.hpp"
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace rubato::step {
namespace {

using Eigen::VectorXd;

const std::string block = R"(
mesh:
  generate:
    - {name: block, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [3, 2], sides: {left: clamp, right: pulled}}
physics: plane_strain
materials: {rubber: {young: 3, poisson: 0.3, density: 2, rayleigh: {stiffness: 0.1, mass: 0.2}}}
functions: {wave: {times: [0, 1, 2], values: [0.3, 1, -1]}}
supports:
  - {on: clamp, fix: [x, y]}
  - {on: pulled, x: {value: 0.5, function: wave}}
loads: [{gravity: {y: -2, function: wave}}]
time: {scheme: newmark, step: 0.5, end: 2}
)";

struct NamedScheme {
  std::string name;
  std::vector<deck::Setting> settings;
};

const std::vector<NamedScheme> schemes{
    {"Newmark", {}},
    {"NewmarkWithBetaAndGamma", {{"time.beta", "0.4"}, {"time.gamma", "0.7"}}},
    {"Hht", {{"time.scheme", "hht"}, {"time.alpha", "-0.3"}}},
    {"ModifiedAverageAcceleration",
     {{"time.scheme", "modified_average_acceleration"}, {"time.alpha", "-0.2"}}},
    {"GeneralizedAlpha", {{"time.scheme", "generalized_alpha"}, {"time.spectral_radius", "0.2"}}},
    {"WbzAlpha", {{"time.scheme", "wbz_alpha"}, {"time.alpha", "-0.3"}}},
    {"MoreauJean", {{"time.scheme", "moreau_jean"}}},
    {"MoreauJeanBeyondTheMiddle", {{"time.scheme", "moreau_jean"}, {"time.theta", "0.8"}}},
    {"Static", {{"time.scheme", "static"}}},
};

class Ledger : public testing::TestWithParam<NamedScheme> {
protected:
  model::Model model_ =
      model::build_model(deck::parse_deck(block, "deck.yaml", GetParam().settings).runs.front());
  time::Scheme scheme_ = time::make_scheme(model_.study.time);
  std::mt19937 random_{11};

  VectorXd anything() {
    std::normal_distribution<double> normal;
    return VectorXd::NullaryExpr(model_.dofs.dof_count, [&] { return normal(random_); });
  }

  /// A state that fulfils nothing but what its parts mean.
  State any_state() {
    State state;
    state.motion = {anything(), anything(), anything()};
    if (!scheme_.dynamic)
      state.motion = {state.motion.u, 0 * state.motion.v, 0 * state.motion.a};
    state.contact_force = anything();
    state.friction_force = anything();
    state.external_force = anything();
    state.residual_force = anything();
    state.reaction = anything();
    state.bulk = bulk_forces(model_, state);
    return state;
  }

  /// Any motion that Newmark's formulas allow, with any forces.
  State any_step_from(const State& before, double h) {
    auto now = any_state();
    now.t = before.t + h;
    now.motion = time::predict(scheme_, h, before.motion);
    time::correct(time::coefficients_of(scheme_, h), anything(), now.motion);
    now.bulk = bulk_forces(model_, now);
    for (const auto& support : model_.reduction.prescribed())
      now.reaction[support.dof] = left_side(before, now)[support.dof];
    return now;
  }

  /// m₁ M a₁ + m₀ M a₀ + c₁ C v₁ + c₀ C v₀ + f₁ F₁ + f₀ F₀, as the matrices give it.
  VectorXd left_side(const State& before, const State& now) const {
    VectorXd sum =
        scheme_.forces.now * (model_.domain.initial_tangent() * now.motion.u - now.external_force) +
        scheme_.contact_weight() * now.contact_force + scheme_.forces.before * before.residual_force;
    if (scheme_.dynamic)
      sum += scheme_.inertia.now * (model_.mass * now.motion.a) +
             scheme_.inertia.before * (model_.mass * before.motion.a) +
             scheme_.damping.now * (model_.damping * now.motion.v) +
             scheme_.damping.before * (model_.damping * before.motion.v);
    return sum;
  }
};

TEST_P(Ledger, ClosesWhateverAStepDoes) {
  const auto start = any_state();
  EnergyAccount account(model_, scheme_, start);
  auto before = start;
  for (const double h : {0.5, 0.1, 2.0, 0.7}) {
    const auto now = any_step_from(before, h);
    account.enter(before, now);
    EXPECT_LE(std::abs(account.ledger().balance()), 1e-12 * account.ledger().largest());
    before = now;
  }
}

TEST_P(Ledger, HoldsTheWorkOfWhatIsLeftUnbalanced) {
  const auto before = any_state();
  const auto now = any_step_from(before, 0.5);
  EnergyAccount account(model_, scheme_, before);
  account.enter(before, now);
  const VectorXd left = left_side(before, now);
  const VectorXd moved = now.motion.u - before.motion.u;
  const double work = model_.reduction.gather(left).dot(model_.reduction.gather(moved));
  EXPECT_NEAR(account.ledger().unbalanced, work, 1e-11 * account.ledger().largest());
}

TEST_P(Ledger, MeasuresWorksByTheMeanOfBothEnds) {
  const auto before = any_state();
  const auto now = any_step_from(before, 0.5);
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

INSTANTIATE_TEST_SUITE_P(Of, Ledger, testing::ValuesIn(schemes),
                         [](const auto& chosen) { return chosen.param.name; });

/// Vibration under a load that stays: all that is lost is what the scheme dissipates. In parts of the largest
/// energy.
double lost_part(std::vector<deck::Setting> changes, double& numerical_part) {
  changes.push_back({"materials.rubber.rayleigh", ""});
  changes.push_back({"supports", "[{on: clamp, fix: [x, y]}]"});
  changes.push_back({"loads", "[{gravity: {y: -2}}]"});
  changes.push_back({"time.end", "10"});
  test::Walk walk(block, changes);
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
} // namespace rubato::step
