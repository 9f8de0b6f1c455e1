// SPDX-License-Identifier: LGPL-3.0-or-later
/// A block of side 1 (a disc, when axisymmetric) on rollers, pressed by 0.05 with a rigid plane: with E = 2e6
/// and ν = 0 the pressure is 1e5 everywhere, whatever the cells.
#include "rubato/contact/zone.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

namespace rubato::obstacle_patch_test {
namespace {

using test::Walk;

struct Block {
  CellType cells = CellType::quad4;
  std::string physics = "plane_strain";
  double friction = 0;
};

std::string name_of(const testing::TestParamInfo<Block>& instance) {
  const auto& block = instance.param;
  return std::string(cell::topology(block.cells).name) +
         (block.physics == "axisymmetric" ? "Axisymmetric" : "");
}

std::string deck_of(const Block& block) {
  const auto& cell = cell::topology(block.cells);
  const bool solid = cell.dimension == 3;
  std::string cells(cell.name);
  std::ranges::transform(cells, cells.begin(), [](unsigned char letter) { return std::tolower(letter); });
  const std::string third = solid ? ", 0" : "";
  // Friction holds what the sides would hold as well: one of the two.
  const bool by_friction = block.friction > 0 && block.physics != "axisymmetric";
  const std::string supports = by_friction
                                   ? fmt::format("  - {{on: ground, fix: [x, y{}]}}\n", solid ? ", z" : "")
                                   : fmt::format("  - {{on: ground, fix: y}}\n  - {{on: left, fix: x}}\n{}",
                                                 solid ? "  - {on: back, fix: z}\n" : "");
  return fmt::format(R"(mesh:
  generate:
    - {{name: block, {}: {{from: [0, 0{}], to: [1, 1{}]}}, divisions: [3, 2{}], cells: {}, sides: {{left: left, bottom: ground, top: top{}}}}}
physics: {}
materials: {{rubber: {{young: 2e6, poisson: 0}}}}
functions: {{ramp: {{times: [0, 1], values: [0, 1]}}, later: {{times: [1, 2], values: [0, 1]}}}}
supports:
{}contact:
  press:
    slave: top
    integration: nodes
    friction: {}
    obstacle:
      plane: {{point: [0, 1{}], normal: [0, -1{}]}}
      move: {{y: {{value: -0.05, function: ramp}}}}
time: {{scheme: static, step: 1, end: 1, on_failure: {{levels: 0}}}}
newton: {{residual: 1e-12}}
)",
                     solid ? "box" : "rectangle", third, solid ? ", 1" : "", solid ? ", 2" : "", cells,
                     solid ? ", back: back" : "", block.physics, supports, block.friction, third, third);
}

class BlockUnderAPlane : public testing::TestWithParam<Block> {};

TEST_P(BlockUnderAPlane, TakesAUniformPressure) {
  for (const double friction : {0.0, 0.3}) {
    auto block = GetParam();
    block.friction = friction;
    Walk walk(deck_of(block));
    ASSERT_TRUE(walk.to_end()) << step::to_string(walk.reports.back().outcome) << "\n" << deck_of(block);
    const auto& points = walk.model.zones.front().points;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (!points[i].excluded) {
        EXPECT_NEAR(walk.state().zones[0].outcomes[i].pressure, 1e5, 1e5 * 1e-10) << i;
      }
    for (const auto node : walk.model.zones.front().slave.nodes)
      EXPECT_NEAR(walk.displacement(node, 1), -0.05, 1e-11);
    const double area = block.physics == "axisymmetric" ? M_PI : 1;
    EXPECT_NEAR(walk.resultants().force[1], -1e5 * area, 1e5 * 1e-10);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, BlockUnderAPlane,
    testing::Values(Block{CellType::quad4}, Block{CellType::quad8}, Block{CellType::quad9},
                    Block{CellType::tria3}, Block{CellType::tria6}, Block{CellType::tria7},
                    Block{CellType::hexa8, "solid"}, Block{CellType::hexa20, "solid"},
                    Block{CellType::hexa27, "solid"}, Block{CellType::tetra4, "solid"},
                    Block{CellType::tetra10, "solid"}, Block{CellType::penta6, "solid"},
                    Block{CellType::penta15, "solid"}, Block{CellType::quad4, "axisymmetric"},
                    Block{CellType::quad8, "axisymmetric"}, Block{CellType::tria6, "axisymmetric"}),
    name_of);

/// Drawn aside by less than friction holds, the plane takes every slave node along; drawn far, it slides and
/// pulls with μ times what it presses with.
TEST(PlaneThatIsDrawnAside, SticksAndThenSlides) {
  const auto drawn = [](const std::string& way) {
    Walk walk(deck_of({CellType::quad4, "plane_strain", 0.3}),
              {{"time", "{end: 2}"},
               {"supports", "[{on: ground, fix: [x, y]}]"},
               {"contact.press.obstacle.move.x", "{value: " + way + ", function: later}"}});
    EXPECT_TRUE(walk.to_end());
    return walk;
  };
  const auto sticking = drawn("1e-3");
  EXPECT_EQ(sticking.resultants().sticking, 4);
  for (const auto node : sticking.model.zones.front().slave.nodes)
    EXPECT_NEAR(sticking.displacement(node, 0), 1e-3, 1e-14);
  const auto sliding = drawn("0.5");
  EXPECT_EQ(sliding.resultants().sticking, 0);
  EXPECT_NEAR(sliding.resultants().force[0], 0.3 * sliding.resultants().normal,
              1e-9 * sliding.resultants().normal);
}

} // namespace
} // namespace rubato::obstacle_patch_test
