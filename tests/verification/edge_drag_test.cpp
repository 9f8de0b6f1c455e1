// SPDX-License-Identifier: LGPL-3.0-or-later
#include <gtest/gtest.h>

#include "verification/edge_drag.hpp"
#include <cmath>
#include <initializer_list>
#include <ostream>
#include <string>
#include <vector>

namespace rubato::verification {

void PrintTo(const EdgeDrag& how, std::ostream* out) {
  *out << (how.profile == Profile::tilted ? "tilted"
           : how.profile == Profile::ski  ? "ski"
                                          : "wedge")
       << " by " << how.degrees << ", " << (how.rail_is_slave ? "rail" : "block") << " as slave";
}

namespace {

/// Of cells with mid-edge nodes the rail's faces bend between the slave's points.
double largest_drag(CellType cells) {
  return cell::topology(cells).order == 2 ? 4e-3 : 1e-3;
}

class EdgeOnARail : public testing::TestWithParam<EdgeDrag> {};

/// DEFECTS of former versions: along the slave's own normal it was the sine of the tilt and more.
TEST_P(EdgeOnARail, DragsNothingWithoutFriction) {
  const auto found = drag_edge(GetParam());
  ASSERT_EQ(found.failure, "");
  EXPECT_NEAR(found.drag, 0, largest_drag(GetParam().cells));
}

TEST_P(EdgeOnARail, RubsByTheCoefficient) {
  auto how = GetParam();
  how.friction = 0.1;
  const auto found = drag_edge(how);
  ASSERT_EQ(found.failure, "");
  EXPECT_NEAR(found.drag, 0.1, largest_drag(how.cells));
}

/// Beyond, an edge bends a rail of cells with mid-edge nodes so that as the slave it drags by 6e-3.
constexpr double steepest_of_bent_rail = 10;

std::vector<EdgeDrag> drags(CellType cells, std::initializer_list<double> tilts,
                            std::initializer_list<double> flanks) {
  std::vector<EdgeDrag> all;
  for (const bool rail_is_slave : {false, true}) {
    for (const double degrees : tilts)
      if (!(rail_is_slave && cell::topology(cells).order == 2 && std::abs(degrees) > steepest_of_bent_rail))
        all.push_back({Profile::tilted, degrees, cells, rail_is_slave});
    for (const double degrees : flanks) {
      all.push_back({Profile::ski, degrees, cells, rail_is_slave});
      all.push_back({Profile::wedge, degrees, cells, rail_is_slave});
    }
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Quad4, EdgeOnARail,
                         testing::ValuesIn(drags(CellType::quad4, {0.5, -0.5, 2, 5, 10, -20, 45},
                                                 {2.9, 10, 14, 30})));
INSTANTIATE_TEST_SUITE_P(Quad8, EdgeOnARail,
                         testing::ValuesIn(drags(CellType::quad8, {0.5, 2, 20}, {10, 30})));
INSTANTIATE_TEST_SUITE_P(Tria6, EdgeOnARail,
                         testing::ValuesIn(drags(CellType::tria6, {-2, 10, 45}, {2.9, 20})));
INSTANTIATE_TEST_SUITE_P(Hexa8, EdgeOnARail, testing::ValuesIn(drags(CellType::hexa8, {2, 20}, {10, 30})));
INSTANTIATE_TEST_SUITE_P(Hexa20, EdgeOnARail, testing::ValuesIn(drags(CellType::hexa20, {5}, {14})));
INSTANTIATE_TEST_SUITE_P(Tetra10, EdgeOnARail, testing::ValuesIn(drags(CellType::tetra10, {5}, {14})));

} // namespace
} // namespace rubato::verification
