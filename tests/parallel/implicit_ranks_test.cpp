// SPDX-License-Identifier: LGPL-3.0-or-later
// Implicit simulations that ranks share against those of one. Every iteration solves the whole system: the
// factor of many ranks needs processes (tests/ranks).
#include "rubato/core/error.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/domain/rank_parts.hpp"
#include "rubato/model/model.hpp"
#include "rubato/step/told_state.hpp"

#include "near_simulations.hpp"
#include "support/simulated_blocks.hpp"
#include "support/thread_ranks.hpp"
#include <optional>
#include <ostream>
#include <string>

namespace rubato::simulation::implicit_ranks_test {
namespace {

using test::of_ranks;

/// One thing after another, each in place of what the blocks have.
struct Change {
  std::string of;
  std::string to;
};

struct Case {
  std::string name;
  std::vector<Change> changes;
  std::string more = {};
};

std::string name_of(const testing::TestParamInfo<Case>& info) {
  return info.param.name;
}

/// How failures print it.
void PrintTo(const Case& wanted, std::ostream* out) {
  *out << wanted.name;
}

study::Study study_of(const Case& wanted) {
  auto deck = test::two_blocks;
  for (const auto& [of, to] : wanted.changes)
    deck = test::with(deck, of, to);
  return deck::parse_deck(deck + "solver: full\nnewton: {residual: 1e-11, max_iterations: 50}\n" +
                              wanted.more,
                          "deck.yaml")
      .runs.front();
}

class ImplicitByRanks : public testing::TestWithParam<Case> {};

void expect_near(const Simulation& one, const Simulation& several) {
  test::expect_near(one.state(), *step::ToldState(several.model(), several.state()), 1e-8);
  test::expect_near(one.energy(), several.energy(), 1e-9);
}

TEST_P(ImplicitByRanks, ComesToTheSame) {
  const auto study = study_of(GetParam());
  Simulation one(study);
  test::go_to_end(one);
  for (const int count : {2, 3})
    test::as_ranks(count, [&](const Ranks& ranks) {
      Simulation several(study, of_ranks(ranks));
      EXPECT_NE(several.model().parts, nullptr);
      EXPECT_LT(several.model().parts->cells().size(), several.model().bulk.cells.size());
      test::go_to_end(several);
      expect_near(one, several);
    });
}

/// From any number of ranks to any other.
TEST_P(ImplicitByRanks, GoesOnWithAnotherNumber) {
  const auto study = study_of(GetParam());
  Simulation one(study);
  test::go_to_end(one);
  std::optional<Memento> kept;
  test::as_ranks(3, [&](const Ranks& ranks) {
    Simulation three(study, of_ranks(ranks));
    ASSERT_TRUE(three.advance().accepted());
    ASSERT_TRUE(three.advance().accepted());
    auto memento = three.memento();
    if (ranks.is_first())
      kept = std::move(memento);
  });
  for (const int count : {1, 2})
    test::as_ranks(count, [&](const Ranks& ranks) {
      auto start = of_ranks(count == 1 ? Ranks() : ranks);
      start.memento = &*kept;
      Simulation other(study, start);
      test::go_to_end(other);
      expect_near(one, other);
    });
}

const std::string steel = "{young: 200e9, poisson: 0.3, density: 7800, cells: all}";
const std::string hht = "{scheme: hht, alpha: -0.1, step: 1e-4, end: 4e-4}";

Change metal(const std::string& more) {
  return {steel, "{young: 200e9, poisson: 0.3, density: 7800, cells: all, " + more + "}"};
}

Change stepped(const std::string& scheme) {
  return {hht, "{scheme: " + scheme + ", step: 1e-4, end: 4e-4}"};
}

const Change strained{"physics: plane_stress\nthickness: 1\n", "physics: plane_strain\n"};

INSTANTIATE_TEST_SUITE_P(
    Blocks, ImplicitByRanks,
    testing::Values(
        Case{"Elastic", {}}, Case{"Damped", {metal("rayleigh: {stiffness: 1e-6, mass: 10}")}},
        Case{"DampedByModes", {}, "modal_damping: {modes: 4, ratio: 0.05}\n"},
        Case{"HeldBySprings",
             {},
             "springs: [{on: roof, x: 1e8, y: 1e8}]\nmasses: [{on: tip, mass: 100}]\n"
             "connectors: [{on: tip, along: [0, 1], stiffness: 1e9, damping: 1e5}]\n"},
        Case{"HeldByRotatingConnectors",
             {},
             "connectors: [{on: tip, anchor: [0.1, 3], rotates: true, stiffness: 1e9, damping: 1e5}, {on: "
             "tip, "
             "anchor: [4, 1], rotates: true, force: {elongations: [-1, 1], forces: [-1e9, 2e9]}}]\n"},
        Case{"Shaken", {}, "base_motion: {y: {acceleration: 1e4}, frame: relative}\n"},
        Case{"WithoutMassOnContact",
             {{hht, "{scheme: hht, alpha: -0.1, step: 1e-4, end: 4e-4, contact_mass: redistributed}"}}},
        Case{"ByImpulses", {stepped("moreau_jean")}},
        Case{"Plastic",
             {strained, metal("law: plastic, hardening: {linear: {yield_stress: 5e7, modulus: 2e9}}")}},
        Case{"Large", {strained, metal("strain: logarithmic")}},
        Case{"PressedAfterItsFaces",
             {strained,
              metal("strain: green_lagrange"),
              {"nodal_force: {on: tip, y: -1e7}", "pressure: {on: roof, value: 2e7, follower: true}"}}},
        Case{"KeepingEnergy", {strained, metal("strain: green_lagrange"), stepped("energy_momentum")}},
        Case{"AtRest", {{hht, "{scheme: static, step: 0.25, end: 1}"}}}),
    name_of);

/// What a study is refused with.
std::string refusal_of(const study::Study& study, const Ranks& ranks) {
  try {
    Simulation simulation(study, of_ranks(ranks));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// A support moves a node through its cell: all ranks end there, and name the same one as a process alone.
TEST(ImplicitRanks, AgreeOnAFailedCell) {
  const Change pushed{"fix: [x, y]}", "fix: [x, y]}\n  - {on: tip, y: -10}"};
  const auto study = study_of({"", {strained, metal("strain: logarithmic"), pushed}});
  const auto expected = refusal_of(study, {});
  EXPECT_NE(expected.find("turned inside out"), std::string::npos);
  test::as_ranks(3, [&](const Ranks& ranks) { EXPECT_EQ(refusal_of(study, ranks), expected); });
}

} // namespace
} // namespace rubato::simulation::implicit_ranks_test
