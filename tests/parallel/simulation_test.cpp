// SPDX-License-Identifier: LGPL-3.0-or-later
// Simulations by several threads against those by one.
#include "rubato/core/threads.hpp"

#include "pressed_blocks.hpp"
#include "support/simulated_blocks.hpp"
#include <string>

namespace rubato::simulation::simulation_test {
namespace {

using namespace test::blocks;

constexpr std::array more_threads{2, 3};

Simulation run(const study::Study& study, int threads) {
  Start start;
  start.workers = Threads(threads);
  Simulation simulation(study, start);
  test::go_to_end(simulation);
  return simulation;
}

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
} // namespace rubato::simulation::simulation_test
