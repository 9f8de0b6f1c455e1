// SPDX-License-Identifier: LGPL-3.0-or-later
// Supports hold what loads, inertia, damping and contact leave: at every instant, whatever the scheme.
#include "rubato/deck/read.hpp"
#include "rubato/model/model_forces.hpp"
#include "rubato/simulation/time_integration.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include <string>

namespace rubato::results::reactions_test {
namespace {

/// A column that is loaded at its top and lands on a plane with its lower side, held at its left.
const std::string column = R"(
mesh:
  generate:
    - {name: column, rectangle: {from: [0, 0.001], to: [0.4, 1]}, divisions: [2, 5], cells: quad4,
       sides: {top: top, left: held, bottom: under}}
physics: plane_strain
materials: {stone: {young: 1e7, poisson: 0.2, density: 2000, rayleigh: {mass: 3, stiffness: 1e-4}}}
functions: {ramp: {times: [0, 1], values: [0, 1]}}
supports: [{on: held, x: {value: 1e-4, function: ramp}, y: 0}]
loads:
  - {surface_force: {on: top, x: 2e4, y: -1e5}}
  - gravity: {y: -9.81}
contact: {foot: {obstacle: {plane: {point: [0, 0], normal: [0, 1]}}, slave: under, method: penalty, friction: 0.3, friction_method: penalty, coefficients: {normal: 1e9, tangential: 1e4}}}
time: {scheme: newmark, step: 2e-3, end: 0.04}
newton: {residual: 1e-12}
)";

Eigen::Vector2d sum_of(const test::ModelParts& model, const Eigen::VectorXd& forces) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const auto node : model.dofs.nodes)
    for (int i = 0; i < 2; ++i)
      sum[i] += forces[model.dofs.dof(node, i)];
  return sum;
}

/// What is left of reactions, loads, inertia, damping and contact, over the reactions.
double unbalance(const test::ModelParts& model, const step::State& state) {
  const bool lumped = model.lumped_mass.size() > 0;
  Eigen::VectorXd rest = state.reaction + model::external_force(model, state.t) - state.contact_force;
  if (lumped)
    rest -= model.lumped_mass.cwiseProduct(state.motion.a);
  else if (model.mass.nonZeros() > 0)
    rest -= model.mass * state.motion.a;
  if (model.damping.nonZeros() > 0)
    rest -= model.damping * state.motion.v;
  return sum_of(model, rest).norm() / sum_of(model, state.reaction).norm();
}

struct Case {
  const char* name;
  std::vector<deck::Setting> changes;
  double tolerance;
};

class Reactions : public testing::TestWithParam<Case> {};

TEST_P(Reactions, HoldTheBody) {
  simulation::Simulation simulation(test::study_of(column, GetParam().changes));
  const test::ModelParts model(simulation.model());
  bool touched = false;
  while (!simulation.finished()) {
    ASSERT_TRUE(simulation.advance().accepted());
    EXPECT_LT(unbalance(model, simulation.state()), GetParam().tolerance) << simulation.state().t;
    touched = touched || simulation.state().contact_force.norm() > 0;
  }
  EXPECT_TRUE(touched) << "contact must carry something";
  EXPECT_GT(sum_of(model, simulation.state().reaction).norm(), 1e3);
}

/// Explicit forces are C v with v half a step before, so that case has no damping.
INSTANTIATE_TEST_SUITE_P(
    Of, Reactions,
    testing::Values(Case{"newmark", {}, 1e-9},
                    Case{
                        "static",
                        {{"time", "{scheme: static, step: 0.25, end: 1}"}, {"materials.stone.rayleigh", "~"}},
                        1e-9},
                    Case{"explicit",
                         {{"time", "{scheme: central_difference, step: auto, record: 2e-3, end: 0.04}"},
                          {"materials.stone.rayleigh", "~"},
                          {"newton", "~"}},
                         1e-11}),
    [](const auto& scheme) { return std::string(scheme.param.name); });

} // namespace
} // namespace rubato::results::reactions_test
