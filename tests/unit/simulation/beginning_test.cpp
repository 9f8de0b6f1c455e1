// SPDX-License-Identifier: LGPL-3.0-or-later
// Where simulations begin, and what they refuse.
#include "rubato/deck/read.hpp"

#include "support/faults.hpp"
#include "support/simulated_blocks.hpp"
#include <algorithm>
#include <stdexcept>
#include <string>

namespace rubato::simulation::beginning_test {
namespace {

using test::expect_same;
using test::fault_of;
using test::with;

const std::string pressed = test::preloaded_blocks("2e-4");

study::Study run_of(const std::string& deck, const std::string& name) {
  const auto runs = deck::parse_deck(deck, "deck.yaml").runs;
  return *std::ranges::find(runs, name, &study::Study::name);
}

std::string path_of_fault(const study::Study& study, const Start& start = {}) {
  try {
    const Simulation simulation(study, start);
    return "nothing refused";
  } catch (const InputError& error) {
    return error.faults().front().path;
  }
}

TEST(ASimulation, RefusesWhatItsStudyBreaks) {
  auto study = test::implicit_blocks();
  study.materials[0].young = -1;
  EXPECT_EQ(path_of_fault(study), "materials.steel.young");
  study = test::implicit_blocks();
  study.supports[0].on = "nowhere";
  EXPECT_EQ(path_of_fault(study), "supports.0.on");
  study = test::explicit_blocks();
  study.time.step = 1e-4;
  EXPECT_EQ(path_of_fault(study), "time.step") << "not stable";
}

TEST(ASimulation, StartsFromTheEndOfAnotherRun) {
  Simulation preload(run_of(pressed, "preload"));
  test::go_to_end(preload);
  const auto study = run_of(pressed, "after");
  Simulation after(study, {.previous = &preload.state()});
  EXPECT_EQ(after.state().t, study.time.begin);
  EXPECT_EQ(after.state().motion.u, preload.state().motion.u);
  auto zones = preload.state().zones;
  for (auto& zone : zones)
    std::ranges::fill(zone.friction_history, contact::FrictionHistory());
  EXPECT_EQ(after.state().zones, zones) << "slips and works are counted anew, all else goes on";
  test::go_to_end(after);
  const double moved = (after.state().motion.u - preload.state().motion.u).cwiseAbs().maxCoeff();
  EXPECT_LE(moved, 1e-9 * preload.state().motion.u.cwiseAbs().maxCoeff()) << "the loads are the same";
}

TEST(ASimulation, RefusesAnEndThatIsNotThereOrOfAnotherMesh) {
  const auto after = run_of(pressed, "after");
  EXPECT_THROW(Simulation{after}, std::invalid_argument);
  const auto finer =
      with(pressed, "lower\n      rectangle: {from: [0, -0.2], to: [1, 0]}\n      divisions: [4, 2]",
           "lower\n      rectangle: {from: [0, -0.2], to: [1, 0]}\n      divisions: [5, 2]");
  Simulation other(run_of(finer, "preload"));
  EXPECT_EQ(path_of_fault(after, {.previous = &other.state()}), "time.start.from");
}

TEST(ASimulation, RefusesAMementoOfAnother) {
  Simulation implicit(test::implicit_blocks());
  Simulation moving(test::explicit_blocks());
  const auto before = implicit.memento();
  EXPECT_NE(fault_of([&] { implicit.restore(moving.memento()); }).find("of another kind"), std::string::npos);
  EXPECT_NE(fault_of([&] { moving.restore(before); }).find("of another kind"), std::string::npos);

  auto finer = test::implicit_blocks();
  finer.mesh.refine = 2;
  const auto of_finer = Simulation(finer).memento();
  EXPECT_NE(fault_of([&] { implicit.restore(of_finer); }).find("another mesh"), std::string::npos);
  EXPECT_NE(
      fault_of([&] { Simulation(test::implicit_blocks(), {.memento = &of_finer}); }).find("another mesh"),
      std::string::npos);
  expect_same(implicit.memento(), before);
  ASSERT_TRUE(implicit.advance().accepted());
}

TEST(ASimulation, SaysHowItStepsAndWhatMemoryItsMatrixTakes) {
  std::size_t bytes = 0;
  const Simulation implicit(test::implicit_blocks(), {.tell_memory = [&](std::size_t now) { bytes = now; }});
  EXPECT_GT(bytes, 0U);
  EXPECT_EQ(implicit.method().substr(0, 17), "solver condensed ") << implicit.method();
  const Simulation moving(test::explicit_blocks());
  EXPECT_EQ(moving.method().substr(0, 12), "stable step ") << moving.method();
}

} // namespace
} // namespace rubato::simulation::beginning_test
