// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/study/study.hpp"
#include "rubato/time/step_control.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace rubato::time::step_control_test {
namespace {

using Instants = std::vector<double>;

study::TimeStepping even(double step, double end) {
  study::TimeStepping settings;
  settings.step = step;
  settings.end = end;
  return settings;
}

study::TimeStepping listed(Instants instants) {
  study::TimeStepping settings;
  settings.instants = std::move(instants);
  settings.end = settings.instants.back();
  return settings;
}

/// Every target up to the end when nothing fails.
Instants walked(StepControl control) {
  Instants targets;
  for (; !control.finished(); control.accept())
    targets.push_back(control.target());
  return targets;
}

TEST(Instants, AreMultiplesOfTheStepNotSums) {
  const auto instants = instants_of(even(1e-3, 1));
  ASSERT_EQ(instants.size(), 1001u);
  EXPECT_EQ(instants[700], 0.7);
  EXPECT_EQ(instants.back(), 1);
}

TEST(Instants, AreTheDecimalNumbersThatWereMeant) {
  EXPECT_EQ(instants_of(even(1e-3, 1))[9], 0.009); // 9 · 1e-3 is 0.009000000000000001
  study::TimeStepping late = even(1e-3, 1);
  late.begin = 0.03;
  EXPECT_EQ(instants_of(late)[5], 0.035);
}

TEST(Instants, StayAsComputedWhereNoShortNumberWasMeant) {
  constexpr double third = 1e-3 / 3;
  EXPECT_EQ(instants_of(even(third, 1))[7], 7 * third);
}

TEST(Instants, EndWithAShorterStepWhenTheEndIsNoMultiple) {
  EXPECT_EQ(instants_of(even(0.25, 0.6)), (Instants{0, 0.25, 0.5, 0.6}));
}

TEST(Instants, HaveNoSliverAtTheEnd) {
  EXPECT_EQ(instants_of(even(0.1, 0.3)).size(), 4u);
  EXPECT_EQ(instants_of(even(0.1, 0.3 + 1e-9)).size(), 4u);
  EXPECT_EQ(instants_of(even(0.1, 0.3 - 1e-9)).size(), 4u);
}

TEST(Instants, LeaveAShortRestToTheLastStep) {
  EXPECT_EQ(instants_of(even(0.1, 0.3009)), (Instants{0, 0.1, 0.2, 0.3009}));
  EXPECT_EQ(instants_of(even(0.1, 0.302)), (Instants{0, 0.1, 0.2, 0.3, 0.302}));
  EXPECT_EQ(instants_of(even(0.333, 1)), (Instants{0, 0.333, 0.666, 1}));
  EXPECT_EQ(instants_of(even(0.334, 1)), (Instants{0, 0.334, 0.668, 1}));
  EXPECT_EQ(instants_of(even(1000, 1)), (Instants{0, 1}));
}

TEST(Instants, MoveToStopsThatTheyNearlyMeet) {
  auto settings = even(0.333, 1.5);
  settings.stops = {0.3325, 1, 1.2};
  EXPECT_EQ(instants_of(settings), (Instants{0, 0.3325, 0.666, 1, 1.2, 1.332, 1.5}));
  settings.stops = {0.34, 0.665, 0.667};
  EXPECT_EQ(instants_of(settings), (Instants{0, 0.333, 0.34, 0.665, 0.667, 0.999, 1.332, 1.5}))
      << "two near one end";
  settings = listed({0.1, 0.15, 0.7});
  settings.stops = {0.1001};
  EXPECT_EQ(instants_of(settings), (Instants{0, 0.1, 0.1001, 0.15, 0.7})) << "listed ones stay";
}

TEST(Instants, ListedOnesAreTakenAsTheyAre) {
  EXPECT_EQ(instants_of(listed({0.1, 0.15, 0.7})), (Instants{0, 0.1, 0.15, 0.7}));
}

TEST(Instants, HaveStopsBetweenTheSteps) {
  auto settings = even(0.1, 0.4);
  settings.stops = {0, 0.25, 0.3, 0.4};
  EXPECT_EQ(instants_of(settings), (Instants{0, 0.1, 0.2, 0.25, 0.3, 0.4}));
  settings = listed({0.1, 0.15, 0.7});
  settings.stops = {0.5, 0.7};
  EXPECT_EQ(instants_of(settings), (Instants{0, 0.1, 0.15, 0.5, 0.7}));
}

TEST(Instants, HaveNoStopBesideAnInstantThatDiffersByRounding) {
  EXPECT_EQ(with_stops({0, 0.1, 0.2, 0.3}, std::vector{3 * 0.1, 0.1 + 1e-12}), (Instants{0, 0.1, 0.2, 0.3}));
}

TEST(StepControl, GoesOnWithItsUsualLengthAfterAStop) {
  auto settings = even(0.25, 1);
  settings.stops = {0.375};
  StepControl control(settings, 0);
  std::vector<double> lengths;
  for (; !control.finished(); control.accept())
    lengths.push_back(control.length());
  EXPECT_EQ(lengths, (Instants{0.25, 0.125, 0.125, 0.25, 0.25}));
}

TEST(StepControl, WalksThroughTheInstants) {
  EXPECT_EQ(walked({even(0.25, 1), 0}), (Instants{0.25, 0.5, 0.75, 1}));
  EXPECT_EQ(walked({listed({0.1, 0.15, 0.7}), 0}), (Instants{0.1, 0.15, 0.7}));
}

TEST(StepControl, GoesOnFromTheMiddle) {
  EXPECT_EQ(walked({even(0.25, 1), 0.5}), (Instants{0.75, 1}));
  EXPECT_EQ(walked({even(0.25, 1), 0.6}), (Instants{0.75, 1}));
  EXPECT_TRUE(StepControl(even(0.25, 1), 1).finished());
}

TEST(StepControl, CutsAFailedStepIntoPartsAndComesBackToTheList) {
  auto settings = even(1, 3);
  settings.cut_parts = 4;
  StepControl control(settings, 0);
  control.accept();
  ASSERT_TRUE(control.cut());
  EXPECT_EQ(control.level(), 1);
  EXPECT_FALSE(control.target_is_listed());
  EXPECT_EQ(walked(control), (Instants{1.25, 1.5, 1.75, 2, 3}));
  for (int part = 0; part < 3; ++part)
    control.accept();
  EXPECT_EQ(control.target(), 2);
  EXPECT_TRUE(control.target_is_listed());
  EXPECT_EQ(control.level(), 1);
  control.accept();
  EXPECT_EQ(control.level(), 0);
  EXPECT_EQ(control.length(), 1);
}

TEST(StepControl, CutsAPartAgainAndGrowsBackLevelByLevel) {
  StepControl control(even(1, 2), 0);
  ASSERT_TRUE(control.cut());
  ASSERT_TRUE(control.cut());
  EXPECT_EQ(walked(control), (Instants{0.25, 0.5, 1, 2}));
  EXPECT_EQ(control.level(), 2);
  control.accept();
  control.accept();
  EXPECT_EQ(control.level(), 1);
  ASSERT_TRUE(control.cut());
  EXPECT_EQ(walked(control), (Instants{0.75, 1, 2}));
}

TEST(StepControl, StaysWhereItIsWhenAStepIsCut) {
  StepControl control(even(1, 2), 0);
  control.accept();
  control.cut();
  EXPECT_EQ(control.now(), 1);
}

TEST(StepControl, GivesUpWhenItsLevelsAreUsed) {
  auto settings = even(1, 2);
  settings.cut_levels = 3;
  StepControl control(settings, 0);
  for (int level = 1; level <= 3; ++level)
    EXPECT_TRUE(control.cut());
  EXPECT_FALSE(control.cut());
  EXPECT_EQ(control.level(), 3);
  EXPECT_EQ(control.target(), 0.125);

  settings.cut_levels = 0;
  EXPECT_FALSE(StepControl(settings, 0).cut());
}

TEST(StepControl, HasOneLengthForAllEvenSteps) {
  std::set<double> lengths;
  for (StepControl control(even(1e-3, 2), 0); !control.finished(); control.accept())
    lengths.insert(control.length());
  EXPECT_EQ(lengths, std::set<double>{1e-3});
}

TEST(StepControl, HasOneLengthForAllPartsOfALevel) {
  for (const int parts : {2, 3, 5}) {
    auto settings = even(1e-3, 0.1);
    settings.cut_parts = parts;
    std::set<double> lengths;
    StepControl control(settings, 0);
    while (!control.finished()) {
      if (control.level() == 0)
        control.cut();
      lengths.insert(control.length());
      control.accept();
    }
    EXPECT_EQ(lengths.size(), 1u) << parts;
  }
}

TEST(StepControl, HasOneLengthForListedStepsThatDifferByRounding) {
  Instants instants;
  for (double t = 0; instants.size() < 1000; instants.push_back(t)) // sums, as lists of other programs are
    t += 1e-3;
  for (double t = instants.back(); instants.size() < 2000; instants.push_back(t))
    t += 3e-4;
  std::set<double> lengths;
  for (StepControl control(listed(instants), 0); !control.finished(); control.accept())
    lengths.insert(control.length());
  EXPECT_EQ(lengths.size(), 2u);

  Instants graded;
  for (double length = 1e-3, t = 0; graded.size() < 500; length *= 1.01)
    graded.push_back(t += length);
  lengths.clear();
  for (StepControl control(listed(graded), 0); !control.finished(); control.accept())
    lengths.insert(control.length());
  EXPECT_EQ(lengths.size(), 500u);
}

TEST(StepControl, MeasuresListedStepsOneByOne) {
  StepControl control(listed({0.1, 0.15, 0.7}), 0);
  EXPECT_EQ(control.length(), 0.1);
  control.accept();
  EXPECT_EQ(control.length(), 0.15 - 0.1);
  control.accept();
  EXPECT_EQ(control.length(), 0.7 - 0.15);
}

StepControl resumed(const study::TimeStepping& settings, const StepControl::Place& place) {
  StepControl control(settings, settings.begin);
  control.go_on(place);
  return control;
}

TEST(StepControl, GoesOnFromAPlaceAmongThePartsOfACutStep) {
  StepControl control(even(1, 3), 0);
  control.accept();
  control.cut();
  control.cut();
  control.accept();
  const auto again = resumed(even(1, 3), control.place());
  EXPECT_EQ(again.level(), control.level());
  EXPECT_EQ(walked(again), walked(control));
  EXPECT_EQ(walked(again), (Instants{1.5, 2, 3}));
}

TEST(StepControl, GoesOnBeyondAnEndThatIsNoMultipleOfTheStep) {
  StepControl control(even(1, 2.5), 0);
  while (!control.finished())
    control.accept();
  EXPECT_EQ(walked(resumed(even(1, 4), control.place())), (Instants{3, 4}));
}

TEST(StepControl, TakesAnOldEndForTheInstantItDiffersFromByRounding) {
  StepControl control(even(0.1, 0.3), 0); // 3 × 0.1 is a little more than 0.3
  while (!control.finished())
    control.accept();
  EXPECT_EQ(walked(resumed(even(0.1, 0.6), control.place())), (Instants{0.4, 0.5, 0.6}));
}

TEST(StepControl, LeavesACutIntervalWhoseEndIsListedNoMore) {
  StepControl control(even(1, 2.5), 0);
  control.accept();
  control.accept();
  control.cut(); // of what led to 2.5
  control.accept();
  EXPECT_EQ(walked(resumed(even(1, 4), control.place())), (Instants{3, 4}));
}

TEST(StepControl, IsFinishedWhereItWas) {
  StepControl control(even(1, 2), 0);
  while (!control.finished())
    control.accept();
  EXPECT_TRUE(resumed(even(1, 2), control.place()).finished());
}

TEST(StepControl, IsAValue) {
  StepControl control(even(1, 3), 0);
  control.cut();
  StepControl copy = control;
  copy.accept();
  EXPECT_EQ(control.now(), 0);
  EXPECT_EQ(copy.now(), 0.5);
}

TEST(StepControl, FollowsTheIterationsOfTheBulkUpToTheLongestStep) {
  auto settings = even(0.1, 1);
  settings.max_step = 0.4;
  StepControl control(settings, 0);
  EXPECT_DOUBLE_EQ(control.target(), 0.1);
  control.accept(1); // few: twice as long
  EXPECT_DOUBLE_EQ(control.target(), 0.3);
  control.accept(6); // as many as usual: the same length, the same number
  EXPECT_EQ(control.length(), 0.2);
  EXPECT_DOUBLE_EQ(control.target(), 0.5);
  control.accept(24); // many: half as long
  EXPECT_DOUBLE_EQ(control.target(), 0.6);
  control.accept(1);
  control.accept(1);
  EXPECT_DOUBLE_EQ(control.target(), 1);
  control.accept(1);
  EXPECT_TRUE(control.finished());
}

TEST(StepControl, DividesWhatIsLeftBeforeAnInstantThatMustBeHit) {
  auto settings = even(0.4, 1);
  settings.max_step = 0.4;
  settings.stops = {0.5};
  EXPECT_EQ(walked(StepControl(settings, 0)).front(), 0.25);
  const auto instants = walked(StepControl(settings, 0));
  EXPECT_NE(std::ranges::find(instants, 0.5), instants.end());
  EXPECT_EQ(instants.back(), 1);
}

TEST(StepControl, CutsAStepOfVaryingLengthAndGoesOnFromItsPlace) {
  auto settings = even(0.4, 1);
  settings.max_step = 0.4;
  settings.cut_levels = 2;
  StepControl control(settings, 0);
  ASSERT_TRUE(control.cut());
  EXPECT_DOUBLE_EQ(control.target(), 0.2);
  EXPECT_EQ(control.level(), 1);
  ASSERT_TRUE(control.cut());
  EXPECT_FALSE(control.cut());
  control.accept(6);
  EXPECT_EQ(control.level(), 0);
  StepControl other(settings, 0);
  other.go_on(control.place());
  EXPECT_EQ(other.target(), control.target());
  EXPECT_EQ(other.place(), control.place());
}

} // namespace
} // namespace rubato::time::step_control_test
