// SPDX-License-Identifier: LGPL-3.0-or-later
// Files that are written whole or not at all.
#include "rubato/core/error.hpp"
#include "rubato/core/writing.hpp"
#include "rubato/results/csv.hpp"

#include <gtest/gtest.h>

#include "support/scratch_folder.hpp"
#include <array>
#include <cerrno>
#include <fstream>
#include <iterator>

namespace rubato::writing_test {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

template <class Call> std::string write_error_of(const Call& call) {
  try {
    call();
  } catch (const WriteError& error) {
    return error.what();
  }
  return "nothing thrown";
}

class WholeFile : public testing::Test {
protected:
  WholeFile() { std::ofstream(path_) << "former"; }

  const test::ScratchFolder folder_;
  const fs::path path_ = folder_ / "a.txt";
};

TEST_F(WholeFile, TakesThePlaceOfTheFormerOne) {
  write_whole(path_, [&](const fs::path& beside) {
    std::ofstream(beside) << "new";
    EXPECT_EQ(text_of(path_), "former");
  });
  EXPECT_EQ(text_of(path_), "new");
}

TEST_F(WholeFile, LeavesTheFormerOneAndNothingElseWhenWritingFails) {
  EXPECT_EQ(write_error_of([&] {
              write_whole(path_, [](const fs::path& beside) {
                std::ofstream(beside) << "ne";
                throw WriteError(beside, ENOSPC);
              });
            }),
            path_.string() + ": writing failed (No space left on device)");
  EXPECT_EQ(text_of(path_), "former");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 1);
}

TEST_F(WholeFile, LetsOtherFaultsPass) {
  EXPECT_THROW(write_whole(path_, [](const fs::path&) { throw InputError("no such folder"); }), InputError);
  EXPECT_EQ(text_of(path_), "former");
}

TEST(StreamAtItsEnd, TellsOfWhatTheDiskDidNotTake) {
  std::ofstream stream("/dev/full");
  stream << "text";
  EXPECT_EQ(write_error_of([&] { finish_writing(stream, "results.txt"); }),
            "results.txt: writing failed (No space left on device)");
}

TEST(Room, IsAskedForBeforehand) {
  const test::ScratchFolder folder;
  require_room(folder / "a", 1);
  EXPECT_EQ(write_error_of([&] { require_room(folder / "a", UINTMAX_MAX / 2); }),
            (folder / "a").string() + ": writing failed (No space left on device)");
}

TEST(CsvFile, IsCutBackToItsWholeLines) {
  const test::ScratchFolder folder;
  results::CsvWriter writer(folder / "a.csv", std::array<std::string, 2>{"t", "x"});
  writer.row(std::array{1., 2.});
  const auto bytes = writer.bytes();
  writer.row(std::array{3., 4.});
  writer.cut(bytes);
  writer.row(std::array{5., 6.});
  EXPECT_EQ(text_of(folder / "a.csv"), "t,x\n1,2\n5,6\n");
}

TEST(CsvFile, TellsOfAFullDisk) {
  const test::ScratchFolder folder;
  fs::create_symlink("/dev/full", folder / "a.csv");
  EXPECT_EQ(write_error_of([&] { results::CsvWriter(folder / "a.csv", std::array<std::string, 1>{"t"}); }),
            (folder / "a.csv").string() + ": writing failed (No space left on device)");
}

} // namespace
} // namespace rubato::writing_test
