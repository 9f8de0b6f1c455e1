// SPDX-License-Identifier: LGPL-3.0-or-later
// A program beside which there is no module for iterative solvers.
#include <gtest/gtest.h>

#include "cli/program.hpp"
#include "support/two_blocks.hpp"
#include <filesystem>

namespace rubato::missing_test {
namespace {

TEST(MissingModule, IsToldToWhoAsksForIt) {
  const test::ScratchFolder folder;
  test::write_text(folder / "deck.yaml", test::two_blocks);
  std::filesystem::copy_file(RUBATO_PROGRAM, folder / "rubato");
  test::write_text(folder / "alone.sh", "./rubato run deck.yaml \"$@\" 2> said; echo $? > code\n");
  ASSERT_EQ(
      std::system(("cd " + folder.path().string() + " && sh alone.sh -o plain && grep -qx 0 code").c_str()),
      0)
      << test::text_of(folder / "said");
  ASSERT_EQ(std::system(("cd " + folder.path().string() +
                         " && sh alone.sh -o out --set solver=iterative && grep -qx 2 code")
                            .c_str()),
            0)
      << test::text_of(folder / "said");
  const auto said = test::text_of(folder / "said");
  EXPECT_NE(said.find("solver: found iterative, which needs PETSc: "), std::string::npos) << said;
  EXPECT_NE(said.find("expected auto, or a rubato that is built with it (make deps build PETSC=1)"),
            std::string::npos)
      << said;
}

} // namespace
} // namespace rubato::missing_test
