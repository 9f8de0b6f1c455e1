// SPDX-License-Identifier: LGPL-3.0-or-later
// Explicit simulations that ranks share against those of one.
#include "rubato/model/model.hpp"

#include "near_simulations.hpp"
#include "pressed_blocks.hpp"
#include "support/simulated_blocks.hpp"
#include "support/thread_ranks.hpp"
#include <optional>
#include <string>

namespace rubato::simulation::ranks_test {
namespace {

using namespace test::blocks;

struct Case {
  std::string name;
  study::Study study;
};

std::string name_of(const testing::TestParamInfo<Case>& info) {
  return info.param.name;
}

using test::of_ranks;

void expect_near(const Simulation& one, const Simulation& several) {
  test::expect_near(one.state(), several.state(), 1e-11);
  test::expect_near(one.energy(), several.energy(), 1e-12);
}

class ExplicitByRanks : public testing::TestWithParam<Case> {};

TEST_P(ExplicitByRanks, ComesToTheSame) {
  Simulation one(GetParam().study);
  test::go_to_end(one);
  EXPECT_GT(step::points_in_contact(one.state()), 20);
  for (const int count : {2, 3})
    test::as_ranks(count, [&](const Ranks& ranks) {
      Simulation several(GetParam().study, of_ranks(ranks));
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
    Simulation three(GetParam().study, of_ranks(ranks));
    ASSERT_TRUE(three.advance().accepted());
    auto memento = three.memento();
    if (ranks.is_first())
      kept = std::move(memento);
  });
  test::go_to_end(one);
  for (const int count : {1, 2})
    test::as_ranks(count, [&](const Ranks& ranks) {
      auto start = of_ranks(count == 1 ? Ranks() : ranks);
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
    Simulation several(study, of_ranks(ranks));
    const auto found = several.advance();
    ASSERT_TRUE(found.report.failed_cell);
    EXPECT_EQ(found.report.failed_cell->cell, expected.report.failed_cell->cell);
    EXPECT_EQ(found.report.failed_cell->reason, expected.report.failed_cell->reason);
    EXPECT_EQ(found.report.failed_cell->point, expected.report.failed_cell->point);
  });
}

} // namespace
} // namespace rubato::simulation::ranks_test
