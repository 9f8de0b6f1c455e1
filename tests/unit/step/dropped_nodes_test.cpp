// SPDX-License-Identifier: LGPL-3.0-or-later
// Mortar nodes that are hardly covered: what they report.
#include "rubato/contact/dropped_nodes.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/model/model.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/walk.hpp"
#include <string>
#include <vector>

namespace rubato::step::dropped_nodes_test {
namespace {

using contact::Status;

/// A block that hangs over the edge of a plate by nearly half of its sole, pressed and pushed.
std::string plane_deck(const std::string& cells, const std::string& friction) {
  return fmt::format(R"(
mesh:
  generate:
    - {{name: block, rectangle: {{from: [0, 0], to: [1, 1]}}, divisions: [2, 2], cells: {0}, sides: {{bottom: sole, top: roof}}}}
    - {{name: plate, rectangle: {{from: [-0.5, -0.5], to: [0.505, 0]}}, divisions: [3, 1], cells: {0}, sides: {{top: ground, bottom: base}}}}
physics: plane_strain
materials: {{steel: {{young: 1000, poisson: 0.3}}}}
supports: [{{on: base, fix: [x, y]}}, {{on: roof, x: -0.003, y: -0.01}}]
contact: {{seat: {{master: ground, slave: sole{1}}}}}
time: {{scheme: static, step: 1, end: 1}}
)",
                     cells, friction);
}

std::string solid_deck(const std::string& cells, const std::string& friction) {
  return fmt::format(R"(
mesh:
  generate:
    - {{name: block, box: {{from: [0, 0, 0], to: [1, 1, 1]}}, divisions: [2, 2, 2], cells: {0}, sides: {{bottom: sole, top: roof}}}}
    - {{name: plate, box: {{from: [-0.5, -0.5, -0.1], to: [0.505, 0, 1.1]}}, divisions: [3, 1, 2], cells: {0}, sides: {{top: ground, bottom: base}}}}
physics: solid
materials: {{steel: {{young: 1000, poisson: 0.3}}}}
supports: [{{on: base, fix: [x, y, z]}}, {{on: roof, x: -0.003, y: -0.01, fix: z}}]
contact: {{seat: {{master: ground, slave: sole{1}}}}}
time: {{scheme: static, step: 1, end: 1}}
)",
                     cells, friction);
}

/// Pressure, status and traction agree with each other. Receivers alone have forces.
void expect_consistent(const std::string& deck, const std::string& what, bool rubs) {
  test::Walk walk(deck);
  ASSERT_TRUE(walk.to_end()) << what;
  const auto& zone = walk.model.zones.front();
  const auto& state = walk.state().zones.front();
  int dropped = 0;
  for (std::size_t i = 0; i < zone.points.size(); ++i) {
    const auto status = contact::reported_status(state, i);
    const auto& outcome = state.outcomes[i];
    EXPECT_EQ(status == Status::open, outcome.pressure == 0) << what << i;
    const double traction = contact::reported_traction(state, i).norm();
    if (status == Status::open)
      EXPECT_EQ(traction, 0) << what << i;
    if (rubs && status == Status::slip)
      EXPECT_NEAR(traction, 0.01 * outcome.pressure, 1e-5 * outcome.pressure)
          << what << i; // a mean of vectors
    if (state.status[i] == Status::open && outcome.pressure != 0) {
      ++dropped;
      EXPECT_TRUE(outcome.normal.isZero(0) && outcome.tangential.isZero(0)) << what << i;
      EXPECT_EQ(outcome.area, 0) << what << i;
    }
  }
  EXPECT_GT(dropped, 0) << what;
}

TEST(DroppedNodes, ReportPressureStatusAndTractionOfTheirReceivers) {
  for (const auto& [friction, rubs] : {std::pair{std::string(), false}, {", friction: 0.01", true}}) {
    for (const char* cells : {"quad4", "quad8", "tria3", "tria6"})
      expect_consistent(plane_deck(cells, friction), cells + friction, rubs);
    for (const char* cells : {"hexa8", "hexa20", "tetra4"})
      expect_consistent(solid_deck(cells, friction), cells + friction, rubs);
  }
}

} // namespace
} // namespace rubato::step::dropped_nodes_test
