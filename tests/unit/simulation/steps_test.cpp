// SPDX-License-Identifier: LGPL-3.0-or-later
// Step by step to the end, on from mementos, and interrupted.

#include "support/model_of.hpp"
#include "support/simulated_blocks.hpp"
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace rubato::simulation::steps_test {
namespace {

using test::expect_same;
using test::go_to_end;

class Simulated : public testing::TestWithParam<test::Kind> {
protected:
  const study::Study& study() const { return GetParam().study; }
};

TEST_P(Simulated, ComesToItsEndStepByStep) {
  Simulation blocks(study());
  const bool is_explicit = study::is_explicit(study().time.scheme);
  std::vector<double> instants;
  int steps = 0;
  while (!blocks.finished()) {
    const auto next = blocks.next();
    const auto result = blocks.advance();
    ASSERT_TRUE(result.accepted());
    EXPECT_EQ(result.attempt.begin, next.begin);
    EXPECT_EQ(result.attempt.end, next.end);
    EXPECT_EQ(blocks.state().t, next.end);
    EXPECT_TRUE(result.report.converged());
    expect_same(result.energy, blocks.energy());
    EXPECT_LE(std::abs(blocks.energy().balance()), 1e-9 * blocks.energy().largest());
    steps += result.attempt.steps;
    instants.push_back(blocks.state().t);
  }
  EXPECT_EQ(instants.size(), is_explicit ? 8U : 4U);
  EXPECT_EQ(instants.back(), blocks.end());
  EXPECT_EQ(blocks.counters().steps, steps);
  EXPECT_EQ(steps, is_explicit ? 400 : 4);
  EXPECT_EQ(blocks.counters().cuts, 0);
  EXPECT_GT(step::points_in_contact(blocks.state()), 0);
  EXPECT_THROW(blocks.advance(), std::logic_error);
}

TEST_P(Simulated, GoesOnFromAMementoToTheSameBits) {
  Simulation blocks(study());
  ASSERT_TRUE(blocks.advance().accepted());
  ASSERT_TRUE(blocks.advance().accepted());
  const auto memento = blocks.memento();
  go_to_end(blocks);
  Simulation other(study(), {.memento = &memento});
  expect_same(other.memento(), memento);
  go_to_end(other);
  expect_same(other, blocks);

  blocks.restore(memento);
  EXPECT_FALSE(blocks.finished());
  expect_same(blocks.memento(), memento);
  go_to_end(blocks);
  expect_same(blocks, other);
}

TEST_P(Simulated, KeepsItsModelWhenItIsMoved) {
  Simulation blocks(study());
  ASSERT_TRUE(blocks.advance().accepted());
  auto moved = std::move(blocks);
  go_to_end(moved);
  const test::BuiltModel model(study());
  Simulation of_model(model);
  go_to_end(of_model);
  expect_same(moved, of_model);
}

/// At every moment at which it is asked; what it does then is what it would have done.
TEST_P(Simulated, KeepsItsStateWhenItIsInterrupted) {
  Simulation whole(study());
  int moments = 0;
  ASSERT_TRUE(whole.advance([&](const Moment&) { return ++moments > 0; }).accepted());
  ASSERT_GE(moments, 1);
  for (int last = 1; last <= moments; ++last) {
    Simulation blocks(study());
    const auto start = blocks.state();
    const auto energy = blocks.energy();
    int asked = 0;
    const auto result = blocks.advance([&](const Moment& moment) {
      EXPECT_EQ(moment.attempt.end, whole.state().t);
      return ++asked < last;
    });
    EXPECT_EQ(result.verdict, Verdict::interrupted) << "at moment " << last;
    EXPECT_EQ(asked, last);
    expect_same(blocks.state(), start);
    expect_same(blocks.energy(), energy);
    const auto memento = blocks.memento();
    ASSERT_TRUE(blocks.advance().accepted());
    expect_same(blocks, whole);
    Simulation resumed(study(), {.memento = &memento});
    expect_same(resumed.energy(), energy);
    ASSERT_TRUE(resumed.advance().accepted());
    expect_same(resumed, whole);
  }
}

TEST_P(Simulated, StaysWhereItWasWhenWhoeverIsAskedThrows) {
  Simulation whole(study());
  ASSERT_TRUE(whole.advance().accepted());
  Simulation blocks(study());
  const auto start = blocks.memento();
  int asked = 0;
  EXPECT_THROW(blocks.advance([&](const Moment&) -> bool {
    ++asked;
    throw std::runtime_error("enough");
  }),
               std::runtime_error);
  EXPECT_EQ(asked, 1);
  expect_same(blocks.memento(), start);
  ASSERT_TRUE(blocks.advance().accepted());
  expect_same(blocks, whole);
}

TEST_P(Simulated, LeavesStatesAloneThatOthersHold) {
  Simulation blocks(study());
  std::vector<std::shared_ptr<const step::State>> held;
  std::vector<step::State> copies;
  const auto hold = [&] {
    held.push_back(blocks.shared_state());
    copies.push_back(blocks.state());
    EXPECT_EQ(held.back().get(), &blocks.state()) << "it is no copy";
  };
  hold();
  const auto begin = blocks.memento();
  while (!blocks.finished()) {
    ASSERT_TRUE(blocks.advance().accepted());
    hold();
  }
  blocks.restore(begin);
  blocks.advance();
  blocks = Simulation(study());
  for (std::size_t i = 0; i < held.size(); ++i)
    expect_same(*held[i], copies[i]);
  EXPECT_NE(held[1]->motion.u, held[2]->motion.u);
}

TEST_P(Simulated, ComesToTheSameBitsWhetherStatesAreHeldOrNot) {
  Simulation blocks(study());
  Simulation others(study());
  const auto* place = &others.state();
  std::vector<std::shared_ptr<const step::State>> held;
  while (!blocks.finished()) {
    held.push_back(blocks.shared_state());
    blocks.advance();
    others.advance();
    EXPECT_EQ(&others.state(), place) << "nobody holds it";
  }
  expect_same(blocks, others);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Simulated, test::both_kinds(), test::name_of_kind);

} // namespace
} // namespace rubato::simulation::steps_test
