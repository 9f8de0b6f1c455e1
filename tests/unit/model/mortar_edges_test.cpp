// SPDX-License-Identifier: LGPL-3.0-or-later
// Edges of surfaces in mortar contact are told before the first step.
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/two_blocks.hpp"
#include <string>
#include <vector>

namespace rubato::model {
namespace {

using test::model_of;
using test::with;

const std::vector<deck::Setting> by_mortar{{"contact.interface.integration", "mortar"}};

/// Two blocks; the right side of one of them belongs to its contact surface, too.
std::string with_a_corner(const char* surface) {
  const std::string face(surface);
  return face == "lower_face"
             ? with(test::two_blocks, "top: lower_face}", "top: lower_face, right: lower_face}")
             : with(test::two_blocks, "bottom: upper_face,", "bottom: upper_face, right: upper_face,");
}

TEST(EdgesInMortarZones, AreToldWithTheirSideAngleAndNode) {
  for (const auto* surface : {"lower_face", "upper_face"}) {
    const auto model = model_of(with_a_corner(surface), by_mortar);
    ASSERT_EQ(model.notes.size(), 1U) << surface;
    const auto& note = model.notes.front();
    const std::string side = surface == std::string("lower_face") ? "slave" : "master";
    EXPECT_NE(note.find("contact zone interface: the " + side + " '" + surface + "' has an edge of 90° at N"),
              std::string::npos)
        << note;
    EXPECT_NE(note.find("'integration: nodes'"), std::string::npos) << note;
  }
}

TEST(EdgesInMortarZones, AreFoundBetweenFacesInSpace) {
  const std::string deck = R"(
mesh:
  generate:
    - {name: low, box: {from: [0, 0, 0], to: [1, 1, 1]}, divisions: [2, 2, 2], cells: hexa20, sides: {front: ground, back: roof, right: roof}}
    - {name: high, box: {from: [0, 0, 1], to: [1, 1, 2]}, divisions: [3, 3, 2], cells: tetra10, sides: {front: under, back: top}}
physics: solid
materials: {rubber: {young: 2e6, poisson: 0, density: 1000}}
supports: [{on: ground, fix: [x, y, z]}, {on: top, fix: [x, y], z: -0.01}]
contact: {joint: {master: roof, slave: under}}
time: {scheme: static, step: 1, end: 1}
)";
  const auto model = model_of(deck);
  ASSERT_EQ(model.notes.size(), 1U);
  EXPECT_NE(model.notes.front().find("the master 'roof' has an edge of 90°"), std::string::npos)
      << model.notes.front();
  EXPECT_TRUE(model_of(with(deck, "back: roof, right: roof", "back: roof")).notes.empty());
}

TEST(EdgesInMortarZones, AreOfNoConcernOnNodesOrWithFrozenGeometry) {
  EXPECT_TRUE(model_of(with_a_corner("lower_face")).notes.empty());
  EXPECT_TRUE(model_of(test::two_blocks, by_mortar).notes.empty());
  auto frozen = by_mortar;
  frozen.emplace_back("contact.interface.freeze", "true");
  EXPECT_TRUE(model_of(with_a_corner("upper_face"), frozen).notes.empty());
}

} // namespace
} // namespace rubato::model
