// SPDX-License-Identifier: LGPL-3.0-or-later
// Explicit runs: the steps they choose, what they refuse, and what they write.
#include "rubato/deck/read.hpp"
#include "rubato/results/checkpoint.hpp"
#include "rubato/results/csv.hpp"
#include "rubato/run/run_study.hpp"
#include "rubato/simulation/simulation.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/model_of.hpp"
#include "support/scratch_folder.hpp"
#include "support/simulated_blocks.hpp"
#include "support/two_blocks.hpp"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace rubato::run::explicit_run_test {
namespace {

using test::fault_of;
using test::with;

const std::string hht = "{scheme: hht, alpha: -0.1, step: 1e-4, end: 4e-4}";

study::Study explicit_study(const std::string& more = "") {
  const auto time = "{scheme: central_difference, end: 4e-4, record: 5e-5" + more + "}";
  const auto deck =
      with(with(test::two_blocks, hht, time), "friction: 0.2", "friction: 0.2, method: penalty");
  return deck::parse_deck(deck, "deck.yaml").runs.front();
}

class ExplicitRun : public testing::Test {
protected:
  RunResult run(const study::Study& study) {
    Watch watch;
    watch.say = [this](const std::string& text) { said_ += text + "\n"; };
    watch.warn = [this](const std::string& text) { warned_.push_back(text); };
    return run_study(study, folder_ / study.name, watch);
  }
  results::Table table(const std::string& name) const { return results::read_csv(folder_ / "run" / name); }

  test::ScratchFolder folder_;
  std::string said_;
  std::vector<std::string> warned_;
};

TEST_F(ExplicitRun, RecordsAtEqualInstantsAndSaysItsStep) {
  const auto result = run(explicit_study());
  ASSERT_EQ(result.status, Status::complete) << result.message;
  for (const auto* name : {"probes.csv", "energy.csv"}) {
    const auto rows = table(name).rows;
    ASSERT_EQ(rows.size(), 9u) << name;
    for (std::size_t i = 0; i < rows.size(); ++i)
      EXPECT_NEAR(rows[i][0], 5e-5 * static_cast<double>(i), 1e-18) << name;
  }
  EXPECT_EQ(table("resultants_interface.csv").rows.size(), 8u);
  EXPECT_GE(result.steps, 8);
  EXPECT_NE(said_.find("stable step"), std::string::npos) << said_;
  EXPECT_NE(said_.find("energy balance within"), std::string::npos) << said_;
}

TEST_F(ExplicitRun, ClosesItsEnergy) {
  const auto result = run(explicit_study());
  EXPECT_LE(result.energy.largest_balance, 1e-12 * result.energy.largest);
  const auto energy = table("energy.csv");
  const auto last = [&](const char* name) {
    return energy.rows.back()[static_cast<std::size_t>(energy.column(name))];
  };
  EXPECT_NE(last("impact"), 0);
  EXPECT_LT(std::abs(last("impact")), 5e-3 * last("external_work"));
  EXPECT_NEAR(last("external_work"),
              last("kinetic") + last("strain") + last("contact") + last("friction") + last("impact"),
              1e-12 * last("external_work"));
}

/// A lining of one layer that a grip presses on a block: static runs have N = 55. The springs that a run
/// takes by itself follow the mass of their nodes, and are softer than the lining.
TEST_F(ExplicitRun, SaysWhereItsOwnSpringsAreSofterThanALining) {
  const auto study_of = [](const std::string& more) {
    return deck::parse_deck(R"(
mesh:
  generate:
    - {name: block, rectangle: {from: [0, 0], to: [5, 3]}, divisions: [1, 2], sides: {left: middle, right: face}}
    - {name: pad, rectangle: {from: [5, 0], to: [6, 3]}, divisions: [1, 3], sides: {left: lining, right: grip}}
physics: plane_strain
materials:
  steel: {young: 2e5, poisson: 0.3, density: 1.4e-4, cells: block}
  rubber: {young: 1000, poisson: 0.4, density: 1.2e-9, cells: pad}
functions: {squeeze: {ramp: [0, 0.01]}}
supports: [{on: middle, fix: [x, y]}, {on: grip, x: {value: -0.01, function: squeeze}, y: 0}]
contact: {grip: {slave: lining, master: face, friction: 0.43, method: penalty)" +
                                more +
                                R"(}}
time: {scheme: central_difference, record: 1e-4, end: 0.02}
)",
                            "deck.yaml")
        .runs.front();
  };
  ASSERT_EQ(run(study_of("")).status, Status::complete);
  ASSERT_EQ(warned_.size(), 1U);
  EXPECT_NE(warned_[0].find("the springs of contact.grip held 5.1 times what the bodies stored"),
            std::string::npos)
      << warned_[0];
  EXPECT_NE(warned_[0].find("expected 'coefficients: {normal: 200000}' or more"), std::string::npos)
      << warned_[0];
  warned_.clear();
  ASSERT_EQ(run(study_of(", coefficients: {normal: 2e5}")).status, Status::complete);
  EXPECT_TRUE(warned_.empty()) << warned_.front();
  const auto forces = table("resultants_grip.csv");
  EXPECT_NEAR(forces.rows.back()[static_cast<std::size_t>(forces.column("normal"))], 55.5, 1);
}

TEST_F(ExplicitRun, TakesTheStepItIsGivenUnlessThatIsUnstable) {
  EXPECT_EQ(run(explicit_study(", step: 1e-6")).steps, 400);
  const auto fault = fault_of([&] { run_study(explicit_study(", step: 1e-4"), folder_ / "refused", {}); });
  EXPECT_NE(fault.find("time.step: found 0.0001, expected at most the stable step of this model, "),
            std::string::npos)
      << fault;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "refused"));
}

/// A die without density, with every scheme: it is held whole, or moved by its supports.
TEST_F(ExplicitRun, AndEveryOtherTakesAWeightlessBodyThatIsHeldWhole) {
  auto held = with(with(test::two_blocks, "density: 7800, cells: all", "density: 7800, cells: upper"),
                   "supports:", "  die: {young: 200e9, poisson: 0.3, density: 0, cells: lower}\nsupports:");
  held = with(held, "{left: held, top: lower_face}", "{left: die_left, top: lower_face}");
  held = with(held, "exclude_nodes: [held]", "exclude_nodes: [held, die_left]");
  held = with(held, "  - {on: held, fix: [x, y]}",
              "  - {on: held, fix: [x, y]}\n  - {on: lower, x: 0, y: {value: 1e-5, function: ramp}}");
  held = with(held, "supports:", "functions: {ramp: {times: [0, 4e-4], values: [0, 1]}}\nsupports:");
  for (const auto& time :
       {hht, std::string("{step: 1e-4, end: 4e-4}"), std::string("{scheme: newmark, step: 1e-4, end: 4e-4}"),
        std::string("{scheme: hht, alpha: -0.1, contact_mass: redistributed, step: 1e-4, end: 4e-4}"),
        std::string("{scheme: central_difference, end: 4e-4, record: 1e-4}")}) {
    auto deck = with(held, hht, time);
    if (time.find("central") != std::string::npos)
      deck = with(deck, "friction: 0.2", "friction: 0.2, method: penalty");
    const auto result = run(deck::parse_deck(deck, "deck.yaml").runs.front());
    EXPECT_EQ(result.status, Status::complete) << time << result.message;
    EXPECT_TRUE(result.end.motion.a.allFinite()) << time;
    EXPECT_LE(result.energy.largest_balance, 1e-9 * result.energy.largest) << time;
    EXPECT_GT(result.end.contact_force.norm(), 0) << time;
  }
}

TEST_F(ExplicitRun, StopsWhenItIsAsked) {
  Watch watch;
  int looks = 0;
  watch.stop = [&] { return ++looks > 3; };
  const auto result = run_study(explicit_study(), folder_ / "run", watch);
  EXPECT_EQ(result.status, Status::interrupted);
  EXPECT_EQ(table("probes.csv").rows.size(), 4u);
}

/// A tied bar over a floor that it rubs on, with a rigid end that has a mass; a support of the end is gone
/// after half of the run. Files of its records lead to the same bits.
TEST(ExplicitRunWithRelations, GoesOnFromFilesToTheSameBits) {
  const auto study = test::study_of(R"(
mesh:
  generate:
    - {name: foot, rectangle: {from: [0, 0], to: [2, 1]}, divisions: [4, 2], sides: {left: ground, right: seam}}
    - {name: head, rectangle: {from: [2, 0], to: [4, 1]}, divisions: [6, 3], sides: {left: joint, right: tip, bottom: sole}}
physics: plane_strain
materials: {steel: {young: 100, poisson: 0.3, density: 1}}
functions: {swing: {sine: {frequency: 2}}}
supports: [{on: ground, fix: [x, y]}, {on: cap, x: {value: 0.02, function: swing}, until: 0.3}]
loads: [{surface_force: {on: tip, y: -0.5}}]
relations: {cap: {rigid: {on: tip}}}
masses: [{on: cap, mass: 0.2}]
contact:
  tie: {master: seam, slave: joint, tie: true}
  floor: {obstacle: {plane: {point: [0, -0.001], normal: [0, 1]}}, slave: sole, friction: 0.3, method: penalty, integration: nodes}
time: {scheme: central_difference, end: 0.6, record: 0.1}
)");
  const test::ScratchFolder folder;
  simulation::Simulation whole(study);
  std::vector<std::filesystem::path> files;
  while (!whole.finished()) {
    ASSERT_TRUE(whole.advance().accepted());
    results::Checkpoint checkpoint;
    checkpoint.memento = whole.memento();
    files.push_back(folder / ("checkpoint_" + std::to_string(files.size()) + ".h5"));
    results::write_checkpoint(files.back(), checkpoint);
  }
  EXPECT_GT(whole.state().contact_force.norm(), 0);
  EXPECT_LT(std::abs(whole.energy().balance()), 1e-12 * whole.energy().largest());
  for (std::size_t i = 0; i + 1 < files.size(); ++i) {
    const auto memento = results::read_checkpoint(files[i]).memento;
    simulation::Simulation resumed(whole.model(), {.memento = &memento});
    test::go_to_end(resumed);
    SCOPED_TRACE(testing::Message() << "after record " << i + 1);
    test::expect_same(resumed, whole);
    EXPECT_EQ(resumed.energy().support_work, whole.energy().support_work) << i;
  }
}

/// The block comes from beyond the floor's left end at 10 m/s, its bottom `depth` below the top of the floor.
study::Study from_beyond(double depth) {
  const auto deck = fmt::format(R"(
mesh:
  generate:
    - {{name: block, rectangle: {{from: [-0.57, {0}], to: [-0.07, 0.5]}}, divisions: [5, 5], cells: quad4, sides: {{bottom: under}}}}
    - {{name: floor, rectangle: {{from: [0, -0.5], to: [2, 0]}}, divisions: [13, 3], cells: quad4, sides: {{top: over, bottom: ground}}}}
physics: plane_strain
materials: {{steel: {{young: 1e7, poisson: 0.3, density: 1000}}}}
supports: [{{on: ground, fix: [x, y]}}]
initial: [{{on: block, velocity: {{x: 10}}}}]
contact: {{rest: {{master: over, slave: under, method: penalty, integration: nodes}}}}
time: {{scheme: central_difference, end: 0.006}}
)",
                                -depth);
  return deck::parse_deck(deck, "deck.yaml").runs.front();
}

TEST_F(ExplicitRun, WarnsOfASlaveNodeThatComesFromBeyondTheMasterBehindIt) {
  const auto told = [this] {
    return std::ranges::count_if(warned_, [](const std::string& text) {
      return text.find("of the slave of contact.rest came onto the master from beyond its border and lies "
                       "0.01 behind it; its spring keeps this depth") != std::string::npos;
    });
  };
  run(from_beyond(0.01));
  EXPECT_EQ(told(), 1);
  warned_.clear();
  run(from_beyond(0.001));
  EXPECT_TRUE(std::ranges::none_of(warned_, [](const std::string& text) {
    return text.find("from beyond") != std::string::npos;
  })) << "a hundredth of a face";
}

} // namespace
} // namespace rubato::run::explicit_run_test
