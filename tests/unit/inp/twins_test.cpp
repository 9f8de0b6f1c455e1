// SPDX-License-Identifier: LGPL-3.0-or-later
// Files beside decks that say the same in rubato's words: equal displacements.
#include "rubato/deck/read.hpp"
#include "rubato/study/echo.hpp"

#include <Eigen/LU>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "computed.hpp"
#include "support/decks.hpp"

namespace rubato::twins_test {
namespace {

using test::Computed;

constexpr double same = 1e-12;

/// The deck beside the file, whose mesh is that of the file.
Computed deck_beside(const std::string& name, const std::string& rest) {
  const auto file = test::inp_file(name);
  return Computed(
      deck::parse_deck("mesh: {file: " + name + ".inp}\n" + rest, file.parent_path() / "twin.yaml").runs);
}

void expect_twins(const std::string& name, const std::string& rest) {
  const auto ours = test::computed(name);
  const auto twin = deck_beside(name, rest);
  ASSERT_EQ(ours.size(), twin.size()) << name;
  for (std::size_t run = 0; run < ours.size(); ++run) {
    const auto& u = ours.displacements(run);
    const auto& v = twin.displacements(run);
    ASSERT_EQ(u.size(), v.size()) << name;
    EXPECT_GT(v.lpNorm<Eigen::Infinity>(), 0) << name;
    EXPECT_LE((u - v).lpNorm<Eigen::Infinity>(), same * v.lpNorm<Eigen::Infinity>())
        << name << " run " << run;
  }
}

const std::string bar = R"(
physics: solid
materials: {steel: {young: 2e11, poisson: 0, density: 7800, cells: EALL, formulation: enhanced}}
)";

TEST(TwinsOfDecks, BeamsThatRub) {
  const auto ours = test::computed("sdnl140_f");
  auto deck = test::two_beams;
  deck.replace(deck.find(", exclude_nodes: [clamp]"), 24, "");
  deck.replace(deck.find("newton: {residual: 1e-10}"), 25, "");
  const Computed twin(deck::parse_deck(deck, "twin.yaml").runs);
  for (const double x : {0.25, 0.5, 1.0})
    for (const double y : {0.1, -0.1})
      for (const int axis : {0, 1})
        EXPECT_NEAR(ours.displacement(0, {x, y, 0}, axis), twin.displacement(0, {x, y, 0}, axis), same);
}

TEST(TwinsOfDecks, BeamsThatRubInSpace) {
  expect_twins("sdnl140_c", R"(
physics: solid
materials: {steel: {young: 200e9, poisson: 0, density: 7800}}
supports: [{on: CLAMP, fix: [x, y, z]}]
loads: [{nodal_force: {on: TIP, y: -5e5}}]
contact: {rub: {master: UPPER_FACE, slave: LOWER_FACE, integration: nodes, friction: 0.2}}
time: {scheme: hht, alpha: -0.3, step: 1e-3, end: 0.012}
)");
}

TEST(TwinsOfDecks, SpringsDashpotsAndMasses) {
  expect_twins("discrete", bar + R"(
supports: [{on: ROOT, fix: [x, y, z]}, {on: NALL, fix: [y, z]}]
connectors:
  - {on: N17, along: [1, 0, 0], stiffness: 3e9}
  - {on: N18, along: [1, 0, 0], stiffness: 3e9}
  - {on: N17, to: N20, stiffness: 1e9}
  - {on: N1, to: N19, along: [1, 0, 0], force: {elongations: [-1e-3, 0, 1e-3], forces: [-2e6, 0, 1e6], outside: constant}}
  - {on: N1, to: N17, damping: 4e5}
masses: [{on: N20, mass: 500}]
loads: [{nodal_force: {on: N19, x: 1e6}}]
time: {scheme: hht, alpha: -0.05, step: 1e-5, end: 5e-4}
)");
}

TEST(TwinsOfDecks, ReferencesOfCouplings) {
  for (const auto* kind : {"rigid", "distributed"}) {
    const bool rigid = std::string(kind) == "rigid";
    expect_twins(rigid ? "kinematic" : "distributing", bar + R"(
supports: [{on: ROOT, fix: [x, y, z]})" + (rigid ? ", {on: hub, turn: {x: 0}}]" : "]") +
                                                           R"(
relations: {hub: {)" + kind + R"(: {on: TIP, at: [1.5, 0.5, 0.5]}}}
functions: {ramp: {ramp: [0, 1]}}
loads:
  - {moment: {on: hub, z: 1e5, function: ramp}}
  - {nodal_force: {on: hub, x: 2e5, function: ramp}}
time: {scheme: static, step: 1, end: 1}
)");
  }
}

TEST(TwinsOfDecks, RigidBodiesWithANodeForRotations) {
  expect_twins("rigid_body", bar + R"(
supports: [{on: ROOT, fix: [x, y, z]}, {on: end, fix: y, turn: {x: 0, y: 0, z: {value: 1e-3, function: ramp}}}]
relations: {end: {rigid: {on: END, at: [1, 0.5, 0.5]}}}
functions: {ramp: {ramp: [0, 1]}}
loads: [{nodal_force: {on: end, x: 1e5, function: ramp}}]
time: {scheme: static, step: 1, end: 1}
)");
}

TEST(TwinsOfDecks, EquationsAndPins) {
  expect_twins("relations", bar + R"(
supports: [{on: ROOT, fix: [x, y, z]}]
relations:
  first: {equation: {terms: [{on: N17, x: 1}, {on: N18, x: -2}]}}
  second: {equation: {terms: [{on: N13, y: 1}, {on: N14, y: 1}, {on: N15, y: -1}]}}
  pin_x: {equation: {terms: [{on: N19, x: 1}, {on: N20, x: -1}]}}
  pin_y: {equation: {terms: [{on: N19, y: 1}, {on: N20, y: -1}]}}
  pin_z: {equation: {terms: [{on: N19, z: 1}, {on: N20, z: -1}]}}
functions: {ramp: {ramp: [0, 1]}}
loads:
  - {nodal_force: {on: N18, x: 1e6, function: ramp}}
  - {nodal_force: {on: N19, y: 2e5, function: ramp}}
time: {scheme: static, step: 1, end: 1}
)");
}

TEST(TwinsOfDecks, AxesThatTurn) {
  // Stiffness 2e11 5e10 1e11 4e10 3e10 8e10, inverted by hand to moduli below.
  Eigen::Matrix3d stiffness;
  stiffness << 2e11, 5e10, 4e10, 5e10, 1e11, 3e10, 4e10, 3e10, 8e10;
  const Eigen::Matrix3d s = stiffness.inverse();
  const auto number = [](double value) { return fmt::format("{}", value); };
  expect_twins("winding", R"(
physics: solid
materials:
  ply: {law: orthotropic, young_x: )" +
                              number(1 / s(0, 0)) + ", young_y: " + number(1 / s(1, 1)) + ", young_z: " +
                              number(1 / s(2, 2)) + ", poisson_xy: " + number(-s(0, 1) / s(0, 0)) +
                              ", poisson_xz: " + number(-s(0, 2) / s(0, 0)) +
                              ", poisson_yz: " + number(-s(1, 2) / s(1, 1)) + R"(,
        shear_xy: 3e10, shear_xz: 2e10, shear_yz: 2.5e10, angle_x: 30,
        axes: {cylindrical: {point: [-3, 0, 0], direction: [0, 0, 1]}}}
supports: [{on: ROOT, fix: [x, y, z]}]
functions: {ramp: {ramp: [0, 1]}}
loads: [{nodal_force: {on: END, y: 1e6, function: ramp}}]
time: {scheme: static, step: 1, end: 1}
)");
}

TEST(TwinsOfDecks, EmbeddedCells) {
  expect_twins("embedded", R"(
physics: solid
materials: {steel: {young: 2e11, poisson: 0, density: 7800}}
supports: [{on: ROOT, fix: [x, y, z]}]
relations: {strip: {embedded: {on: STRIP, in: EALL}}}
functions: {ramp: {ramp: [0, 1]}}
loads: [{nodal_force: {on: END, x: 1e6, function: ramp}}]
time: {scheme: static, step: 1, end: 1}
)");
}

TEST(TwinsOfDecks, ABarThatIsPulledAndLetGo) {
  expect_twins("preloaded", bar + R"(
supports: [{on: ROOT, fix: [x, y, z]}, {on: NALL, fix: [y, z]}]
functions: {ramp: {ramp: [0, 1]}}
runs:
  pulled:
    loads: [{nodal_force: {on: END, x: 1e6, function: ramp}}]
    time: {scheme: static, step: 1, end: 1}
  let_go:
    time: {scheme: hht, alpha: 0, begin: 1, step: 2e-6, end: 1.0004, start: {from: pulled}}
)");
}

TEST(TwinsOfDecks, ARootThatMovesAndDampedMaterial) {
  expect_twins("moving_table", R"(
physics: solid
materials: {steel: {young: 2e11, poisson: 0, density: 7800, rayleigh: {mass: 100, stiffness: 1e-6}}}
supports: [{on: NALL, fix: [y, z]}, {on: ROOT, x: {velocity: 2}}]
initial: [{on: NALL, velocity: {x: 2}}]
time: {scheme: hht, alpha: -0.1, step: 5e-6, end: 2e-4}
)");
}

TEST(TwinsOfDecks, ExplicitSteps) {
  expect_twins("explicit", R"(
physics: plane_strain
materials: {steel: {young: 2e11, poisson: 0, density: 7800}}
supports: [{on: GROUND, fix: y}, {on: SIDES, fix: x}]
loads: [{pressure: {on: E12.P3, value: 1e6}}, {pressure: {on: E13.P3, value: 1e6}}, {pressure: {on: E14.P3, value: 1e6}}]
contact: {joint: {master: LOW_TOP, slave: HIGH_BOTTOM, method: penalty, coefficients: {normal: 1e13}, friction: 0.1}}
time: {scheme: central_difference, end: 2e-4}
)");
}

TEST(TwinsOfDecks, ExplicitStepsWithATieAndAnEquation) {
  expect_twins("explicit_tie", R"(
physics: plane_strain
materials: {steel: {young: 2e11, poisson: 0, density: 7800}}
supports: [{on: GROUND, fix: y}, {on: SIDES, fix: x}]
loads: [{pressure: {on: E12.P3, value: 1e6}}, {pressure: {on: E13.P3, value: 1e6}}, {pressure: {on: E14.P3, value: 1e6}}]
contact: {SEAM: {master: LOW_TOP, slave: HIGH_BOTTOM, tie: true}}
relations: {lever: {equation: {terms: [{on: N24, y: 1}, {on: N27, y: 2}]}}}
time: {scheme: central_difference, end: 2e-4}
)");
}

TEST(TwinsOfDecks, EchoesAreDecksOfTheSameStudies) {
  for (const auto& file : test::all_inp_files()) {
    const bool of_modes = file.stem() == "modes";
    const auto input = inp::read_input(file, of_modes ? inp::Purpose::modes : inp::Purpose::run);
    for (const auto& study : input.runs) {
      auto echoed = deck::parse_echo(study::to_json(study), "echo.json");
      echoed.name = study.name;
      EXPECT_EQ(study::to_json(echoed), study::to_json(study)) << file;
      EXPECT_TRUE(echoed == study) << file << " " << study.name;
    }
  }
}

} // namespace
} // namespace rubato::twins_test
