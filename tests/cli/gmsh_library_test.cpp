// SPDX-License-Identifier: LGPL-3.0-or-later
// The program where Gmsh's library is broken.
#include <gtest/gtest.h>

#include "broken_library.hpp"
#include "program.hpp"
#include <string_view>

namespace rubato::gmsh_library_test {
namespace {

using test::run_program;

class BrokenGmshLibrary : public testing::Test {
protected:
  BrokenGmshLibrary() { test::write_text(folder_ / "square.geo", "Point(1) = {0, 0, 0};\n"); }

  test::BrokenLibrary library_{RUBATO_GMSH_LIBRARY};
  test::ScratchFolder folder_;
};

TEST_F(BrokenGmshLibrary, IsNotLoadedByThoseWhoDoNotNeedIt) {
  const auto outcome = run_program({"list"}, folder_.path());
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
}

TEST_F(BrokenGmshLibrary, IsToldToWhoGivesAGmshGeometry) {
  const auto outcome = run_program({"info", "square.geo"}, folder_.path());
  EXPECT_EQ(outcome.exit_code, 2);
  for (const std::string_view words : {"error: mesh file 'square.geo' cannot be read by Gmsh: geometries "
                                       "need the library " RUBATO_GMSH_LIBRARY ", which cannot be loaded (",
                                       " or convert the mesh to MED\n"})
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
}

} // namespace
} // namespace rubato::gmsh_library_test
