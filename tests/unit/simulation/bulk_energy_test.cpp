// SPDX-License-Identifier: LGPL-3.0-or-later
// The ledger of runs with bodies beyond linear elasticity: it closes with every scheme, law and neighbour,
// and its entries are those of closed forms.
#include "rubato/domain/domain.hpp"
#include "rubato/simulation/time_integration.hpp"
#include "rubato/study/formulation.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/bulk_laws.hpp"
#include "support/model_parts.hpp"
#include "support/simulated_blocks.hpp"
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace rubato::simulation::bulk_energy_test {
namespace {

using deck::Setting;
using step::EnergyLedger;
using test::NamedLaw;
using test::study_with;

/// Of the largest entry of the run so far.
constexpr double closed = 1e-11;

/// A beam that bends onto another one, slides on it and swings back. Strains reach some hundredths.
const std::string beams = R"(
mesh:
  generate:
    - {name: upper, rectangle: {from: [0, 0], to: [1, 0.2]}, divisions: [6, 2], cells: quad4,
       sides: {left: held, bottom: upper_face, top: roof}, points: {right_top: tip}}
    - {name: lower, rectangle: {from: [0, -0.2], to: [1, 0]}, divisions: [5, 2], cells: quad4,
       sides: {left: held, top: lower_face}}
physics: plane_strain
materials: {rubber: {young: 100, poisson: 0.3, density: 1}}
functions: {swing: {times: [0, 0.5, 0.8, 1.2], values: [0, 1, 1, -1]}}
supports: [{on: held, fix: [x, y]}]
loads: [{surface_force: {on: roof, x: 0.01, y: -0.1, function: swing}}]
contact: {joint: {master: upper_face, slave: lower_face, friction: 0.2, exclude_nodes: [held]}}
newton: {residual: 1e-11}
time: {scheme: newmark, step: 0.1, end: 1.2}
)";

struct NamedTime {
  std::string name;
  std::string time;
};

const std::vector<NamedTime> every_time{
    {"Newmark", "{scheme: newmark, step: 0.1, end: 1.2}"},
    {"Hht", "{scheme: hht, alpha: -0.3, step: 0.1, end: 1.2}"},
    {"GeneralizedAlpha", "{scheme: generalized_alpha, spectral_radius: 0.2, step: 0.1, end: 1.2}"},
    {"WbzAlpha", "{scheme: wbz_alpha, alpha: -0.3, step: 0.1, end: 1.2}"},
    {"ModifiedAverageAcceleration",
     "{scheme: modified_average_acceleration, alpha: -0.2, step: 0.1, end: 1.2}"},
    {"MoreauJean", "{scheme: moreau_jean, step: 0.1, end: 1.2}"},
    {"MoreauJeanBeyondTheMiddle", "{scheme: moreau_jean, theta: 0.7, step: 0.1, end: 1.2}"},
    {"EnergyMomentum", "{scheme: energy_momentum, step: 0.1, end: 1.2}"},
    {"Static", "{scheme: static, step: 0.1, end: 1.2}"},
};

struct Combined {
  NamedLaw law;
  NamedTime time;
};

/// Every law with every scheme that takes it.
std::vector<Combined> combinations() {
  std::vector<Combined> all;
  for (const auto& law : test::every_law)
    for (const auto& time : every_time)
      if (test::is_elastic(law) || time.name != "EnergyMomentum")
        all.push_back({law, time});
  return all;
}

/// With a ledger that closes.
void go_to_end(Simulation& simulation) {
  step::EnergyRecord record;
  while (!simulation.finished()) {
    ASSERT_NE(simulation.advance().verdict, Verdict::not_converged);
    record.note(simulation.state().t, simulation.energy());
  }
  EXPECT_GT(record.largest, 0);
  EXPECT_LE(record.largest_balance, closed * record.largest);
}

class RunOf : public testing::TestWithParam<Combined> {};

TEST_P(RunOf, ClosesItsLedger) {
  const auto& [law, time] = GetParam();
  Simulation simulation(study_with(beams, law, {{"time", time.time}}));
  bool touched = false;
  simulation.observe({.accepted = [&](const AcceptedStep& step) {
    touched = touched || step::points_in_contact(step.now) > 0;
  }});
  go_to_end(simulation);
  EXPECT_TRUE(touched);
  EXPECT_GT(std::abs(simulation.energy().friction), 0);
  const auto material = test::ModelParts(simulation.model()).study.materials.front();
  EXPECT_EQ(simulation.energy().plastic > 0, material.law == study::LawKind::plastic);
  EXPECT_EQ(simulation.energy().back_stress > 0, material.law == study::LawKind::plastic);
  EXPECT_EQ(simulation.energy().viscous > 0, material.law == study::LawKind::prony);
  const bool keeps_energy =
      test::ModelParts(simulation.model()).study.time.scheme == study::SchemeKind::energy_momentum;
  EXPECT_EQ(simulation.energy().bulk_scheme != 0,
            study::strain_of(material) != study::StrainKind::small && !keeps_energy);
  EXPECT_EQ(simulation.energy().hourglass > 0, material.formulation == study::Formulation::reduced);
}

INSTANTIATE_TEST_SUITE_P(EachLaw, RunOf, testing::ValuesIn(combinations()),
                         [](const auto& chosen) { return chosen.param.law.name + chosen.param.time.name; });

class RunWith : public testing::TestWithParam<NamedLaw> {};

/// A heated linear body on springs, on a stop and on a dashpot beside the nonlinear one.
TEST_P(RunWith, LinearNeighboursClosesItsLedger) {
  const std::vector<Setting> mixed{
      {"materials",
       "{rubber: {young: 100, poisson: 0.3, density: 1, cells: upper}, steel: {young: 300, poisson: "
       "0.2, density: 2, cells: lower, expansion: 1e-3, reference_temperature: 20}}"},
      {"temperature", "[{on: lower, value: \"40 + 10*y\", function: swing}]"},
      {"connectors", "[{on: lower_face, along: [0, 1], force: {elongations: [-1, -0.001, 0, 1], forces: "
                     "[-20, 0, 0, 10]}, damping: 0.5}]"},
      {"springs", "[{on: roof, x: 0.5}]"}};
  for (const auto* time :
       {"{scheme: hht, alpha: -0.1, step: 0.1, end: 1.2}", "{scheme: static, step: 0.1, end: 1.2}",
        "{scheme: energy_momentum, step: 0.1, end: 1.2}"}) {
    if (std::string(time).find("energy_momentum") != std::string::npos && !test::is_elastic(GetParam()))
      continue;
    auto changes = mixed;
    if (std::string(time).find("static") != std::string::npos)
      changes[2].value = "[{on: lower_face, along: [0, 1], force: {elongations: [-1, -0.001, 0, 1], forces: "
                         "[-20, 0, 0, 10]}}]";
    changes.push_back({"time", time});
    Simulation simulation(study_with(beams, GetParam(), changes));
    ASSERT_FALSE(test::ModelParts(simulation.model()).domain.is_linear());
    go_to_end(simulation);
    EXPECT_NE(simulation.energy().heat, 0);
  }
}

TEST_P(RunWith, MementosGoesOnToTheSameBits) {
  for (const auto* time :
       {"{scheme: newmark, step: 0.1, end: 1.2}", "{scheme: energy_momentum, step: 0.1, end: 1.2}"}) {
    if (std::string(time).find("energy_momentum") != std::string::npos && !test::is_elastic(GetParam()))
      continue;
    const auto study = study_with(beams, GetParam(), {{"time", time}});
    Simulation whole(study);
    for (int i = 0; i < 6; ++i)
      whole.advance();
    const auto memento = whole.memento();
    go_to_end(whole);
    Simulation other(study, {.memento = &memento});
    test::expect_same(other.energy(), std::get<ImplicitProgress>(memento.progress).energy);
    go_to_end(other);
    test::expect_same(other, whole);
  }
}

/// A run that continues another one begins with what that one stored.
TEST_P(RunWith, AStartFromAnotherRunClosesItsLedger) {
  Simulation preload(study_with(beams, GetParam(), {{"time", "{scheme: static, step: 0.1, end: 0.8}"}}));
  go_to_end(preload);
  auto study = study_with(beams, GetParam());
  study.time.begin = 0.8;
  study.time.start = study::StartKind::from_run;
  study.time.start_run = "preload";
  Simulation after(study, {.previous = &preload.state()});
  const auto& start = after.energy();
  EXPECT_NEAR(start.strain, preload.energy().strain, 1e-12 * start.largest());
  EXPECT_NEAR(start.back_stress, preload.energy().back_stress, 1e-12 * start.largest());
  EXPECT_EQ(start.plastic, 0);
  EXPECT_EQ(start.start, start.stored());
  go_to_end(after);
}

/// A body of linear and nonlinear cells that supports carry a thousand lengths while a load strains it by
/// 1e-4: K u has the rounding of |K||u| in it, which must not work on the way.
TEST_P(RunWith, ALongWayClosesItsLedger) {
  const std::string carried = R"(
mesh:
  generate: [{name: block, rectangle: {from: [0, 0], to: [2, 1]}, divisions: [4, 2], sides: {left: left, right: right}}]
  groups: {hard: {box: {from: [1, 0], to: [2, 1]}, of: block, take: cells}, soft: {difference: [block, hard]}}
physics: plane_strain
materials: {soft: {young: 100, poisson: 0.3, cells: soft}, hard: {young: 200, poisson: 0.3, cells: hard}}
functions: {way: {ramp: {begin: 0, end: 1}}}
supports: [{on: left, x: {value: 1000, function: way}, y: 0}]
loads: [{surface_force: {on: right, x: 0.01, y: 0.005}}]
newton: {residual: 1e-9}
time: {scheme: static, step: 0.1, end: 1}
)";
  Simulation simulation(study_with(carried, GetParam()));
  go_to_end(simulation);
}

INSTANTIATE_TEST_SUITE_P(EachLaw, RunWith, testing::ValuesIn(test::every_law),
                         [](const auto& chosen) { return chosen.param.name; });

/// Of cells without own modes, which explicit steps do not solve.
TEST(CentralDifferences, CloseTheirLedger) {
  auto laws = test::every_law;
  laws.insert(laws.end(), test::every_explicit_law.begin(), test::every_explicit_law.end());
  for (const auto& law : laws) {
    const auto study =
        study_with(beams, law,
                   {{"time", "{scheme: central_difference, step: auto, end: 1.2, record: 0.1}"},
                    {"contact.joint.method", "penalty"}});
    if (study.materials.front().formulation == study::Formulation::enhanced)
      continue;
    SCOPED_TRACE(law.name);
    Simulation simulation(study);
    go_to_end(simulation);
    EXPECT_NE(simulation.energy().friction, 0);
    EXPECT_EQ(simulation.energy().plastic > 0, study.materials.front().law == study::LawKind::plastic);
    EXPECT_EQ(simulation.energy().hourglass > 0,
              study.materials.front().formulation == study::Formulation::reduced);
  }
}

/// A square of side 1 between straight sides, stretched by 0.01 in each unit of time.
const std::string square = R"(
mesh: {generate: [{name: square, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [1, 1], sides: {left: left, right: right, bottom: bottom}}]}
physics: plane_stress
materials: {any: {young: 100, poisson: 0.3, density: 1}}
functions: {stretch: {times: [0, 3, 100], values: [0, 3, 3]}}
supports: [{on: left, fix: x}, {on: bottom, fix: y}, {on: right, x: {value: 0.01, function: stretch}}]
newton: {residual: 1e-12}
time: {scheme: static, step: 1, end: 3}
)";

/// E = 100, σ_y = 1, C = 20, stretched by 0.03 in steps that meet the yield point: ε_p = (3 − 1)/(E + C).
TEST(PlasticWork, IsThatOfTheYieldStressAndTheBackStressStoresTheRest) {
  Simulation simulation(study_with(square, {"", [](study::Material& material) {
                                              material.law = study::LawKind::plastic;
                                              material.plasticity.yield_stress = 1;
                                              material.plasticity.kinematic = {{20, 0}};
                                            }}));
  go_to_end(simulation);
  const auto& energy = simulation.energy();
  const double strain = 1. / 60;
  const double stress = 1 + 20 * strain;
  EXPECT_NEAR(energy.plastic, strain, 1e-12);
  EXPECT_NEAR(energy.back_stress, 20 * strain * strain / 2, 1e-12);
  EXPECT_NEAR(energy.strain, stress * stress / 200, 1e-12);
  EXPECT_NEAR(energy.support_work, energy.strain + energy.plastic + energy.back_stress, 1e-12);
  EXPECT_EQ(energy.bulk_scheme, 0);
}

/// What hardens the yield stress is dissipated: ε_p (σ_y + H ε_p/2).
TEST(PlasticWork, HasWhatHardeningTakes) {
  Simulation simulation(study_with(square, {"", [](study::Material& material) {
                                              material.law = study::LawKind::plastic;
                                              material.plasticity.yield_stress = 1;
                                              material.plasticity.modulus = 20;
                                            }}));
  go_to_end(simulation);
  const double strain = 1. / 60;
  EXPECT_NEAR(simulation.energy().plastic, strain * (1 + 10 * strain), 1e-12);
  EXPECT_EQ(simulation.energy().back_stress, 0);
}

/// Held after it was stretched, a viscoelastic body dissipates what it stores less.
TEST(ViscousWork, IsWhatRelaxationTakes) {
  Simulation simulation(study_with(square,
                                   {"",
                                    [](study::Material& material) {
                                      material.law = study::LawKind::prony;
                                      material.prony = {{10, 5}, {20, 50}};
                                    }},
                                   {{"time.end", "60"}}));
  EnergyLedger stretched;
  while (!simulation.finished()) {
    ASSERT_TRUE(simulation.advance().accepted());
    if (simulation.state().t <= 3)
      stretched = simulation.energy();
  }
  const auto& held = simulation.energy();
  EXPECT_GT(held.viscous, 2 * stretched.viscous);
  EXPECT_NEAR(held.support_work, stretched.support_work, 1e-15);
  EXPECT_NEAR(held.viscous - stretched.viscous, stretched.strain - held.strain, 1e-12);
  EXPECT_NEAR(held.balance(), 0, closed * held.largest());
}

double bulk_scheme_with(double step) {
  Simulation simulation(study_with(
      beams, {"", [](study::Material& material) { material.strain = study::StrainKind::green_lagrange; }},
      {{"contact", "~"},
       {"functions.swing", "{times: [0, 0.6, 1.2], values: [0, 1, 0]}"},
       {"materials.rubber.rayleigh", "{stiffness: 0.02}"},
       {"time.step", fmt::format("{}", step)}}));
  go_to_end(simulation);
  return simulation.energy().bulk_scheme;
}

/// Third order in a step, second over a run.
TEST(BulkScheme, FallsWithTheSquareOfTheStep) {
  const double coarse = bulk_scheme_with(0.02);
  const double fine = bulk_scheme_with(0.01);
  EXPECT_GT(std::abs(fine), 0);
  EXPECT_NEAR(coarse / fine, 4, 0.5);
}

} // namespace
} // namespace rubato::simulation::bulk_energy_test
