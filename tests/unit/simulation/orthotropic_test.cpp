// SPDX-License-Identifier: LGPL-3.0-or-later
// Runs with contact between orthotropic beams, from the deck to the ledger.
#include "rubato/deck/read.hpp"
#include "rubato/simulation/time_integration.hpp"

#include <gtest/gtest.h>

#include "support/two_blocks.hpp"
#include <string>

namespace rubato::simulation::orthotropic_test {
namespace {

using test::with;

const std::string sheet = "{law: orthotropic, young_x: 140e9, young_y: 10e9, poisson_xy: 0.3, shear_xy: 5e9, "
                          "angle_z: 20, density: 1600, cells: all}";
const std::string solid_timber =
    "{law: orthotropic, young_x: 140e9, young_y: 10e9, young_z: 9e9, poisson_xy: 0.3, poisson_yz: 0.4, "
    "poisson_xz: 0.3, shear_xy: 5e9, shear_yz: 3e9, shear_xz: 5e9, angle_z: 20, angle_y: 10, angle_x: -30, "
    "density: 1600, cells: all}";
const std::string steel = "{young: 200e9, poisson: 0.3, density: 7800, cells: all}";
const std::string hht = "{scheme: hht, alpha: -0.1, step: 1e-4, end: 4e-4}";

/// The two blocks of test::two_blocks with a depth.
const std::string two_boxes = R"(title: two boxes
mesh:
  generate:
    - name: upper
      box: {from: [0, 0, 0], to: [1, 0.2, 0.2]}
      divisions: [4, 2, 2]
      sides: {left: held, bottom: upper_face}
      points: {right_top_back: tip}
    - name: lower
      box: {from: [0, -0.2, 0], to: [1, 0, 0.2]}
      divisions: [4, 2, 2]
      sides: {left: held, top: lower_face}
physics: solid
materials:
  steel: {young: 200e9, poisson: 0.3, density: 7800, cells: all}
supports:
  - {on: held, fix: [x, y, z]}
loads:
  - nodal_force: {on: tip, y: -1e6}
contact:
  interface: {master: upper_face, slave: lower_face, integration: nodes, friction: 0.2, exclude_nodes: [held]}
time: {scheme: hht, alpha: -0.1, step: 1e-4, end: 4e-4}
probes:
  end: {node: tip}
)";

Simulation simulation_of(const std::string& deck) {
  return Simulation(deck::parse_deck(deck, "deck.yaml").runs.front());
}

class OrthotropicBeams : public testing::TestWithParam<std::string> {
protected:
  static void expect_sound(std::string deck) {
    deck = with(deck, hht, GetParam());
    if (GetParam().find("central") != std::string::npos)
      deck = with(deck, "friction: 0.2", "friction: 0.2, method: penalty");
    auto simulation = simulation_of(deck);
    step::EnergyRecord energy;
    bool touched = false;
    while (!simulation.finished()) {
      ASSERT_TRUE(simulation.advance().accepted());
      energy.note(simulation.state().t, simulation.energy());
      touched = touched || simulation.state().contact_force.norm() > 0;
    }
    EXPECT_TRUE(touched);
    EXPECT_GT(energy.largest, 0);
    EXPECT_LE(energy.largest_balance, 1e-9 * energy.largest);
  }
};

TEST_P(OrthotropicBeams, TouchInThePlaneAndCloseTheirLedger) {
  expect_sound(with(test::two_blocks, steel, sheet));
}

TEST_P(OrthotropicBeams, TouchInSpaceAndCloseTheirLedger) {
  expect_sound(with(two_boxes, steel, solid_timber));
}

INSTANTIATE_TEST_SUITE_P(By, OrthotropicBeams,
                         testing::Values(hht, "{step: 1e-4, end: 4e-4}",
                                         "{scheme: central_difference, end: 4e-4, record: 1e-4}"),
                         [](const auto& chosen) { return "Scheme" + std::to_string(chosen.index); });

TEST(OrthotropicBlocks, WithIsotropicNumbersEndsWhereTheIsotropicOneEnds) {
  const auto alike = with(test::two_blocks, steel,
                          "{law: orthotropic, young_x: 200e9, young_y: 200e9, poisson_xy: 0.3, shear_xy: "
                          "76923076923.076923, angle_z: 50, density: 7800, cells: all}");
  const auto end_of = [](const std::string& deck) {
    auto simulation = simulation_of(deck);
    while (!simulation.finished())
      simulation.advance();
    return Eigen::VectorXd(simulation.state().motion.u);
  };
  const auto expected = end_of(test::two_blocks);
  const auto found = end_of(alike);
  EXPECT_LT((found - expected).norm(), 1e-8 * expected.norm());
}

} // namespace
} // namespace rubato::simulation::orthotropic_test
