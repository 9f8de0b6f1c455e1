// SPDX-License-Identifier: LGPL-3.0-or-later
/// A block pressed on a larger or a curved one, by a load: contact carries the load, whatever the cells,
/// where the surfaces touch, and nothing elsewhere.
#include "rubato/contact/nodal_pressure.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

namespace rubato::pressed_surfaces_test {
namespace {

using test::Walk;

constexpr double pressure = 2e4; ///< on the roof of the upper block, whose side is 1

std::string name_of(const testing::TestParamInfo<CellType>& instance) {
  return std::string(cell::topology(instance.param).name);
}

bool is_solid(CellType type) {
  return cell::topology(type).dimension == 3;
}

/// The lower block is 2 wide and 1 high, the upper one stands on its middle. Halves by symmetry: x = 0 (and
/// z = 0) is held along its normal, so that nothing but contact carries the load down.
std::string deck_of(CellType type, const std::string& zone) {
  const bool solid = is_solid(type);
  std::string cells(cell::topology(type).name);
  std::ranges::transform(cells, cells.begin(), [](unsigned char letter) { return std::tolower(letter); });
  const auto body = [&](const char* name, double width, int from, int n, const char* sides) {
    const auto z = [&](const std::string& text) { return solid ? ", " + text : std::string(); };
    return fmt::format(
        "    - {{name: {}, {}: {{from: [0, {}{}], to: [{}, {}{}]}}, divisions: [{}, 2{}], cells: {}, "
        "sides: {{left: middle, {}{}}}}}\n",
        name, solid ? "box" : "rectangle", from, z("0"), width, from + 1, z(fmt::format("{}", width)), n,
        z(std::to_string(n)), cells, solid ? "back: front_middle, " : "", sides);
  };
  return fmt::format(R"(mesh:
  generate:
{}{}physics: {}
materials: {{rubber: {{young: 2e6, poisson: 0.3}}}}
supports:
  - {{on: ground, fix: y}}
  - {{on: middle, fix: x}}
{}loads: [{{pressure: {{on: roof, value: {}}}}}]
contact: {{rest: {{{}}}}}
time: {{scheme: static, step: 1, end: 1}}
)",
                     body("lower", 2, 0, 5, "bottom: ground, top: below"),
                     body("upper", 1, 1, 3, "bottom: above, top: roof"), solid ? "solid" : "plane_strain",
                     solid ? "  - {on: front_middle, fix: z}\n" : "", pressure, zone);
}

/// The lower block's surface curves down from the middle, y = 1 − x²/(2R), its inside with it.
constexpr double curve_radius = 20;

mesh::Mesh curved(mesh::Mesh mesh, bool ball) {
  for (const auto node : mesh::nodes_named(mesh, "lower")) {
    auto& point = mesh.points[static_cast<std::size_t>(node)];
    const double along = point.x() * point.x() + (ball ? point.z() * point.z() : 0.0);
    point.y() -= point.y() * along / (2 * curve_radius);
  }
  return mesh;
}

struct Pressed {
  double carried = 0;    ///< by the contact forces on the slave, of the load
  double reaction = 0;   ///< of the ground, of the load
  double tension = 0;    ///< largest at a node, of the load's pressure
  double pulled = 0;     ///< likewise at a point
  double overlap = 0;    ///< largest |gap| of points in contact, of an edge
  double open_force = 0; ///< largest on points that are open
  double deepest = 0;    ///< gap of points that are open, of an edge
  double sunk = 0;       ///< mean of the roof [length]
  int touching = 0;
  int apart = 0;
};

/// `up`: the sign of the force on the slave.
Pressed measure(const Walk& walk, double up) {
  Pressed result;
  const auto& zone = walk.model.zones.front();
  const auto& state = walk.state().zones.front();
  result.carried = up * walk.resultants().force[1] / pressure;
  for (const auto node : mesh::nodes_named(walk.model.mesh, "ground"))
    result.reaction += walk.state().reaction[walk.model.dofs.dof(node, 1)] / pressure;
  for (const double p : contact::nodal_pressure(zone, state))
    result.tension = std::max(result.tension, -p / pressure);
  for (std::size_t i = 0; i < state.status.size(); ++i) {
    const auto& outcome = state.outcomes[i];
    result.pulled = std::max(result.pulled, -outcome.pressure / pressure);
    if (state.status[i] == contact::Status::open) {
      ++result.apart;
      result.open_force = std::max(result.open_force, outcome.normal.norm());
      result.deepest = std::max(result.deepest, -outcome.gap / zone.edge());
    } else {
      ++result.touching;
      result.overlap = std::max(result.overlap, std::abs(outcome.gap) / zone.edge());
    }
  }
  const auto roof = mesh::nodes_named(walk.model.mesh, "roof");
  for (const auto node : roof)
    result.sunk -= walk.displacement(node, 1) / static_cast<double>(roof.size());
  return result;
}

class PressedBlocks : public testing::TestWithParam<CellType> {
protected:
  /// Gaps of points with a multiplier each close; where points share them, on average only: single points
  /// overlap, and nodes beside the border of contact may have a tension that their points do not have.
  /// `sunk` is what quadratic cells agree on; linear ones are as far from it as so few of them are.
  static Pressed expect_contact(const Walk& walk, double up, double sunk) {
    const auto found = measure(walk, up);
    EXPECT_NEAR(found.carried, 1, 1e-9);
    EXPECT_NEAR(found.reaction, 1, 1e-9);
    EXPECT_EQ(found.open_force, 0);
    EXPECT_GT(found.touching, 0);
    const bool own = walk.model.zones.front().points_own_multipliers;
    EXPECT_LE(found.tension, own ? 0 : 0.5);
    EXPECT_LE(found.overlap, own ? 1e-9 : 0.01);
    EXPECT_LE(found.deepest, own ? 1e-9 : 0.01);
    EXPECT_EQ(found.pulled, 0);
    const auto& cell = cell::topology(GetParam());
    EXPECT_NEAR(found.sunk, sunk, (cell.node_count == cell.corner_count ? 0.1 : 0.015) * sunk);
    return found;
  }
};

TEST_P(PressedBlocks, StandOnALargerMaster) {
  Walk walk(deck_of(GetParam(), "master: below, slave: above, integration: nodes"));
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(expect_contact(walk, 1, 0.0171).apart, 0);
}

TEST_P(PressedBlocks, StandOnALargerSlave) {
  Walk walk(deck_of(GetParam(), "master: above, slave: below, integration: nodes"));
  ASSERT_TRUE(walk.to_end());
  EXPECT_GT(expect_contact(walk, -1, 0.0172).apart, 0) << "the slave's ends face nothing";
}

TEST_P(PressedBlocks, StandOnACurvedMaster) {
  const auto study =
      deck::parse_deck(deck_of(GetParam(), "master: below, slave: above, integration: nodes"), "deck.yaml")
          .runs.front();
  for (const bool ball : {false, true}) {
    Walk walk(study, curved(model::load_mesh(study.mesh), ball));
    ASSERT_TRUE(walk.to_end());
    const double sunk = ball && is_solid(GetParam()) ? 0.0347 : 0.0261;
    EXPECT_GT(expect_contact(walk, 1, sunk).apart, 0) << "the master curves away";
  }
}

INSTANTIATE_TEST_SUITE_P(Plane, PressedBlocks,
                         testing::Values(CellType::quad4, CellType::quad8, CellType::quad9, CellType::tria3,
                                         CellType::tria6),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Solid, PressedBlocks,
                         testing::Values(CellType::hexa8, CellType::hexa20, CellType::hexa27,
                                         CellType::tetra4, CellType::tetra10, CellType::penta6,
                                         CellType::penta15),
                         name_of);

} // namespace
} // namespace rubato::pressed_surfaces_test
