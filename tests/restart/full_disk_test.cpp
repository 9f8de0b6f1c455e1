// SPDX-License-Identifier: LGPL-3.0-or-later
// Disks that fill up in the middle of a run: what was computed can be read, and is gone on from as if nothing
// had been.
#include "rubato/results/csv.hpp"

#include <gtest/gtest.h>

#include "cli/program.hpp"
#include "decks.hpp"
#include "same_results.hpp"
#include "support/scratch_folder.hpp"
#include <algorithm>
#include <sys/mount.h>

namespace rubato::full_disk_test {
namespace {

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    ++found;
  return found;
}

/// Every table is whole, and all have come equally far.
void expect_readable(const std::filesystem::path& folder) {
  EXPECT_NO_THROW(nlohmann::json::parse(test::text_of(folder / "run.json")));
  const auto rows = results::read_csv(folder / "probes.csv").rows.size();
  EXPECT_EQ(results::read_csv(folder / "energy.csv").rows.size(), rows);
  const auto resultants = results::read_csv(folder / "resultants_interface.csv").rows.size();
  EXPECT_EQ(resultants, rows - std::min<std::size_t>(rows, 1));
  EXPECT_NO_THROW(test::attempts_in(folder / "steps.jsonl"));
  for (const auto& name : test::files_in(folder))
    EXPECT_FALSE(name.ends_with(".new")) << name;
}

void expect_one_sentence(const test::Outcome& outcome) {
  EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
  EXPECT_EQ(count(outcome.err, "error: "), 1U) << outcome.err;
  EXPECT_NE(outcome.err.find(": writing failed"), std::string::npos) << outcome.err;
}

class FullDisk : public testing::TestWithParam<const std::string*> {
protected:
  FullDisk() {
    test::write_text(folder_ / "deck.yaml", *GetParam());
    EXPECT_EQ(run("whole").exit_code, 0);
  }

  test::Outcome run(const std::string& output, const std::vector<std::string>& more = {},
                    test::Limits limits = {}) const {
    std::vector<std::string> arguments{"run", "deck.yaml", "-q", "-o", output};
    if (GetParam() == &test::rubbing_beams)
      arguments.insert(arguments.end(), {"--only", "exact"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::run_program(arguments, folder_.path(), limits);
  }

  std::string name() const { return GetParam() == &test::rubbing_beams ? "exact" : "run"; }

  test::ScratchFolder folder_;
};

TEST_P(FullDisk, StopsARunThatGoesOnWhenThereIsRoomAgain) {
  int stopped = 0;
  for (const rlim_t bytes : {1500, 4000, 9000, 20000, 45000, 90000, 180000, 300000}) {
    std::filesystem::remove_all(folder_ / "out");
    const auto outcome = run("out", {}, {.file_size = bytes});
    if (outcome.exit_code == 0)
      continue;
    ++stopped;
    expect_one_sentence(outcome);
    if (std::filesystem::exists(folder_ / "out" / name() / "resultants_interface.csv"))
      expect_readable(folder_ / "out" / name());
    ASSERT_EQ(run("out", {"--resume"}).exit_code, 0) << bytes;
    test::expect_same_results(folder_ / "whole", folder_ / "out");
    ASSERT_FALSE(HasFailure()) << "files of at most " << bytes << " bytes\n" << outcome.err;
  }
  EXPECT_GT(stopped, 3);
}

/// A disk in memory; gone with the test.
class SmallDisk {
public:
  explicit SmallDisk(std::filesystem::path place) : place_(std::move(place)) {
    std::filesystem::create_directory(place_);
    mounted_ = resize("size=100k", 0);
  }
  ~SmallDisk() {
    if (mounted_)
      umount2(place_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool mounted() const { return mounted_; }
  bool grow(const std::string& size) const { return resize(size, MS_REMOUNT); }

private:
  bool resize(const std::string& size, unsigned long flags) const {
    return mount("tmpfs", place_.c_str(), "tmpfs", flags, size.c_str()) == 0;
  }

  std::filesystem::path place_;
  bool mounted_ = false;
};

TEST_P(FullDisk, InMemoryStopsARunThatGoesOnWhenItHasGrown) {
  const SmallDisk disk(folder_ / "small");
  if (!disk.mounted())
    GTEST_SKIP() << "this user may not mount a file system";
  int stopped = 0;
  for (const char* size : {"size=16k", "size=64k", "size=200k", "size=400k", "size=800k"}) {
    std::filesystem::remove_all(folder_ / "small/out");
    ASSERT_TRUE(disk.grow(size));
    const auto outcome = run("small/out");
    if (outcome.exit_code == 0)
      continue;
    ++stopped;
    expect_one_sentence(outcome);
    if (std::filesystem::exists(folder_ / "small/out" / name() / "resultants_interface.csv"))
      expect_readable(folder_ / "small/out" / name());
    ASSERT_TRUE(disk.grow("size=100m"));
    ASSERT_EQ(run("small/out", {"--resume"}).exit_code, 0) << size;
    test::expect_same_results(folder_ / "whole", folder_ / "small/out");
    ASSERT_FALSE(HasFailure()) << size << "\n" << outcome.err;
  }
  EXPECT_GT(stopped, 1);
}

INSTANTIATE_TEST_SUITE_P(Under, FullDisk, testing::Values(&test::rubbing_beams, &test::explicit_beams),
                         [](const auto& chosen) {
                           return chosen.param == &test::rubbing_beams ? "ImplicitSteps" : "ExplicitSteps";
                         });

} // namespace
} // namespace rubato::full_disk_test
