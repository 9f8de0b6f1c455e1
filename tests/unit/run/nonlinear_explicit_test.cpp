// SPDX-License-Identifier: LGPL-3.0-or-later
// Explicit runs of nonlinear bodies that hit each other and rub: checkpoints, stages, ends.
#include "rubato/deck/read.hpp"
#include "rubato/domain/recovery.hpp"
#include "rubato/results/checkpoint.hpp"
#include "rubato/run/run_study.hpp"

#include <gtest/gtest.h>

#include "support/scratch_folder.hpp"
#include "support/simulated_blocks.hpp"
#include "support/solid_materials.hpp"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace rubato::run::nonlinear_explicit_test {
namespace {

using simulation::Simulation;

/// A block thrown aslant at a wider one, whose right end is let go on the way.
study::Study thrown(const std::string& material, const std::string& speed = "{x: 8, y: -30}") {
  return deck::parse_deck(R"(
mesh:
  generate:
    - {name: block, rectangle: {from: [0, 0.101], to: [0.2, 0.25]}, divisions: [4, 3], sides: {bottom: under}}
    - {name: plane, rectangle: {from: [-0.1, 0], to: [0.4, 0.1]}, divisions: [10, 2],
       sides: {top: over, bottom: ground, right: end}}
  groups: {flying: {box: {from: [-1, 0.1005], to: [1, 1]}}}
physics: plane_strain
materials:
  thrown: {density: 7800, cells: block, )" +
                              material +
                              R"(}
  rubber: {law: hyperelastic, c10: 2e8, c01: 1e8, bulk: 4e9, density: 1100, cells: plane}
supports: [{on: ground, fix: [x, y]}, {on: end, fix: x, until: 2.5e-4}]
initial: [{on: flying, velocity: )" +
                              speed +
                              R"(}]
contact: {joint: {master: over, slave: under, friction: 0.3, method: penalty, friction_method: penalty}}
time: {scheme: central_difference, end: 4e-4, record: 5e-5}
)",
                          "deck.yaml")
      .runs.front();
}

const std::string steel = "law: plastic, young: 200e9, poisson: 0.3, strain: logarithmic, "
                          "hardening: {linear: {yield_stress: 100e6, modulus: 1e9}}, "
                          "kinematic: {modulus: 5e9, recall: 20}";
const std::string soft_steel = "law: plastic, young: 200e9, poisson: 0.3, "
                               "hardening: {linear: {yield_stress: 100e6, modulus: 1e9}}";
const std::string polymer = "law: prony, young: 20e9, poisson: 0.3, strain: logarithmic, "
                            "terms: [{shear: 5e9, time: 1e-5}, {shear: 2e9, time: 1e-3}]";

using test::Kind;

class ExplicitImpact : public testing::TestWithParam<Kind> {};

TEST_P(ExplicitImpact, ClosesItsLedgerWithContactAndFriction) {
  Simulation simulation(GetParam().study);
  step::EnergyRecord record;
  bool touched = false;
  while (!simulation.finished()) {
    ASSERT_TRUE(simulation.advance().accepted());
    record.note(simulation.state().t, simulation.energy());
    touched = touched || step::points_in_contact(simulation.state()) > 0;
  }
  EXPECT_TRUE(touched);
  EXPECT_GT(simulation.energy().friction, 0);
  EXPECT_LE(record.largest_balance, 1e-11 * record.largest);
  EXPECT_LE(std::abs(simulation.energy().bulk_scheme), 0.02 * record.largest);
}

TEST_P(ExplicitImpact, GoesOnToTheSameBitsFromEachCheckpoint) {
  const test::ScratchFolder folder;
  Simulation whole(GetParam().study);
  std::vector<std::filesystem::path> files;
  while (!whole.finished()) {
    ASSERT_TRUE(whole.advance().accepted());
    results::Checkpoint checkpoint;
    checkpoint.memento = whole.memento();
    files.push_back(folder / ("checkpoint_" + std::to_string(files.size()) + ".h5"));
    results::write_checkpoint(files.back(), checkpoint);
  }
  for (std::size_t i = 0; i + 1 < files.size(); i += 2) {
    const auto memento = results::read_checkpoint(files[i]).memento;
    Simulation resumed(whole.model(), {.memento = &memento});
    test::go_to_end(resumed);
    SCOPED_TRACE(testing::Message() << "after record " << i + 1);
    test::expect_same(resumed, whole);
    EXPECT_EQ(resumed.energy().plastic, whole.energy().plastic);
    EXPECT_EQ(resumed.energy().viscous, whole.energy().viscous);
    EXPECT_EQ(resumed.energy().bulk_scheme, whole.energy().bulk_scheme);
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, ExplicitImpact,
                         testing::Values(Kind{"PlasticLogarithmic", thrown(steel)},
                                         Kind{"PlasticSmall", thrown(soft_steel)},
                                         Kind{"PlasticReduced", thrown(steel + ", formulation: reduced")},
                                         Kind{"Prony", thrown(polymer)},
                                         Kind{"Linear", thrown("young: 20e9, poisson: 0.3")}),
                         test::name_of_kind);

/// Pressed to less than nothing. Steps become a thousandth as long, not shorter, so that the end comes.
TEST(AnExplicitRun, EndsWithItsSentenceWhereACellIsTurnedInsideOut) {
  for (const auto* material :
       {"law: hyperelastic, c10: 0.2, bulk: 4", "young: 1, poisson: 0.3, strain: logarithmic"}) {
    auto study = deck::parse_deck(R"(
mesh: {generate: [{name: block, rectangle: {from: [0, 0], to: [2, 1]}, divisions: [2, 1],
                   sides: {bottom: ground, top: top}}]}
physics: plane_strain
materials: {body: {density: 1, )" + std::string(material) +
                                      R"(}}
functions: {press: {times: [0, 2], values: [0, -1.2]}}
supports: [{on: ground, fix: [x, y]}, {on: top, x: 0, y: {value: 1, function: press}}]
time: {scheme: central_difference, end: 2, record: 0.1}
)",
                                  "deck.yaml")
                     .runs.front();
    study.name = "crash";
    const test::ScratchFolder folder;
    const auto result = run_study(study, folder / "crash", {});
    EXPECT_EQ(result.status, Status::not_converged);
    EXPECT_TRUE(result.message.starts_with("cell ")) << result.message;
    EXPECT_NE(result.message.find("has no forces: a point is turned inside out (J ≤ 0) (between t = "),
              std::string::npos)
        << result.message;
    EXPECT_GT(result.end.t, 1);
    EXPECT_LT(result.end.t, 1.7);
    EXPECT_TRUE(result.end.motion.u.allFinite());
    EXPECT_TRUE(std::filesystem::exists(folder / "crash" / "energy.csv"));
  }
}

/// Implicit steps take over what the impact has left.
TEST(ARunFromTheEndOfAnExplicitOne, TakesWhatMaterialsRemember) {
  auto study = thrown(steel);
  study.supports.pop_back();
  Simulation first(study);
  test::go_to_end(first);
  study.initial.clear();
  study.time = {};
  study.time.scheme = study::SchemeKind::hht;
  study.time.alpha = -0.1;
  study.time.contact_mass = study::ContactMass::consistent;
  study.time.begin = 4e-4;
  study.time.step = 1e-6;
  study.time.end = 4.05e-4;
  study.time.start = study::StartKind::from_run;
  study.time.start_run = "first";
  Simulation second(study, {.previous = &first.state()});
  EXPECT_EQ(second.state().bulk_points.values, first.state().bulk_points.values);
  test::go_to_end(second);
  const auto& energy = second.energy();
  EXPECT_LE(std::abs(energy.balance()), 1e-10 * energy.largest());
}

} // namespace
} // namespace rubato::run::nonlinear_explicit_test
