// SPDX-License-Identifier: LGPL-3.0-or-later
// What observers are told, and that nothing has happened when one of them throws.
#include "support/simulated_blocks.hpp"
#include <stdexcept>
#include <string>
#include <vector>

namespace rubato::simulation::observers_test {
namespace {

using test::expect_same;
using test::go_to_end;

class Observed : public testing::TestWithParam<test::Kind> {
protected:
  /// Writes down what it is told under a name.
  Observer scribe(const std::string& name) {
    return {.accepted = [=, this](const AcceptedStep& step) { add(name, "accepts", step.attempt.end); },
            .rejected = [=, this](const RejectedStep& step) { add(name, "rejects", step.attempt.end); },
            .take_back = [=, this](const step::State& state) { add(name, "takes back to", state.t); }};
  }
  void add(const std::string& name, const std::string& what, double t) {
    told_.push_back(name + " " + what + " " + std::to_string(t));
  }

  Simulation blocks_{GetParam().study};
  std::vector<std::string> told_;
};

TEST_P(Observed, IsToldOfAStepBeforeItCounts) {
  const auto start = blocks_.memento();
  int last = 0;
  blocks_.observe({.accepted = [&](const AcceptedStep& step) {
    expect_same(step.before, blocks_.state());
    EXPECT_EQ(step.now.t, step.attempt.end);
    EXPECT_EQ(step.last, step.now.t == blocks_.end());
    last += step.last ? 1 : 0;
    if (step.before.t == start.state.t)
      expect_same(blocks_.memento(), start);
  }});
  step::EnergyLedger energy;
  blocks_.observe({.accepted = [&](const AcceptedStep& step) { energy = step.energy; }});
  while (!blocks_.finished()) {
    ASSERT_TRUE(blocks_.advance().accepted());
    expect_same(energy, blocks_.energy());
  }
  EXPECT_EQ(last, 1);
}

TEST_P(Observed, StandsWhereItStoodWhenAnObserverThrows) {
  Simulation undisturbed(GetParam().study);
  go_to_end(undisturbed);
  ASSERT_TRUE(blocks_.advance().accepted());
  const auto before = blocks_.memento();
  const auto energy = blocks_.energy();
  bool full = true;
  blocks_.observe(scribe("first"));
  auto second = scribe("second");
  second.accepted = [&](const AcceptedStep&) {
    if (full)
      throw std::runtime_error("the disk is full");
  };
  blocks_.observe(second);
  blocks_.observe(scribe("third"));
  EXPECT_THROW(blocks_.advance(), std::runtime_error);
  const auto t = [](double at) { return std::to_string(at); };
  EXPECT_EQ(told_, (std::vector<std::string>{"first accepts " + t(blocks_.next().end),
                                             "second takes back to " + t(blocks_.state().t),
                                             "first takes back to " + t(blocks_.state().t)}));
  expect_same(blocks_.memento(), before);
  expect_same(blocks_.energy(), energy);

  full = false;
  go_to_end(blocks_);
  expect_same(blocks_, undisturbed);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Observed, test::both_kinds(), test::name_of_kind);

} // namespace
} // namespace rubato::simulation::observers_test
