// SPDX-License-Identifier: LGPL-3.0-or-later
// Simulations by several threads against those by one.
#include "rubato/core/threads.hpp"
#include "rubato/deck/read.hpp"

#include "support/simulated_blocks.hpp"
#include <string>

namespace rubato::simulation {
namespace {

constexpr std::array more_threads{2, 3};

/// Two blocks of 10 × 10 × 8 cubes each, the upper one pressed on the lower one and rubbed along it.
study::Study pressed_blocks(const std::string& law, const std::string& settings) {
  const std::string deck = R"(
mesh:
  generate:
    - {name: lower, box: {from: [0, 0, 0], to: [1, 1, 0.8]}, divisions: [10, 10, 8], cells: hexa8, sides: {back: held, front: seat}}
    - {name: upper, box: {from: [0.1, 0.1, 0.8], to: [0.9, 0.9, 1.6]}, divisions: [10, 10, 8], cells: hexa8, sides: {back: foot, front: head}}
physics: solid
materials: {metal: {young: 200e9, poisson: 0.3, density: 7800)" +
                           law + R"(}}
functions: {ramps: {ramp: [0, 1e-4]}}
supports: [{on: held, fix: [x, y, z]}]
loads:
  - pressure: {on: head, value: 4e8, function: ramps}
  - surface_force: {on: head, x: 1e8, y: 2e7}
contact: {joint: {master: seat, slave: foot, friction: 0.2)" +
                           settings;
  return deck::parse_deck(deck, "deck.yaml").runs.front();
}

Simulation run(const study::Study& study, int threads) {
  Start start;
  start.workers = Threads(threads);
  Simulation simulation(study, start);
  test::go_to_end(simulation);
  return simulation;
}

const std::string yields = ", law: plastic, hardening: {linear: {yield_stress: 250e6, modulus: 2e9}}";
/// What rounding makes of a factor is seen as far as iterations go.
const std::string implicit =
    "}}\ntime: {scheme: newmark, step: 4e-5, end: 3.2e-4}\nnewton: {residual: 1e-10}\n";
const std::string explicit_ =
    ", method: penalty}}\ntime: {scheme: central_difference, end: 3e-4, record: 1e-4}\n";

struct Case {
  std::string name;
  study::Study study;
};

std::string name_of(const testing::TestParamInfo<Case>& info) {
  return info.param.name;
}

/// Cells, and what the surfaces see of each other.
class ExplicitByThreads : public testing::TestWithParam<Case> {};

TEST_P(ExplicitByThreads, ComesToTheSameBits) {
  const auto one = run(GetParam().study, 1);
  EXPECT_GT(step::points_in_contact(one.state()), 20);
  for (const int threads : more_threads) {
    const auto several = run(GetParam().study, threads);
    test::expect_same(one.state(), several.state());
    test::expect_same(one.energy(), several.energy());
  }
}

INSTANTIATE_TEST_SUITE_P(Blocks, ExplicitByThreads,
                         testing::Values(Case{"Plastic", pressed_blocks(yields, explicit_)},
                                         Case{"Logarithmic",
                                              pressed_blocks(yields + ", strain: logarithmic", explicit_)}),
                         name_of);

/// Factors by several threads of BLAS differ by rounding.
class ImplicitByThreads : public testing::TestWithParam<Case> {};

TEST_P(ImplicitByThreads, DiffersByRounding) {
  const auto near = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    EXPECT_LE((a - b).lpNorm<Eigen::Infinity>(), 1e-10 * a.lpNorm<Eigen::Infinity>());
  };
  const auto one = run(GetParam().study, 1);
  EXPECT_GT(step::points_in_contact(one.state()), 20);
  for (const int threads : more_threads) {
    const auto several = run(GetParam().study, threads);
    near(one.state().motion.u, several.state().motion.u);
    near(one.state().motion.v, several.state().motion.v);
    near(one.state().contact_force, several.state().contact_force);
    EXPECT_NEAR(several.energy().external_work, one.energy().external_work, 1e-10 * one.energy().largest());
    EXPECT_LE(std::abs(several.energy().balance()), 1e-10 * several.energy().largest());
    EXPECT_EQ(one.counters().iterations, several.counters().iterations);
    test::expect_same(several.state(), run(GetParam().study, threads).state());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Blocks, ImplicitByThreads,
    testing::Values(Case{"Elastic", pressed_blocks("", implicit)},
                    Case{"Plastic", pressed_blocks(yields, implicit)},
                    Case{"Mortar", pressed_blocks("", ", integration: mortar" + implicit)},
                    Case{"Logarithmic", pressed_blocks(yields + ", strain: logarithmic", implicit)}),
    name_of);

} // namespace
} // namespace rubato::simulation
