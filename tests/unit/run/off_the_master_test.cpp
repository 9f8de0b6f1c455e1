// SPDX-License-Identifier: LGPL-3.0-or-later
// Slave nodes beyond the end of a master: which of them still face it, by nodes.
#include "rubato/core/error.hpp"
#include "rubato/run/run_study.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <string>

namespace rubato::run::off_the_master_test {
namespace {

/// A long block pressed on a short one, whose end lies the part `beyond` of an edge before the long one's
/// nodes.
std::string blocks(const std::string& cells, double beyond, const std::string& more = "") {
  return fmt::format(R"(
mesh: {{generate: [{{name: low, box: {{from: [{0:g}, 0, 0], to: [{1:g}, 1, 2]}}, divisions: [3, 1, 2], cells: {2}, sides: {{top: rail, bottom: ground}}}},
 {{name: up, box: {{from: [-3, 1, 0], to: [5, 2, 2]}}, divisions: [8, 1, 2], cells: {2}, sides: {{top: held, bottom: sole}}}}]}}
physics: solid
materials: {{m: {{young: 1000, poisson: 0}}}}
functions: {{r: {{ramp: [0, 1]}}}}
supports: [{{on: ground, fix: [x, y, z]}}, {{on: held, x: 0, z: 0, y: {{value: -0.01, function: r}}}}]
contact: {{z: {{slave: sole, master: rail, integration: nodes{3}}}}}
time: {{scheme: static, step: 0.5, end: 1}}
)",
                     beyond, 3 - beyond, cells, more);
}

/// Of the slave nodes at x = 0, which lie `beyond` an edge of 1 before the master's begin.
int pressed_beyond(const test::Walk& walk) {
  int pressed = 0;
  for (std::size_t i = 0; i < walk.slave_count(); ++i)
    if (walk.slave_point(i).x() == 0 && walk.pressure(i) > 0)
      ++pressed;
  return pressed;
}

class OffTheMaster : public testing::TestWithParam<const char*> {};

TEST_P(OffTheMaster, NodesFaceItAQuarterOfAFaceBeyondItsEnd) {
  for (const bool near : {true, false}) {
    // Faces are shorter than 1 by the part that both ends lose.
    const double beyond = near ? 0.15 : 0.25;
    test::Walk walk(blocks(GetParam(), beyond));
    ASSERT_TRUE(walk.to_end());
    EXPECT_EQ(pressed_beyond(walk), near ? 3 : 0) << beyond;
  }
}

INSTANTIATE_TEST_SUITE_P(Cells, OffTheMaster, testing::Values("hexa8", "tetra4", "penta6"));

/// Code_Aster's 0.5: half a face of triangles, which are 1 long in their reference lengths.
TEST(OffTheMasterOfTriangles, NodesFaceItAsFarAsTheZoneSays) {
  test::Walk walk(blocks("tetra4", 0.25, ", projection_tolerance: 0.5"));
  ASSERT_TRUE(walk.to_end());
  EXPECT_GT(pressed_beyond(walk), 0);
  EXPECT_THROW(test::Walk(blocks("tetra4", 0.25, ", projection_tolerance: 1.5")), InputError);
}

} // namespace
} // namespace rubato::run::off_the_master_test
