// SPDX-License-Identifier: LGPL-3.0-or-later
// A recorder as an observer: what another observer did not take is in no file.
#include "rubato/results/csv.hpp"
#include "rubato/results/recorder.hpp"
#include "rubato/simulation/time_integration.hpp"

#include "support/scratch_folder.hpp"
#include "support/simulated_blocks.hpp"
#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace rubato::results::take_back_test {
namespace {

/// Blocks with fields after every second step.
study::Study blocks() {
  auto study = test::implicit_blocks();
  study.fields.vtu = true;
  study.fields.every = 2;
  study.fields.last = true;
  return study;
}

void record(simulation::Simulation& simulation, Recorder& recorder) {
  recorder.start(simulation.state());
  recorder.energy(simulation.state().t, simulation.energy());
  simulation.observe(
      {.accepted =
           [&](const simulation::AcceptedStep& step) {
             recorder.step(step.before, step.now, step.attempt, step.report, step.last);
             recorder.energy(step.now.t, step.energy);
           },
       .rejected = [&](const simulation::RejectedStep& step) { recorder.failed(step.attempt, step.report); },
       .take_back = [&](const step::State&) { recorder.take_back(); }});
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::ptrdiff_t lines_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  return std::count(std::istreambuf_iterator<char>(file), {}, '\n');
}

void expect_same_tables(const std::filesystem::path& a, const std::filesystem::path& b) {
  for (const auto* name : {"probes.csv", "energy.csv", "resultants_interface.csv"})
    EXPECT_EQ(read_csv(a / name).rows, read_csv(b / name).rows) << name;
  EXPECT_EQ(text_of(a / "contact_interface.csv"), text_of(b / "contact_interface.csv"));
  EXPECT_EQ(lines_of(a / "steps.jsonl"), lines_of(b / "steps.jsonl"));
}

TEST(ARecorderAmongObservers, TakesBackAStepThatItHasWrittenWhole) {
  const test::ScratchFolder folder;
  simulation::Simulation undisturbed(blocks());
  Recorder whole(undisturbed.model(), folder / "whole");
  record(undisturbed, whole);

  simulation::Simulation disturbed(blocks());
  Recorder recorder(disturbed.model(), folder / "disturbed");
  record(disturbed, recorder);
  bool throws = false;
  disturbed.observe({.accepted = [&](const simulation::AcceptedStep&) {
    throws = !throws;
    if (throws)
      throw std::runtime_error("no");
  }});
  while (!undisturbed.finished()) {
    const auto before = recorder.position();
    EXPECT_THROW(disturbed.advance(), std::runtime_error);
    const auto after = recorder.position();
    EXPECT_EQ(after.steps, before.steps);
    EXPECT_EQ(after.field_files, before.field_files);
    EXPECT_EQ(after.unwritten, before.unwritten);
    expect_same_tables(folder / "disturbed", folder / "whole");
    ASSERT_TRUE(disturbed.advance().accepted());
    ASSERT_TRUE(undisturbed.advance().accepted());
    expect_same_tables(folder / "disturbed", folder / "whole");
    EXPECT_EQ(recorder.position().unwritten, whole.position().unwritten);
    EXPECT_EQ(recorder.position().field_files, whole.position().field_files);
  }
  EXPECT_EQ(recorder.position().field_files.size(), 3U);
}

TEST(ARecorderAmongObservers, TakesBackAnAttemptThatFailed) {
  const test::ScratchFolder folder;
  simulation::Simulation simulation(blocks());
  Recorder recorder(simulation.model(), folder / "run");
  record(simulation, recorder);
  ASSERT_TRUE(simulation.advance().accepted());
  const auto before = recorder.position();
  recorder.failed({.begin = 1e-4, .end = 2e-4}, {});
  EXPECT_GT(recorder.position().attempts, before.attempts);
  recorder.take_back();
  EXPECT_EQ(recorder.position().attempts, before.attempts);
  EXPECT_EQ(recorder.position().probes, before.probes) << "the step before is not taken back";
  EXPECT_EQ(recorder.position().steps, before.steps);
  EXPECT_EQ(lines_of(folder / "run/steps.jsonl"), 1);
}

} // namespace
} // namespace rubato::results::take_back_test
