// SPDX-License-Identifier: LGPL-3.0-or-later
// What a folder tells of the run that wrote it.
#include "rubato/results/stored_run.hpp"

#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include "support/two_blocks.hpp"
#include <filesystem>
#include <fstream>

namespace rubato::results::stored_run_test {
namespace {

namespace fs = std::filesystem;
using test::fault_of;
using test::with;
using Folders = std::vector<fs::path>;

const std::string summary =
    R"({"run": "after", "status": "interrupted", "reason": "asked at t = 1", "study": {"title": "two blocks"}})";

class FolderOfARun : public testing::Test {
protected:
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
  }
  /// A folder of that name with this run.json and two records of a probe.
  void keep(const std::string& name, const std::string& json) const {
    write(name + "/run.json", json);
    write(name + "/probes.csv", "t,tip.x\n0,0.5\n1,0.25\n");
  }
  StoredRun stored() const { return read_stored_run(folder_ / "run"); }

  test::ScratchFolder folder_;
};

TEST_F(FolderOfARun, TellsItsNameItsStudyAndItsProbes) {
  keep("run", summary);
  const auto run = stored();
  EXPECT_EQ(run.name, "after");
  EXPECT_EQ(run.status, RunStatus::interrupted);
  EXPECT_EQ(run.reason, "asked at t = 1");
  EXPECT_EQ(run.study, R"({"title":"two blocks"})");
  EXPECT_EQ(run.probes.columns, (std::vector<std::string>{"t", "tip.x"}));
  EXPECT_EQ(run.probes.rows, (std::vector<std::vector<double>>{{0, 0.5}, {1, 0.25}}));
}

TEST_F(FolderOfARun, TellsHowFarTheRunCame) {
  for (const auto& entry : run_status_words) {
    keep("run", with(summary, "interrupted", entry.word));
    EXPECT_EQ(stored().status, entry.status) << entry.word;
  }
}

TEST_F(FolderOfARun, MustHoldASummaryOfARun) {
  const auto file = (folder_ / "run/run.json").string();
  EXPECT_EQ(fault_of([&] { stored(); }), file + ": cannot be read");
  keep("run", "{");
  EXPECT_EQ(fault_of([&] { stored(); }).rfind(file + ": found no valid JSON (", 0), 0U);
  keep("run", with(summary, "interrupted", "asleep"));
  EXPECT_EQ(fault_of([&] { stored(); }), file + ": found the status 'asleep', which no run has");
  for (const char* word : {"run", "status", "reason", "study"}) {
    keep("run", with(summary, '"' + std::string(word) + "\":", "\"other\":"));
    EXPECT_EQ(fault_of([&] { stored(); }).rfind(file + ": not the summary of a run (", 0), 0U) << word;
  }
  keep("run", with(summary, "\"after\"", "7"));
  EXPECT_EQ(fault_of([&] { stored(); }).rfind(file + ": not the summary of a run (", 0), 0U);
}

TEST_F(FolderOfARun, MustHoldProbes) {
  write("run/run.json", summary);
  EXPECT_NE(fault_of([&] { stored(); }).find("probes.csv"), std::string::npos);
}

TEST_F(FolderOfARun, IsFoundItselfOrBelow) {
  keep("deck/second", summary);
  keep("deck/first", summary);
  keep("deck/first/former", summary);
  write("deck/notes/text.txt", "no run");
  write("deck/run.txt", "no run either");
  EXPECT_EQ(run_folders(folder_ / "deck"), (Folders{folder_ / "deck/first", folder_ / "deck/second"}));
  EXPECT_EQ(run_folders(folder_ / "deck/first"), Folders{folder_ / "deck/first"});
}

TEST_F(FolderOfARun, IsAskedForWhereThereIsNone) {
  fs::create_directories(folder_ / "empty");
  for (const char* name : {"empty", "missing"})
    EXPECT_EQ(fault_of([&] { run_folders(folder_ / name); }),
              (folder_ / name).string() + ": found no run.json, expected the folder of a run");
}

} // namespace
} // namespace rubato::results::stored_run_test
