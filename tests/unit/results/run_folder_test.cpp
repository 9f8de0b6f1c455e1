// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/run_folder.hpp"

#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include <fstream>

namespace rubato::results::run_folder_test {
namespace {

namespace fs = std::filesystem;
using test::fault_of;
using test::ScratchFolder;

void touch(const fs::path& path) {
  fs::create_directories(path.parent_path());
  std::ofstream(path) << "x";
}

TEST(RunFolderPreparation, MakesTheFolderAndThoseAboveIt) {
  const ScratchFolder scratch;
  prepare_run_folder(scratch / "a/b/c");
  EXPECT_TRUE(fs::is_directory(scratch / "a/b/c"));
  prepare_run_folder(scratch / "a/b/c");
}

TEST(RunFolderPreparation, MovesWhatTheFormerRunWroteAndNothingElse) {
  const ScratchFolder scratch;
  const std::vector<fs::path> written{summary_file,
                                      probes_file,
                                      steps_file,
                                      pvd_file,
                                      med_file,
                                      vtkhdf_file,
                                      resultants_file("interface"),
                                      contact_file("interface"),
                                      fs::path(vtu_folder) / vtu_file(0),
                                      fs::path(vtu_folder) / vtu_file(1234567)};
  const std::vector<fs::path> foreign{"notes.csv", "deck.yaml", "fields/mine.vtu", "fields/000001.png",
                                      "other/probes.csv"};
  for (const auto& file : written)
    touch(scratch.path() / file);
  for (const auto& file : foreign)
    touch(scratch.path() / file);
  prepare_run_folder(scratch.path());
  for (const auto& file : written) {
    EXPECT_FALSE(fs::exists(scratch.path() / file)) << file;
    EXPECT_TRUE(fs::exists(scratch.path() / former_folder / file)) << file;
  }
  for (const auto& file : foreign)
    EXPECT_TRUE(fs::exists(scratch.path() / file)) << file;
}

TEST(RunFolderPreparation, KeepsTheLastFormerRunOnly) {
  const ScratchFolder scratch;
  for (const char* file : {"run.json", "probes.csv", "energy.csv", "fields/000001.vtu"})
    touch(scratch / file);
  prepare_run_folder(scratch.path());
  for (const char* file : {"run.json", "probes.csv"})
    touch(scratch / file);
  prepare_run_folder(scratch.path());
  EXPECT_TRUE(fs::exists(scratch / "former/probes.csv"));
  EXPECT_FALSE(fs::exists(scratch / "former/energy.csv"));
  EXPECT_FALSE(fs::exists(scratch / "former/fields"));
}

TEST(RunFolderContents, HasTheNamesOfItsContactZones) {
  const ScratchFolder folder;
  EXPECT_EQ(contact_zones(folder.path()), std::vector<std::string>{});
  for (const auto* name : {"resultants_seat.csv", "resultants_a_b.csv", "contact_seat.csv", "probes.csv"})
    std::ofstream(folder / name) << "t\n";
  EXPECT_EQ(contact_zones(folder.path()), (std::vector<std::string>{"a_b", "seat"}));
}

TEST(RunFolderClaim, IsOneProgramsAtATime) {
  const ScratchFolder scratch;
  const auto folder = scratch / "run";
  {
    FolderClaim claim(folder);
    EXPECT_FALSE(fs::exists(folder)) << "what may still be refused makes no folder";
    claim.make();
    EXPECT_EQ(fault_of([&] { FolderClaim other(folder); }),
              folder.string() + ": another run is writing into this folder; expected another one (-o), or "
                                "patience until that run has ended");
  }
  FolderClaim next(folder);
  EXPECT_THROW(FolderClaim(folder).make(), InputError);
}

TEST(RunFolderPreparation, MovesNothingWhereNoRunHasBeen) {
  const ScratchFolder scratch;
  touch(scratch / "probes.csv");
  prepare_run_folder(scratch.path());
  EXPECT_TRUE(fs::exists(scratch / "probes.csv"));
}

TEST(RunFolderPreparation, IsRefusedWhereAFileStands) {
  const ScratchFolder scratch;
  touch(scratch / "file");
  EXPECT_NE(fault_of([&] {
              prepare_run_folder(scratch / "file");
            }).find("file: the folder of results cannot be made"),
            std::string::npos);
  EXPECT_NE(fault_of([&] { prepare_run_folder(scratch / "file/run"); }).find("cannot be made"),
            std::string::npos);
}

} // namespace
} // namespace rubato::results::run_folder_test
