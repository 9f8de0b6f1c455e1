// SPDX-License-Identifier: LGPL-3.0-or-later
// `rubato report` at the command line; the page itself: tests/browser.
#include <gtest/gtest.h>

#include "program.hpp"
#include "support/two_blocks.hpp"

namespace rubato::test::report_test {
namespace {

namespace fs = std::filesystem;

class ReportOfRuns : public testing::Test {
protected:
  /// Into blocks/rest.
  void run(const std::string& fields = "") {
    write_text(folder_ / "blocks.yaml", two_blocks + fields + "runs: {rest: {}}\n");
    const auto done = run_program({"run", "blocks.yaml", "-q"}, folder_.path());
    ASSERT_EQ(done.exit_code, 0) << done.err;
  }
  Outcome report(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "report");
    return run_program(arguments, folder_.path());
  }

  ScratchFolder folder_;
};

TEST_F(ReportOfRuns, StandsInTheFolderOfTheRun) {
  run("fields: {every: 1}\n");
  const auto done = report({"blocks/rest"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(done.err, "");
  EXPECT_TRUE(done.out.starts_with("blocks/rest/report.html: ")) << done.out;
  EXPECT_GT(fs::file_size(folder_ / "blocks/rest/report.html"), 100'000U);
}

TEST_F(ReportOfRuns, WithoutFieldsSaysHowToGetThem) {
  run();
  const auto done = report({"blocks/rest"});
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_TRUE(
      done.err.starts_with("blocks/rest: The run stored no fields, so that there is no view of it. They are "
                           "stored with 'fields: {at: ["))
      << done.err;
}

TEST_F(ReportOfRuns, GoesWithTheOtherFilesOfAFormerRun) {
  run();
  ASSERT_EQ(report({"blocks/rest"}).exit_code, 0);
  run();
  EXPECT_FALSE(fs::exists(folder_ / "blocks/rest/report.html"));
  EXPECT_TRUE(fs::exists(folder_ / "blocks/rest/former/report.html"));
}

TEST_F(ReportOfRuns, NeedsTheFolderOfARun) {
  run();
  EXPECT_EQ(report({"blocks"}).exit_code, 2);
  EXPECT_EQ(report({"blocks"}).err,
            "error: blocks: found no run.json, expected the folder of a run; there are blocks/rest\n");
  const auto second = report({"blocks/rest", "blocks/rust"});
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_NE(second.err.find("did you mean 'blocks/rest'?"), std::string::npos) << second.err;
  EXPECT_FALSE(fs::exists(folder_ / "blocks/rest/report.html"));
}

TEST_F(ReportOfRuns, TakesTwoAtMost) {
  run();
  EXPECT_EQ(report({"blocks/rest", "blocks/rest", "blocks/rest"}).exit_code, 2);
}

TEST_F(ReportOfRuns, LeavesTheFormerFileWhereItCannotBeWritten) {
  run();
  write_text(folder_ / "kept.html", "former");
  fs::create_directory(folder_ / "kept.html.new"); // where the new one would be written first
  const auto done = report({"blocks/rest", "-o", "kept.html"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_EQ(done.err,
            "error: kept.html: cannot be written: is there such a folder, and may you write into it?\n");
  EXPECT_EQ(text_of(folder_ / "kept.html"), "former");
}

TEST_F(ReportOfRuns, InAFolderThatDoesNotExistIsRefused) {
  run();
  const auto done = report({"blocks/rest", "-o", "none/report.html"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_EQ(
      done.err,
      "error: none/report.html: cannot be written: is there such a folder, and may you write into it?\n");
  EXPECT_FALSE(fs::exists(folder_ / "none"));
}

} // namespace
} // namespace rubato::test::report_test
