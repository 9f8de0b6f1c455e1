// SPDX-License-Identifier: LGPL-3.0-or-later
// The program where a library is broken that it loads when it first uses it.
#include <gtest/gtest.h>

#include "broken_library.hpp"
#include "program.hpp"
#include "support/two_blocks.hpp"
#include <algorithm>
#include <filesystem>

namespace rubato::cli::broken_libraries_test {
namespace {

using test::BrokenLibrary;
using test::run_program;

class BrokenLibraries : public testing::Test {
protected:
  BrokenLibraries() { test::write_text(folder_ / "deck.yaml", test::two_blocks); }

  test::Outcome run(const std::vector<std::string>& settings = {},
                    const std::string& program = RUBATO_PROGRAM) const {
    std::vector<std::string> arguments{"run", "deck.yaml", "-q", "-o", "out"};
    arguments.insert(arguments.end(), settings.begin(), settings.end());
    return test::Program(arguments, folder_.path(), {}, program).wait();
  }

  /// The program without the modules that are built with it, so that it loads the HDF5 of the system.
  std::string program_alone() const {
    const auto copy = folder_ / "rubato";
    std::filesystem::copy_file(RUBATO_PROGRAM, copy);
    return copy.string();
  }

  bool has_checkpoint() const { return std::filesystem::exists(folder_ / "out/run/checkpoint.h5"); }

  void expect_refusal(const test::Outcome& outcome, const std::string& begin, const std::string& end) const {
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(outcome.err.starts_with(begin)) << outcome.err;
    EXPECT_TRUE(outcome.err.ends_with(end + "\n")) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  }

  test::ScratchFolder folder_;
};

TEST_F(BrokenLibraries, AreNotLoadedByRunsThatDoNotUseThem) {
  const BrokenLibrary med(RUBATO_MED_LIBRARY);
  const BrokenLibrary hdf5(RUBATO_HDF5_LIBRARY);
  const BrokenLibrary rsvg(RUBATO_RSVG_LIBRARY);
  const auto outcome = run({"--set", "checkpoint.last=false"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
}

TEST_F(BrokenLibraries, AreNamedWhereAMedMeshIsRead) {
  const BrokenLibrary med(RUBATO_MED_LIBRARY);
  test::write_text(folder_ / "mesh.med", "");
  expect_refusal(run_program({"info", "mesh.med"}, folder_.path()),
                 "error: MED files need the library " RUBATO_MED_LIBRARY ", which cannot be loaded (",
                 "); install the Debian package " RUBATO_MED_PACKAGE);
}

TEST_F(BrokenLibraries, AreNamedWhereMedFieldsAreWritten) {
  const BrokenLibrary med(RUBATO_MED_LIBRARY);
  expect_refusal(run({"--set", "fields.formats=[med]", "--set", "fields.every=1"}),
                 "error: MED files need the library ", "install the Debian package " RUBATO_MED_PACKAGE);
}

TEST_F(BrokenLibraries, AreNamedWhereVtkHdfFieldsAreWritten) {
  const auto program = program_alone();
  const BrokenLibrary hdf5(RUBATO_HDF5_LIBRARY);
  expect_refusal(run({"--set", "fields.formats=[vtkhdf]", "--set", "fields.every=1"}, program),
                 "error: checkpoints and VTKHDF files need the library " RUBATO_HDF5_LIBRARY,
                 "install the Debian package " RUBATO_HDF5_PACKAGE);
}

TEST_F(BrokenLibraries, CostARunItsCheckpointOnly) {
  const auto program = program_alone();
  const BrokenLibrary hdf5(RUBATO_HDF5_LIBRARY);
  const auto outcome = run({}, program);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("no checkpoint was written: checkpoints and VTKHDF files need the library "),
            std::string::npos)
      << outcome.err;
  EXPECT_FALSE(has_checkpoint());
}

TEST_F(BrokenLibraries, AreReplacedByTheModuleOfHdf5) {
  if (!std::filesystem::exists(std::filesystem::path(RUBATO_PROGRAM).parent_path() /
                               "lib/rubato/rubato_hdf5.so"))
    GTEST_SKIP() << "the module is built where HDF5 has a static library";
  const BrokenLibrary hdf5(RUBATO_HDF5_LIBRARY);
  EXPECT_EQ(run().err, "");
  EXPECT_TRUE(has_checkpoint());
}

TEST_F(BrokenLibraries, AreNoneWhereTheProgramHasNoModules) {
  EXPECT_EQ(run({}, program_alone()).err, "");
  EXPECT_TRUE(has_checkpoint());
}

TEST_F(BrokenLibraries, AreNamedWherePngFilesAreDrawn) {
  ASSERT_EQ(run().exit_code, 0);
  const BrokenLibrary rsvg(RUBATO_RSVG_LIBRARY);
  expect_refusal(run_program({"plot", "out/run", "-o", "picture.png"}, folder_.path()),
                 "error: PNG files need the library " RUBATO_RSVG_LIBRARY ", which cannot be loaded (",
                 "); install the Debian package " RUBATO_RSVG_PACKAGE " or write an SVG file");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "picture.png"));
  EXPECT_EQ(run_program({"plot", "out/run", "-o", "picture.svg"}, folder_.path()).exit_code, 0);
}

} // namespace
} // namespace rubato::cli::broken_libraries_test
