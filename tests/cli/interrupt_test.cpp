// SPDX-License-Identifier: LGPL-3.0-or-later
// Ctrl-C: the run stops after its step, everything written can be read.
#include "rubato/results/csv.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "support/two_blocks.hpp"
#include <chrono>
#include <csignal>
#include <thread>

namespace rubato::interrupt_test {
namespace {

using namespace std::chrono_literals;

/// So many steps that nobody waits for their end.
const std::string endless = test::with(test::two_blocks, "step: 1e-4, end: 4e-4", "step: 1e-4, end: 1e3") +
                            "fields: {formats: [vtu, med]}\n";

class InterruptedBy : public testing::TestWithParam<int> {};

TEST_P(InterruptedBy, ASignalTheRunClosesItsFilesAndSaysWhereItStopped) {
  const test::ScratchFolder folder;
  test::write_text(folder / "deck.yaml", endless);
  test::Program program({"run", "deck.yaml", "-o", "out", "-q"}, folder.path());
  ASSERT_TRUE(test::wait_for_steps(program, folder / "out/run/steps.jsonl"));
  EXPECT_EQ(nlohmann::json::parse(test::text_of(folder / "out/run/run.json")).at("status"), "running");
  program.send(GetParam());
  const auto outcome = program.wait();
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_NE(outcome.err.find("error: run: interrupted at t = "), std::string::npos) << outcome.err;

  const auto json = nlohmann::json::parse(test::text_of(folder / "out/run/run.json"));
  EXPECT_EQ(json.at("status"), "interrupted");
  const auto probes = results::read_csv(folder / "out/run/probes.csv");
  EXPECT_EQ(probes.rows.size(), json.at("steps").get<std::size_t>() + 1);
  EXPECT_NE(test::text_of(folder / "out/run/fields.pvd").find("</VTKFile>"), std::string::npos)
      << "the last instant reached has its fields";
  EXPECT_EQ(test::run_program({"check", "out"}, folder.path()).exit_code, 4);
}

INSTANTIATE_TEST_SUITE_P(Signal, InterruptedBy, testing::Values(SIGINT, SIGTERM), [](const auto& chosen) {
  return chosen.param == SIGINT ? "Interrupt" : "Terminate";
});

/// Each of the iterations factors the whole system of a fine mesh, and the signal comes in one of the first.
TEST(InterruptInsideAStep, EndsItAndTheRunGoesOn) {
  const test::ScratchFolder folder;
  const auto fine = test::with(test::two_blocks, "physics: plane_stress",
                               "  refine: 24\nphysics: plane_stress\nsolver: full");
  test::write_text(folder / "deck.yaml", test::with(fine, "end: 4e-4", "end: 1e-4"));
  test::Program program({"run", "deck.yaml", "-o", "out"}, folder.path());
  while (program.is_running() && !std::filesystem::exists(folder / "out/run/energy.csv"))
    std::this_thread::sleep_for(1ms);
  ASSERT_TRUE(program.is_running());
  program.send(SIGINT);
  const auto outcome = program.wait();
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_NE(outcome.err.find("stopping; a factorisation at hand comes to its end"), std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("error: run: interrupted at t = 0"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("--resume goes on from there"), std::string::npos) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(test::text_of(folder / "out/run/run.json")).at("steps"), 0);
  EXPECT_EQ(test::text_of(folder / "out/run/steps.jsonl"), "");
  EXPECT_EQ(test::run_program({"run", "deck.yaml", "-o", "out", "-q", "--resume"}, folder.path()).exit_code,
            0);
}

/// The mesh is so fine that a step takes much longer than two signals.
TEST(SecondInterrupt, KillsAtOnce) {
  const test::ScratchFolder folder;
  test::write_text(folder / "deck.yaml", endless);
  test::Program program({"run", "deck.yaml", "-o", "out", "-q", "--set", "mesh.refine=30"}, folder.path());
  while (program.is_running() && !std::filesystem::exists(folder / "out/run/run.json"))
    std::this_thread::sleep_for(5ms);
  program.send(SIGINT);
  program.send(SIGTERM);
  const auto code = program.wait().exit_code;
  EXPECT_TRUE(code == -SIGINT || code == -SIGTERM) << code;
}

TEST(KilledRun, LeavesAFolderThatSaysSo) {
  const test::ScratchFolder folder;
  test::write_text(folder / "deck.yaml", endless);
  test::Program program({"run", "deck.yaml", "-o", "out", "-q"}, folder.path());
  ASSERT_TRUE(test::wait_for_steps(program, folder / "out/run/steps.jsonl"));
  program.send(SIGKILL);
  EXPECT_EQ(program.wait().exit_code, -SIGKILL);
  const auto outcome = test::run_program({"check", "out"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_TRUE(outcome.out.starts_with("run: the run did not come to its end\n")) << outcome.out;
}

} // namespace
} // namespace rubato::interrupt_test
