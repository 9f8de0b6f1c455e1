// SPDX-License-Identifier: LGPL-3.0-or-later
// What is said of runs of nonlinear bodies: how they are solved, why steps fail, what may help.
#include "rubato/domain/bulk.hpp"
#include "rubato/modes/modal_study.hpp"
#include "rubato/modes/modes.hpp"
#include "rubato/results/attempt_json.hpp"
#include "rubato/run/advice.hpp"
#include "rubato/run/failure.hpp"
#include "rubato/run/run_study.hpp"
#include "rubato/simulation/time_integration.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/faults.hpp"
#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include "support/scratch_folder.hpp"
#include "support/solid_materials.hpp"
#include <algorithm>
#include <string>
#include <vector>

namespace rubato::run::nonlinear_messages_test {
namespace {

using step::Criterion;
using step::Outcome;

const std::string block = R"(
mesh:
  generate: [{name: block, rectangle: {from: [0, 0], to: [2, 1]}, divisions: [2, 1], cells: quad4,
              sides: {top: top, bottom: ground}}]
physics: plane_strain
materials: {metal: {young: 1000, poisson: 0.3, density: 1, rayleigh: {stiffness: 1e-3}}}
functions: {ramp: {times: [0, 1], values: [0, 1]}}
supports: [{on: ground, fix: [x, y]}, {on: top, y: {value: -0.1, function: ramp}}]
time: TIME
)";
const std::string steady = "{scheme: static, step: 1, end: 1, on_failure: {levels: 0}}";
const std::string moving = "{scheme: newmark, step: 1e-3, end: 2e-3}";

study::Study plastic(const std::string& time = steady) {
  auto deck = block;
  deck.replace(deck.find("TIME"), 4, time);
  auto study = test::study_of(deck);
  test::make_plastic(study.materials[0], 10, 50, study::StrainKind::logarithmic);
  return study;
}

bool has(const std::vector<std::string>& lines, const std::string& part) {
  return std::ranges::any_of(lines, [&](const auto& line) { return line.find(part) != std::string::npos; });
}

void expect_in(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

/// A step that ended so.
results::Failure failure_with(Outcome outcome, std::vector<step::Unmet> unmet) {
  results::Failure failure;
  failure.end = 1;
  failure.report.outcome = outcome;
  failure.report.unmet = std::move(unmet);
  failure.report.tolerance = 1e-8;
  return failure;
}

std::vector<std::string> advice_for(const test::ModelParts& model, const results::Failure& failure) {
  return advice(model, time::make_scheme(model.study.time), failure);
}

results::Failure inverted_cell(const test::ModelParts& model) {
  auto failure = failure_with(Outcome::cell_failed, {{.criterion = Criterion::cell, .node = 1}});
  failure.report.failed_cell = domain::CellFailure{element::Failure::inverted, model.bulk.cells.front(), 2};
  return failure;
}

TEST(AFailedStepOfNonlinearBodies, NamesTheCellThatHasNoForces) {
  const test::BuiltModel model(plastic());
  const auto text = explain(model, inverted_cell(model));
  expect_in(text, "(a cell has no forces, 0 iterations); ");
  expect_in(text, domain::cell_label(model.mesh, model.bulk.cells.front()) +
                      " has no forces: a point is turned inside out (J ≤ 0)");
  EXPECT_EQ(text.find("residual"), std::string::npos) << text;
  const auto lines = advice_for(model, inverted_cell(model));
  EXPECT_TRUE(has(lines, "a shorter time.step"));
  EXPECT_TRUE(has(lines, "a look at the mesh around N2 ("));
  EXPECT_FALSE(has(lines, "formulation"));
}

TEST(AFailedStepOfNonlinearBodies, IsAdvisedAnotherFormulationOfEnhancedCells) {
  auto study = plastic();
  study.materials[0].strain = study::StrainKind::small;
  study.materials[0].formulation = study::Formulation::enhanced;
  const test::BuiltModel model(study);
  EXPECT_TRUE(has(advice_for(model, inverted_cell(model)), "materials.metal.formulation: mean_dilatation"));
}

TEST(AFailedStepOfNonlinearBodies, TellsOfPlasticStrainThatGrewTooMuch) {
  auto study = plastic();
  study.time.max_plastic_step = 0.01;
  const test::BuiltModel model(study);
  const auto failure =
      failure_with(Outcome::plastic_step,
                   {{.criterion = Criterion::plastic_step, .node = 1, .value = 0.03, .allowed = 0.01}});
  const auto text = explain(model, failure);
  expect_in(text, "(plastic strain grew too much, 0 iterations); the plastic strain at node N2 (");
  expect_in(text, "grew by 3.00e-02 in one step (time.max_plastic_step: 0.01)");
  EXPECT_TRUE(has(advice_for(model, failure), "a larger time.max_plastic_step than 0.01"));
}

TEST(AFailedStepOfNonlinearBodies, TellsOfStatesThatAreNotStable) {
  auto failure = failure_with(Outcome::too_many_iterations, {});
  failure.report.indefinite = true;
  const test::BuiltModel quasistatic(plastic());
  expect_in(explain(quasistatic, failure),
            "the effective matrix without contact was not positive definite: the state is not "
            "stable under these loads");
  EXPECT_TRUE(has(advice_for(quasistatic, failure), "supports that move in the place of loads"));
  const test::BuiltModel dynamic(plastic(moving));
  expect_in(explain(dynamic, failure), "not positive definite: a part buckles");
  EXPECT_FALSE(has(advice_for(dynamic, failure), "supports that move"));
}

/// The top is pressed through the ground.
TEST(AFailedStepOfNonlinearBodies, IsToldOfByTheRun) {
  auto study = plastic();
  study.supports[1].components[1]->value = study::FieldValue(-1.5);
  const test::ScratchFolder folder;
  const auto result = run_study(study, folder.path(), {});
  EXPECT_EQ(result.status, Status::not_converged);
  expect_in(result.message, "cell ");
  expect_in(result.message, " has no forces: ");
}

TEST(AttemptsOfNonlinearBodies, SayHowTheBulkWasSolved) {
  const test::BuiltModel model(plastic());
  step::StepReport report;
  report.outcome = Outcome::converged;
  report.bulk_iterations = 4;
  report.factorisations = 2;
  report.bulk_residuals = {8, 0.5};
  report.indefinite = true;
  const auto json = results::to_json(model, simulation::Attempt{.accepted = true}, report);
  EXPECT_EQ(json.at("bulk_iterations"), 4);
  EXPECT_EQ(json.at("factorisations"), 2);
  EXPECT_EQ(json.at("bulk_residuals"), nlohmann::ordered_json({8.0, 0.5}));
  EXPECT_EQ(json.at("indefinite"), true);
  EXPECT_FALSE(json.contains("failed_cell"));
  const auto failed = results::to_json(model, simulation::Attempt{}, inverted_cell(model).report);
  EXPECT_EQ(failed.at("failed_cell").at("label"), domain::cell_label(model.mesh, model.bulk.cells.front()));
  EXPECT_EQ(failed.at("failed_cell").at("reason"), "a point is turned inside out (J ≤ 0)");
  EXPECT_EQ(failed.at("unmet").at(0).at("criterion"), "cell");
  EXPECT_FALSE(failed.at("unmet").at(0).contains("value"));
  auto study = plastic();
  study.materials[0].law = study::LawKind::elastic;
  study.materials[0].strain.reset();
  const auto linear =
      results::to_json(test::BuiltModel(study), simulation::Attempt{.accepted = true}, report);
  for (const auto* key :
       {"bulk_iterations", "factorisations", "bulk_residuals", "indefinite", "exact_tangent"})
    EXPECT_FALSE(linear.contains(key)) << key;
}

TEST(TheMethodOfNonlinearBodies, SaysWhenTheyAreFactored) {
  auto study = plastic();
  EXPECT_EQ(simulation::Simulation(study).method(),
            "solver the bulk is nonlinear, its tangent factored in every "
            "step, and when iterations come to little");
  study.newton.tangent = study::TangentChoice::full;
  EXPECT_EQ(simulation::Simulation(study).method(),
            "solver the bulk is nonlinear, its tangent factored in every iteration");
}

TEST(TheLogOfNonlinearBodies, SaysWhatDampingIsMadeOf) {
  std::vector<std::string> said;
  Watch watch;
  watch.say = [&](const std::string& text) { said.push_back(text); };
  const test::ScratchFolder folder;
  EXPECT_EQ(run_study(plastic(moving), folder.path(), watch).status, Status::complete);
  EXPECT_TRUE(has(said, "damping is made of the stiffness that they begin with"));
  said.clear();
  auto study = plastic(moving);
  study.materials[0].rayleigh_stiffness = 0;
  run_study(study, folder / "undamped", watch);
  EXPECT_FALSE(has(said, "damping is made of"));
}

TEST(ModesOfNonlinearBodies, SayThatTheyAreOfTheUndeformedShape) {
  const test::BuiltModel model(modes::modal_study(plastic(moving)));
  EXPECT_TRUE(
      has(modes::modes_of(model, {.number = 2}).notes, "small vibrations about their undeformed shape"));
}

TEST(TheStartOfNonlinearBodies, IsRefusedWhereACellIsTurnedInsideOut) {
  auto study = plastic(moving);
  study.supports.pop_back();
  study::InitialMotion pressed;
  pressed.on = "top";
  pressed.displacement[1] = -1.5;
  study.initial.push_back(pressed);
  const auto fault =
      test::fault_of([&] { simulation::Simulation simulation(study); }); // J falls below 0 in both cells
  expect_in(fault, "has no forces where the run begins: a point is turned inside out (J ≤ 0)");
}

} // namespace
} // namespace rubato::run::nonlinear_messages_test
