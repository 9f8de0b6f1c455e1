// SPDX-License-Identifier: LGPL-3.0-or-later
// Faults of the world around the program: one clear sentence, the right exit code, and nothing lost.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "support/two_blocks.hpp"
#include <algorithm>
#include <csignal>

namespace rubato::world_test {
namespace {

using test::text_of;
using test::two_blocks;

/// So many steps that nobody waits for their end.
const std::string endless = test::with(two_blocks, "step: 1e-4, end: 4e-4", "step: 1e-4, end: 1e3");

class World : public testing::Test {
protected:
  World() { test::write_text(folder_ / "deck.yaml", two_blocks); }

  test::Outcome run(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"run", "deck.yaml"});
    return test::run_program(more, folder_.path());
  }

  static std::ptrdiff_t lines(const std::string& text) { return std::ranges::count(text, '\n'); }

  test::ScratchFolder folder_;
};

TEST_F(World, LetsOneRunAloneInAFolder) {
  test::write_text(folder_ / "endless.yaml", endless);
  test::Program first({"run", "endless.yaml", "-o", "out", "-q"}, folder_.path());
  const auto summary = folder_ / "out/run/run.json";
  // The summary is complete before the first step.
  ASSERT_TRUE(test::wait_for_steps(first, folder_ / "out/run/steps.jsonl"));
  // The run goes on and may warn.
  const auto start_of_summary = [&] {
    const auto text = text_of(summary);
    return text.substr(0, text.find("\"warnings\""));
  };
  const auto before = start_of_summary();
  for (const bool resumed : {false, true}) {
    const auto second = run(resumed ? std::vector<std::string>{"-q", "-o", "out", "--resume"}
                                    : std::vector<std::string>{"-q", "-o", "out"});
    EXPECT_EQ(second.exit_code, 2);
    EXPECT_EQ(second.err,
              "error: out/run: another run is writing into this folder; expected another one (-o), or "
              "patience until that run has ended\n");
  }
  EXPECT_EQ(start_of_summary(), before);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/run/former"));
  EXPECT_TRUE(first.is_running());
  first.send(SIGKILL);
  first.wait();
  EXPECT_EQ(run({"-q", "-o", "out"}).exit_code, 0) << "what was killed holds nothing";
}

TEST_F(World, KeepsTheResultsOfAFormerRun) {
  ASSERT_EQ(run({"-o", "out"}).exit_code, 0);
  const auto probes = text_of(folder_ / "out/run/probes.csv");
  const auto outcome = run({"-o", "out", "--set", "time.end=2e-4"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("run: the former results in out/run move into out/run/former\n"),
            std::string::npos)
      << outcome.err;
  EXPECT_EQ(text_of(folder_ / "out/run/former/probes.csv"), probes);
  EXPECT_LT(text_of(folder_ / "out/run/probes.csv").size(), probes.size());
  EXPECT_EQ(test::run_program({"check", "out/run/former"}, folder_.path()).exit_code, 0);
}

TEST_F(World, IsToldWhereNothingCanBeWritten) {
  const auto nowhere = run({"-q", "-o", "/proc/rubato"});
  EXPECT_EQ(nowhere.exit_code, 2);
  EXPECT_EQ(nowhere.err,
            "error: /proc/rubato/run: the folder of results cannot be made (No such file or directory)\n");
  std::filesystem::create_directories(folder_ / "out/run/probes.csv");
  const auto taken = run({"-q", "-o", "out"});
  EXPECT_EQ(taken.exit_code, 2);
  EXPECT_EQ(taken.err, "error: out/run/probes.csv: cannot be written\n");
}

TEST_F(World, IsToldWhenAFolderIsReadOnly) {
  if (geteuid() == 0)
    GTEST_SKIP() << "permissions do not bind this user";
  std::filesystem::create_directories(folder_ / "out/run");
  std::filesystem::permissions(folder_ / "out/run",
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  const auto outcome = run({"-q", "-o", "out"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "error: out/run/probes.csv: cannot be written\n");
  std::filesystem::permissions(folder_ / "out/run", std::filesystem::perms::owner_all);
}

TEST_F(World, KeepsWhatWasComputedWhenTheMeshFileHasVanished) {
  ASSERT_EQ(test::run_program({"mesh", "deck.yaml", "blocks.med"}, folder_.path()).exit_code, 0);
  const std::vector<std::string> on_file{"-q", "-o", "out", "--set", "mesh.file=blocks.med"};
  ASSERT_EQ(run(on_file).exit_code, 0);
  std::filesystem::remove(folder_ / "blocks.med");
  const auto probes = text_of(folder_ / "out/run/probes.csv");
  auto resumed = on_file;
  resumed.insert(resumed.end(), {"--resume", "--set", "time.end=6e-4"});
  for (const auto& arguments : {on_file, resumed}) {
    const auto outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err, "error: --set mesh.file: mesh file 'blocks.med' does not exist\n");
    EXPECT_EQ(text_of(folder_ / "out/run/probes.csv"), probes);
  }
}

class FullFile : public World, public testing::WithParamInterface<const char*> {};

TEST_P(FullFile, EndsTheRunWithOneSentence) {
  const std::string file = GetParam();
  std::filesystem::create_directories(folder_ / "out/run");
  std::filesystem::create_symlink("/dev/full", folder_ / ("out/run/" + file));
  const auto outcome = run({"-q", "-o", "out"});
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
  EXPECT_NE(outcome.err.find("out/run/" + file + ": writing failed (No space left on device)"),
            std::string::npos)
      << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(Named, FullFile,
                         testing::Values("probes.csv", "energy.csv", "steps.jsonl",
                                         "resultants_interface.csv"),
                         [](const auto& chosen) { return std::string(chosen.param).substr(0, 5); });

TEST_F(World, IsToldWhenAMeshDoesNotFitOnTheDisk) {
  test::write_text(folder_ / "mesh.vtu", "former");
  test::write_text(folder_ / "mesh.med", "former");
  for (const char* output : {"mesh.vtu", "mesh.med"}) {
    const auto outcome =
        test::run_program({"mesh", "deck.yaml", output}, folder_.path(), {.file_size = 1000});
    EXPECT_EQ(outcome.exit_code, 4) << output;
    EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(std::string("error: ") + output + ": writing failed"), std::string::npos)
        << outcome.err;
    EXPECT_EQ(text_of(folder_ / output), "former");
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "mesh.vtu.new"));
}

} // namespace
} // namespace rubato::world_test
