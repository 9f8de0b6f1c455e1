// SPDX-License-Identifier: LGPL-3.0-or-later
// Explicit runs of cells of one point.
#include "rubato/deck/read.hpp"
#include "rubato/domain/recovery.hpp"
#include "rubato/simulation/time_integration.hpp"

#include <gtest/gtest.h>

#include "support/model_parts.hpp"
#include "support/simulated_blocks.hpp"
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace rubato::simulation::reduced_test {
namespace {

/// Slender, of unit density and stiffness, under its weight from one instant on.
const std::string plate = R"(
mesh: {generate: [{name: beam, rectangle: {from: [0, 0], to: [10, 1]}, divisions: [40, 4], cells: quad4,
                   sides: {left: held}}]}
physics: plane_stress
materials: {any: {young: 1, poisson: 0, density: 1, formulation: reduced}}
supports: [{on: held, fix: [x, y]}]
loads: [{gravity: {y: -1e-6}}]
time: {scheme: central_difference, end: 1000, record: 2}
)";
const std::string solid = R"(
mesh: {generate: [{name: beam, box: {from: [0, 0, 0], to: [10, 1, 0.5]}, divisions: [20, 4, 1], cells: hexa8,
                   sides: {left: held}}]}
physics: solid
materials: {any: {young: 1, poisson: 0, density: 1, strain: green_lagrange, formulation: reduced}}
supports: [{on: held, fix: [x, y, z]}]
loads: [{gravity: {y: -1e-6}}]
time: {scheme: central_difference, end: 1000, record: 2}
)";

/// From one instant at which the mean of the displacements passes its own mean to the next but one.
double period_of(const std::string& deck, double& worst_balance) {
  Simulation simulation(deck::parse_deck(deck, "beam.yaml").runs.front());
  std::vector<double> t, sag;
  step::EnergyRecord record;
  while (!simulation.finished()) {
    EXPECT_TRUE(simulation.advance().accepted());
    record.note(simulation.state().t, simulation.energy());
    const auto& u = simulation.state().motion.u;
    const int d = test::ModelParts(simulation.model()).dofs.components;
    double sum = 0;
    for (Eigen::Index i = 1; i < u.size(); i += d)
      sum += u[i];
    t.push_back(simulation.state().t);
    sag.push_back(sum);
  }
  worst_balance = record.largest_balance / record.largest;
  double middle = 0;
  for (const double one : sag)
    middle = std::min(middle, one / 2);
  std::vector<double> passed;
  for (std::size_t i = 1; i < sag.size(); ++i)
    if ((sag[i - 1] < middle) != (sag[i] < middle))
      passed.push_back(t[i - 1] + (t[i] - t[i - 1]) * (middle - sag[i - 1]) / (sag[i] - sag[i - 1]));
  EXPECT_GE(passed.size(), 3u);
  return passed.size() < 3 ? 0 : passed[2] - passed[0];
}

/// ω = 1.8751² √(EI/(ρ A)) / l² of slender beams; shear and turning inertia of this one make its period 1 %
/// longer, and four layers with 0.3 and 0.6 of the stiffness of their own make it 2 and 1 % longer.
TEST(ReducedBeams, SwingAsBeamsDo) {
  const double slender = 2 * std::numbers::pi * 100 * std::sqrt(12.) / (1.8751 * 1.8751);
  for (const auto& deck : {plate, solid}) {
    double balance = 1;
    const double period = period_of(deck, balance);
    EXPECT_GT(period, slender) << deck;
    EXPECT_LT(period, 1.05 * slender) << deck;
    EXPECT_LE(balance, 1e-10);
  }
}

/// A bar of steel that is pulled beyond its yield stress.
TEST(ReducedBars, GiveAllPointsOfACellWhatItsOnePointHas) {
  Simulation simulation(deck::parse_deck(R"(
mesh: {generate: [{name: bar, rectangle: {from: [0, 0], to: [2, 1]}, divisions: [2, 1], sides: {left: left, right: right}}]}
physics: plane_stress
materials: {any: {law: plastic, young: 1, poisson: 0.3, density: 1, formulation: reduced,
                  hardening: {linear: {yield_stress: 0.01, modulus: 0.1}}}}
functions: {pull: {times: [0, 200], values: [0, 0.1]}}
supports: [{on: left, fix: [x, y]}, {on: right, x: {value: 1, function: pull}, y: 0}]
time: {scheme: central_difference, end: 200, record: 200}
)",
                                         "bar.yaml")
                            .runs.front());
  ASSERT_TRUE(simulation.advance().accepted());
  const test::ModelParts model(simulation.model());
  const auto& state = simulation.state();
  domain::CellTensors tensors(model.mesh, model.bulk, model.dofs, state.motion.u, {}, &state.bulk_points);
  const Eigen::MatrixXd stress = tensors.at_points(domain::Tensor::stress, 0);
  const Eigen::MatrixXd plastic = tensors.at_points(domain::Tensor::plastic_strain, 0);
  const Eigen::MatrixXd cumulated = tensors.cumulated_plastic_strain(0);
  ASSERT_EQ(stress.cols(), 4);
  ASSERT_EQ(plastic.cols(), 4);
  ASSERT_EQ(cumulated.cols(), 4);
  EXPECT_GT(stress(0, 0), 0.01);
  EXPECT_GT(plastic(0, 0), 0.01);
  EXPECT_GT(cumulated(0, 0), 0.01);
  for (Eigen::Index q = 1; q < 4; ++q) {
    EXPECT_EQ(stress.col(q), stress.col(0));
    EXPECT_EQ(plastic.col(q), plastic.col(0));
    EXPECT_EQ(cumulated(0, q), cumulated(0, 0));
  }
}

} // namespace
} // namespace rubato::simulation::reduced_test
