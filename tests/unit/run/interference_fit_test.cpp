// SPDX-License-Identifier: LGPL-3.0-or-later
// Interference fits: bodies that overlap when the run begins, and the energy that the overlap gives them.
#include "rubato/contact/zone.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/run/energy_watch.hpp"
#include "rubato/step/energy.hpp"

#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

namespace rubato::run::interference_fit_test {
namespace {

using deck::Setting;
using step::EnergyAccount;
using step::EnergyLedger;

constexpr double overlap = 0.01;
constexpr double young = 1000;

/// Two blocks of side 1 between rigid walls, the upper one 0.01 too deep. Without Poisson's effect each gives
/// way by half of it: p = E · overlap / 2.
const std::string fit = R"(
mesh:
  generate:
    - {name: low, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [4, 3], sides: {bottom: ground, left: left, top: face}}
    - {name: high, rectangle: {from: [0, 0.99], to: [1, 1.99]}, divisions: [4, 3], sides: {bottom: under, left: left, top: roof}}
physics: plane_strain
materials: {rubber: {young: 1000, poisson: 0, density: 1, rayleigh: {stiffness: 1e-3, mass: 0}}}
supports: [{on: ground, fix: y}, {on: roof, fix: y}, {on: left, fix: x}]
contact: {fit: {master: face, slave: under, integration: nodes}}
time: {scheme: static, step: 1, end: 3}
)";

const std::vector<Setting> quick{{"time.step", "1e-3"}, {"time.end", "0.02"}};

std::vector<Setting> together(std::vector<Setting> settings, const std::vector<Setting>& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

/// A run with its ledger, and what it would be warned of.
struct FittedRun {
  explicit FittedRun(const std::string& deck, const std::vector<Setting>& changes) : walk(deck, changes) {
    EnergyAccount account(walk.model, walk.scheme, walk.state());
    Watch watch;
    watch.warn = [this](const std::string& text) { warning += text; };
    const std::string name = "fit";
    EnergyWatch energy(name, watch, {});
    walk.accepted = [&] {
      account.enter(walk.before, walk.state());
      energy.note(walk.state().t, account.ledger());
      EXPECT_LE(std::abs(account.ledger().balance()), 1e-10 * account.ledger().largest());
    };
    converged = walk.to_end();
    energy.tell();
    ledger = account.ledger();
  }

  test::Walk walk;
  EnergyLedger ledger;
  std::string warning;
  bool converged = false;
};

struct Named {
  std::string name;
  std::vector<Setting> settings;
};

const std::vector<Named> methods{
    {"Exact", {}},
    {"ExactWithFriction", {{"contact.fit.friction", "0.2"}}},
    {"ExactAtGaussPoints", {{"contact.fit.integration", "{gauss: 2}"}}},
    {"ExactByLoops",
     {{"contact.fit.iterate", "{geometry: fixed_point, friction: fixed_point, status: fixed_point}"}}},
    {"Penalty", {{"contact.fit.method", "penalty"}}},
    {"SoftPenalty", {{"contact.fit.method", "penalty"}, {"contact.fit.coefficients.normal", "1000"}}},
    {"NodalLagrange", {{"contact.fit.method", "nodal_lagrange"}}},
    {"NodalPenalty", {{"contact.fit.method", "nodal_penalty"}}},
    {"NodalPcg", {{"contact.fit.method", "nodal_pcg"}}},
};

class InterferenceFit : public testing::TestWithParam<Named> {};

/// Half the pressure over the whole overlap: what the blocks hold, with what springs keep of it.
TEST_P(InterferenceFit, GivesHalfItsPressureOverTheOverlap) {
  const FittedRun run(fit, GetParam().settings);
  ASSERT_TRUE(run.converged);
  const auto& ledger = run.ledger;
  const double given = 0.5 * run.walk.resultants().normal * overlap;
  EXPECT_NEAR(ledger.overlap_work, given, 1e-9 * given);
  EXPECT_NEAR(ledger.stored(), given, 1e-6 * given);
  EXPECT_NEAR(ledger.impact, 0, 1e-9 * given);
  EXPECT_EQ(run.warning, "");
  const bool springs = !study::entry_of(run.walk.model.zones[0].settings.method).exact;
  EXPECT_EQ(ledger.contact > 0, springs);
  if (!springs) {
    EXPECT_NEAR(given, 0.5 * (young * overlap / 2) * overlap, 1e-6 * given);
  }
}

TEST_P(InterferenceFit, RaisesNoAlarmInMotion) {
  for (const auto& [scheme, key, value] : {std::tuple{"hht", "alpha", "-0.3"},
                                           {"modified_average_acceleration", "alpha", "-0.3"},
                                           {"generalized_alpha", "spectral_radius", "0.5"}}) {
    const FittedRun run(fit, together(together(GetParam().settings, quick),
                                      {{"time.scheme", scheme}, {std::string("time.") + key, value}}));
    ASSERT_TRUE(run.converged) << scheme;
    EXPECT_GT(run.ledger.overlap_work, 0) << scheme;
    EXPECT_EQ(run.warning, "") << scheme;
  }
}

INSTANTIATE_TEST_SUITE_P(By, InterferenceFit, testing::ValuesIn(methods),
                         [](const auto& chosen) { return chosen.param.name; });

TEST(AnInterferenceFit, GivesTheSameOnQuadraticFacesAndOnAnObstacle) {
  const double expected = 0.5 * (young * overlap / 2) * overlap;
  for (const char* cells : {"quad8", "quad9", "tria6", "tria3"}) {
    const FittedRun run(fit, {{"mesh.generate.0.cells", cells}, {"mesh.generate.1.cells", cells}});
    ASSERT_TRUE(run.converged) << cells;
    EXPECT_NEAR(run.ledger.overlap_work, expected, 1e-6 * expected) << cells;
    EXPECT_EQ(run.warning, "") << cells;
  }
  const FittedRun run(fit, {{"mesh.generate.0.sides", "{bottom: ground, left: left}"},
                            {"contact.fit.master", ""},
                            {"contact.fit.obstacle", "{plane: {point: [0, 1], normal: [0, 1]}}"}});
  ASSERT_TRUE(run.converged);
  EXPECT_NEAR(run.ledger.overlap_work, 2 * expected, 1e-6 * expected) << "the block gives way alone";
  EXPECT_EQ(run.warning, "");
}

/// In motion the pulse that closes the overlap also throws the blocks apart, in the second step.
TEST(AnInterferenceFit, IsGoneOnWithAfterAnyStep) {
  test::Walk walk(fit, together(quick, {{"time.scheme", "hht"}, {"time.alpha", "-0.3"}}));
  EnergyAccount whole(walk.model, walk.scheme, walk.state());
  EnergyAccount parts = whole;
  double after_one = 0;
  for (int step = 1; step <= 4; ++step) {
    ASSERT_TRUE(walk.advance());
    whole.enter(walk.before, walk.state());
    parts.enter(walk.before, walk.state());
    parts = EnergyAccount(walk.model, walk.scheme, parts.ledger(), parts.overlaps());
    EXPECT_EQ(parts.ledger().overlap_work, whole.ledger().overlap_work) << "step " << step;
    EXPECT_EQ(whole.overlaps().empty(), step > 1);
    if (step == 1)
      after_one = whole.ledger().overlap_work;
  }
  EXPECT_GT(whole.ledger().overlap_work, 1.5 * after_one);
}

/// Velocities that jump close no gap: what overlaps stays.
TEST(AnInterferenceFit, IsLeftAloneByALawOfVelocities) {
  const FittedRun run(fit, together(quick, {{"time.scheme", "moreau_jean"}}));
  ASSERT_TRUE(run.converged);
  EXPECT_EQ(run.ledger.overlap_work, 0);
  EXPECT_EQ(run.warning, "");
}

/// A step later the same pressures over the same way are a gain: only what overlapped at the start counts.
TEST(AnInterferenceFit, DoesNotHideAGain) {
  test::Walk walk(fit);
  ASSERT_TRUE(walk.advance());
  EnergyAccount account(walk.model, walk.scheme, walk.before);
  account.enter(walk.before, walk.state());
  auto closed = walk.before;
  closed.zones = walk.state().zones;
  for (auto& zone : closed.zones)
    for (auto& outcome : zone.outcomes)
      outcome.gap = 0;
  Watch watch;
  std::string warning;
  watch.warn = [&](const std::string& text) { warning += text; };
  const std::string name = "fit";
  EnergyWatch energy(name, watch, {});
  energy.note(1, account.ledger());
  const double given = account.ledger().overlap_work;
  account.enter(closed, walk.state()); // once more
  energy.note(2, account.ledger());
  energy.tell();
  EXPECT_EQ(account.ledger().overlap_work, given);
  EXPECT_LT(account.ledger().impact, -0.9 * given);
  EXPECT_NE(warning.find("energy gained from t = 2 to the end"), std::string::npos) << warning;
}

/// Points between nodes penetrate a little where gaps are closed on average: they are no springs.
TEST(EnergyOfContact, IsNoneOfExactMethods) {
  const FittedRun run(fit, {{"mesh.generate.1.divisions", "[7, 3]"},
                            {"contact.fit.integration", "{gauss: 3}"},
                            {"materials.rubber.poisson", "0.3"},
                            {"supports", "[{on: ground, fix: [x, y]}, {on: roof, fix: [x, y]}]"}});
  ASSERT_TRUE(run.converged);
  EXPECT_LT(run.walk.resultants().smallest_gap, -1e-7 * overlap) << "no point penetrates";
  EXPECT_EQ(run.ledger.contact, 0);
}

} // namespace
} // namespace rubato::run::interference_fit_test
