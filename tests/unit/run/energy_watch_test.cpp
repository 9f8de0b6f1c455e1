// SPDX-License-Identifier: LGPL-3.0-or-later
// When a run warns of energy that comes from nowhere.
#include "rubato/run/energy_watch.hpp"

#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <algorithm>
#include <string>
#include <vector>

namespace rubato::run::energy_watch_test {
namespace {

class EnergyOfARun : public testing::Test {
protected:
  EnergyOfARun() {
    watch_.warn = [this](const std::string& text) { warnings_.push_back(text); };
    watch_.say = [this](const std::string& text) { said_.push_back(text); };
  }

  /// An instant of a run that loads have given 1000, of which contact, the scheme and steps of finite strain
  /// took these.
  void note(double impact, double numerical, double bulk_scheme = 0) {
    step::EnergyLedger ledger;
    ledger.external_work = 1000;
    ledger.kinetic = 1000 - impact - numerical - bulk_scheme;
    ledger.impact = impact;
    ledger.numerical = numerical;
    ledger.bulk_scheme = bulk_scheme;
    energy_.note(++t_, ledger);
  }

  std::vector<std::string> warnings_;
  std::vector<std::string> said_;

  Watch watch_;
  const std::string name_ = "evol";
  EnergyWatch energy_{name_, watch_, {}};
  double t_ = 0;
};

TEST_F(EnergyOfARun, IsNotWarnedOfWhatTheSchemeSoonTakesAgain) {
  for (int i = 0; i < 10; ++i)
    note(0, -300);
  for (int i = 0; i < 20; ++i)
    note(0, 50);
  energy_.tell();
  EXPECT_TRUE(warnings_.empty()) << warnings_.front();
  ASSERT_EQ(said_.size(), 1u);
  EXPECT_EQ(said_[0],
            "evol: energy balance within 0 of the largest energy, 1300; largest gain 0.23 of it, at t = 1, "
            "by the time scheme");
}

TEST_F(EnergyOfARun, NamesTheZoneWhosePressuresGave) {
  step::EnergyLedger ledger;
  ledger.external_work = 1000;
  ledger.kinetic = 1050;
  ledger.impact = -50;
  for (int i = 0; i < 12; ++i)
    energy_.note(++t_, ledger, "contact.joint");
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("contact pressures of contact.joint gave 50 more than they took"),
            std::string::npos)
      << warnings_[0];
}

/// The balance closes, as friction is counted with what bodies have lost.
TEST_F(EnergyOfARun, IsCheckedForWhatFrictionGivesBack) {
  EnergyWatch rubbing(name_, watch_, {}, true);
  double t = 0;
  for (const double friction : {0., 40., 25., 70., 45., 60.}) {
    step::EnergyLedger ledger;
    ledger.external_work = 1000;
    ledger.friction = friction;
    ledger.kinetic = 1000 - friction;
    rubbing.note(++t, ledger);
  }
  const auto is_friction = [](const auto& check) { return check.name == "friction_gain"; };
  const auto checks = rubbing.checks();
  const auto found = std::ranges::find_if(checks, is_friction);
  ASSERT_NE(found, checks.end());
  EXPECT_DOUBLE_EQ(found->value, 25.0 / 1000);
  EXPECT_EQ(found->t, 5);
  EXPECT_FALSE(found->passes());
  EXPECT_TRUE(std::ranges::none_of(energy_.checks(), is_friction));
}

TEST_F(EnergyOfARun, IsWarnedOfOnceWhenHourglassesHoldMuchOfIt) {
  const auto note_hourglass = [&](double strain, double plastic, double hourglass) {
    step::EnergyLedger ledger;
    ledger.external_work = 1000;
    ledger.strain = strain;
    ledger.plastic = plastic;
    ledger.hourglass = hourglass;
    ledger.kinetic = 1000 - strain - plastic - hourglass;
    energy_.note(++t_, ledger);
  };
  note_hourglass(1, 0, 0.9); // less than a thousandth of all
  note_hourglass(100, 100, 9.9);
  note_hourglass(0, 100, 9.9); // strain swings back
  EXPECT_TRUE(warnings_.empty());
  note_hourglass(100, 100, 10.1);
  note_hourglass(100, 100, 20);
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_EQ(
      warnings_[0],
      "evol: hourglasses of reduced cells hold 10.1 at t = 4, 0.0505 of what the bodies have stored and "
      "dissipated, expected at most 0.05; a finer mesh, or 'formulation: mean_dilatation', 'enhanced' or "
      "'full', cures it");
}

TEST_F(EnergyOfARun, IsWarnedOfOnceWhenTheGainStays) {
  note(0, 0);
  for (int i = 0; i < 30; ++i)
    note(-20, -1);
  energy_.tell();
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_EQ(warnings_[0],
            "evol: energy gained from t = 2 to 12: 21, 0.021 of the largest energy; contact pressures "
            "gave 20 more than they took, the time scheme gave 1");
}

/// A rigid turn has no energy but that of rounding, half of which is gained.
TEST_F(EnergyOfARun, IsNotWarnedOfWhatRoundingMayHaveGiven) {
  const auto note_rounding = [&](double rounding) {
    step::EnergyLedger ledger;
    ledger.strain = 1e-19;
    ledger.support_work = -4e-17;
    ledger.rounding = rounding;
    energy_.note(++t_, ledger);
  };
  for (int i = 0; i < 20; ++i)
    note_rounding(5e-17);
  energy_.tell();
  EXPECT_TRUE(warnings_.empty()) << warnings_.front();
  for (int i = 0; i < 20; ++i)
    note_rounding(3e-17);
  EXPECT_EQ(warnings_.size(), 1U);
}

TEST_F(EnergyOfARun, OfARigidTurnIsRounding) {
  test::Walk walk(R"(
mesh: {generate: [{name: block, rectangle: {from: [0, 0], to: [3, 1]}, divisions: [4, 2], cells: quad4, sides: {left: left}}]}
physics: plane_strain
materials: {steel: {young: 200e9, poisson: 0.3, density: 7800, strain: green_lagrange}}
functions: {f: {times: [0, 1], values: [0, 1]}}
supports: [{on: block, rotate: {about: [1, 2], angle: {value: 2, function: f}}}]
time: {scheme: static, end: 1, step: 0.02}
)");
  double worst = 0;
  walk.accepted = [&] {
    const auto ledger = walk.simulation.energy();
    energy_.note(walk.state().t, ledger);
    worst = std::max(worst, ledger.gain() / ledger.largest());
    EXPECT_LT(ledger.largest(), ledger.rounding);
    EXPECT_LT(ledger.rounding, 1e-9 * 200e9); // of what a strain of 1 would store
  };
  ASSERT_TRUE(walk.to_end());
  energy_.tell();
  EXPECT_GT(worst, 0.01);
  EXPECT_TRUE(warnings_.empty()) << warnings_.front();
}

TEST_F(EnergyOfARun, IsWarnedOfWhenContactGivesWhatTheSchemeTakes) {
  for (int i = 0; i < 11; ++i)
    note(-50, 60);
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_EQ(warnings_[0],
            "evol: energy gained from t = 1 to 11: 50, 0.05 of the largest energy; contact pressures "
            "gave 50 more than they took, the time scheme took 60");
}

TEST_F(EnergyOfARun, IsWarnedOfWhenFiniteStrainGivesWhatTheSchemeTakes) {
  for (int i = 0; i < 11; ++i)
    note(0, 60, -50);
  energy_.tell();
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_EQ(warnings_[0],
            "evol: energy gained from t = 1 to 11: 50, 0.05 of the largest energy; steps too long for finite "
            "strain or rotation gave 50 (bulk_scheme), the time scheme took 60; expected a time.scheme that "
            "damps, such as "
            "hht, energy_momentum for elastic bodies, or a shorter time.step");
  EXPECT_EQ(said_[0], "evol: energy balance within 0 of the largest energy, 1000");
}

TEST_F(EnergyOfARun, IsToldByItsLargestCause) {
  note(-5, -2, -30);
  energy_.tell();
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_TRUE(warnings_[0].ends_with(
      "; steps too long for finite strain or rotation gave 30 (bulk_scheme), contact pressures gave 5 more "
      "than they "
      "took, the time scheme gave 2; expected a time.scheme that damps, such as hht, energy_momentum for "
      "elastic bodies, or a shorter time.step"))
      << warnings_[0];
  ASSERT_EQ(said_.size(), 1u);
  EXPECT_TRUE(said_[0].ends_with("; largest gain 0.036 of it, at t = 1, by finite strain or rotation"))
      << said_[0];
}

/// What they take is an error, but no energy from nowhere.
TEST_F(EnergyOfARun, IsNotWarnedOfWhenFiniteStrainTakes) {
  for (int i = 0; i < 30; ++i)
    note(0, 0, 40);
  energy_.tell();
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(EnergyOfARun, IsWarnedOfWhenItEndsWithAGain) {
  note(0, 0);
  note(-100, 0);
  EXPECT_TRUE(warnings_.empty());
  energy_.tell();
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_TRUE(warnings_[0].starts_with("evol: energy gained from t = 2 to the end: 100, ")) << warnings_[0];
}

TEST_F(EnergyOfARun, IsNotWarnedOfBelowAHundredth) {
  for (int i = 0; i < 30; ++i)
    note(-9, 0);
  energy_.tell();
  EXPECT_TRUE(warnings_.empty());
}

} // namespace
} // namespace rubato::run::energy_watch_test
