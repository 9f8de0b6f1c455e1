// SPDX-License-Identifier: LGPL-3.0-or-later
// The program where Gmsh's library is broken.
#include <gtest/gtest.h>

#include "program.hpp"
#include <optional>
#include <string_view>

namespace rubato::gmsh_library_test {
namespace {

using test::run_program;

class BrokenGmshLibrary : public testing::Test {
protected:
  BrokenGmshLibrary() {
    test::write_text(folder_ / RUBATO_GMSH_LIBRARY, "no library\n");
    test::write_text(folder_ / "square.geo", "Point(1) = {0, 0, 0};\n");
    if (const char* before = std::getenv(path_variable))
      before_ = before;
    setenv(path_variable, (folder_.path().string() + (before_ ? ":" + *before_ : "")).c_str(), 1);
  }
  ~BrokenGmshLibrary() override {
    if (before_)
      setenv(path_variable, before_->c_str(), 1);
    else
      unsetenv(path_variable);
  }

  test::ScratchFolder folder_;

private:
  static constexpr const char* path_variable = "LD_LIBRARY_PATH";
  std::optional<std::string> before_;
};

TEST_F(BrokenGmshLibrary, IsNotLoadedByThoseWhoDoNotNeedIt) {
  const auto outcome = run_program({"list"}, folder_.path());
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
}

TEST_F(BrokenGmshLibrary, IsToldToWhoGivesAGmshGeometry) {
  const auto outcome = run_program({"info", "square.geo"}, folder_.path());
  EXPECT_EQ(outcome.exit_code, 2);
  for (const std::string_view words :
       {"error: mesh file 'square.geo' cannot be read by Gmsh: its library cannot", RUBATO_GMSH_LIBRARY,
        "install it or convert the mesh to MED\n"})
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
}

} // namespace
} // namespace rubato::gmsh_library_test
