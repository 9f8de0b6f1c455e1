// SPDX-License-Identifier: LGPL-3.0-or-later
// Contact zones whose sides the model chooses: between two surfaces, of all bodies, a surface with itself.
#include "rubato/contact/zone.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "unit/model/studies.hpp"
#include <string>
#include <vector>

namespace rubato::model::chosen_sides_test {
namespace {

struct Blocks {
  std::string contact;
  std::string upper = "[4, 2]", lower = "[2, 2]";
  double upper_young = 1, lower_young = 1;
  std::string lower_support = "ground, fix: [x, y]";
};

/// Two blocks, one on the other.
std::string deck_of(const Blocks& blocks) {
  return fmt::format(R"(mesh:
  generate:
    - {{name: lower, rectangle: {{from: [-1, 0], to: [2, 1]}}, divisions: {}, sides: {{bottom: ground, top: table}}}}
    - {{name: upper, rectangle: {{from: [0, 1], to: [1, 2]}}, divisions: {}, sides: {{bottom: foot, top: roof}}}}
physics: plane_strain
materials:
  a: {{young: {}, poisson: 0.3, cells: upper}}
  b: {{young: {}, poisson: 0.3, cells: lower}}
supports: [{{on: {}}}, {{on: roof, fix: [x, y]}}]
contact: {{touch: {{{}}}}}
time: {{scheme: static, step: 1, end: 1}}
)",
                     blocks.lower, blocks.upper, blocks.upper_young, blocks.lower_young, blocks.lower_support,
                     blocks.contact);
}

const contact::Zone& only_zone(const Model& model) {
  EXPECT_EQ(model.zones.size(), 1U);
  return model.zones.front();
}

std::string fault_of(const std::string& deck) {
  try {
    test::located_model(deck);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(ZonesBetweenTwoSurfaces, HaveTheFinerOneAsSlave) {
  const auto model = test::located_model(deck_of({"between: [foot, table]"}));
  EXPECT_EQ(only_zone(model).settings.slave, "foot");
  EXPECT_EQ(only_zone(model).settings.master, "table");
  EXPECT_EQ(
      chosen_sides(model.zones),
      std::vector<std::string>{"contact zone touch: 'foot' (4 faces) is the slave of 'table' (2 faces), "
                               "because its faces are finer (0.25 against 1.5)"});
  const auto other = test::located_model(deck_of({"between: [foot, table]", "[1, 2]", "[6, 2]"}));
  EXPECT_EQ(only_zone(other).settings.slave, "table");
}

TEST(ZonesBetweenTwoSurfaces, HaveTheSofterOneAsSlaveWhereBothAreAsFine) {
  const auto slave = [](double upper, double lower) {
    return only_zone(
               test::located_model(deck_of({"between: [foot, table]", "[2, 2]", "[6, 2]", upper, lower})))
        .settings.slave;
  };
  EXPECT_EQ(slave(1, 2), "foot");
  EXPECT_EQ(slave(2, 1), "table");
  EXPECT_EQ(slave(1, 1), "foot") << "the first";
}

TEST(ZonesBetweenTwoSurfaces, HaveNoSlaveThatSupportsHoldWhole) {
  const auto model = test::located_model(
      deck_of({"between: [foot, table]", "[1, 1]", "[6, 2]", 1, 1, "lower, fix: [x, y]"}));
  EXPECT_EQ(only_zone(model).settings.slave, "foot");
}

TEST(ZonesBetweenTwoSurfaces, TellEachFaultOnceAtItsName) {
  EXPECT_EQ(fault_of(deck_of({"between: [foot, tabel]"})),
            "deck.yaml:10:35: found 'tabel', expected a group of cells of the mesh; "
            "did you mean 'table'?");
}

TEST(ZonesOfAllBodies, AreThoseOfPartsThatFaceEachOther) {
  const auto model = test::located_model(deck_of({"all: true"}));
  const auto& zone = only_zone(model);
  EXPECT_EQ(zone.settings.name, "touch_upper_lower");
  EXPECT_EQ(zone.settings.slave, "upper");
  EXPECT_EQ(zone.settings.master, "lower");
  EXPECT_EQ(zone.slave.faces.size(), 4U) << "its foot, not its sides";
  EXPECT_EQ(zone.master.faces.size(), 2U) << "the table";
}

/// The sides of the upper block see those of the walls; the lower block is between all of them.
TEST(ZonesOfAllBodies, HaveASlaveOnceWhateverItTouches) {
  const auto model = test::located_model(R"(mesh:
  generate:
    - {name: floor, rectangle: {from: [0, 0], to: [3, 1]}, divisions: [3, 1], sides: {bottom: ground}}
    - {name: wall, rectangle: {from: [2.5, 1], to: [3, 2]}, divisions: [1, 2], sides: {right: back}}
    - {name: block, rectangle: {from: [0.5, 1], to: [1.5, 2]}, divisions: [8, 8]}
physics: plane_strain
materials: {steel: {young: 1, poisson: 0.3, density: 1}}
supports: [{on: ground, fix: [x, y]}, {on: back, fix: [x, y]}]
contact: {any: {all: true, friction: 0.2}}
time: {scheme: newmark, step: 1, end: 1}
)");
  std::vector<std::string> names;
  for (const auto& zone : model.zones)
    names.push_back(zone.settings.name);
  EXPECT_EQ(names, (std::vector<std::string>{"any_wall_floor", "any_block_floor", "any_block_wall"}));
  for (const auto& zone : model.zones)
    EXPECT_EQ(zone.settings.friction, 0.2);
}

TEST(ZonesOfAllBodies, NeedTwoBodies) {
  const auto fault =
      fault_of(R"(mesh: {generate: [{name: a, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [1, 1]}]}
physics: plane_strain
materials: {steel: {young: 1, poisson: 0.3, density: 1}}
contact: {any: {all: true}}
time: {scheme: newmark, step: 1, end: 1}
)");
  EXPECT_EQ(fault, "deck.yaml:4:22: no two bodies of the mesh have surfaces that face each "
                   "other, expected two bodies at least; 'self' is for one that touches itself");
}

TEST(AZoneOfASurfaceWithItself, IsRefusedWhereNothingCanMeet) {
  EXPECT_EQ(fault_of(deck_of({"self: foot"})),
            "deck.yaml:10:25: found 'foot', no two faces of which can come to face each "
            "other, expected a surface that can touch itself");
}

} // namespace
} // namespace rubato::model::chosen_sides_test
