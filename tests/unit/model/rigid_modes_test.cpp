// SPDX-License-Identifier: LGPL-3.0-or-later
// A static run needs every body held, by supports or by contact with what is held.
#include "rubato/model/model.hpp"

#include <gtest/gtest.h>

#include "studies.hpp"
#include "support/faults.hpp"

namespace rubato::model::rigid_modes_test {
namespace {

using test::fault_of;
using test::located_model;
using test::with;

/// The lower block is held; of the upper one the left side lies on nothing but contact.
const std::string resting =
    with(with(with(test::two_blocks, "{left: held, bottom: upper_face, top: roof}",
                   "{left: free, bottom: upper_face, top: roof}"),
              "{scheme: hht, alpha: -0.1, step: 1e-4, end: 4e-4}", "{scheme: static, step: 1, end: 1}"),
         "nodal_force: {on: tip, y: -1e7}", "pressure: {on: roof, value: 1e6}");

bool is_held(const std::string& deck) {
  const auto fault = fault_of([&] { located_model(deck); });
  EXPECT_TRUE(fault == "nothing thrown" || fault.find("is not held") != std::string::npos) << fault;
  return fault == "nothing thrown";
}

TEST(StaticBody, MayRestOnAnotherWithFriction) {
  EXPECT_TRUE(is_held(resting));
}

TEST(StaticBody, SlidesAwayWithoutFrictionUnlessHeldAlongTheSurface) {
  const auto smooth = with(resting, ", friction: 0.2", "");
  EXPECT_FALSE(is_held(smooth));
  EXPECT_TRUE(is_held(with(smooth, "fix: [x, y]}", "fix: [x, y]}\n  - {on: tip, fix: x}")));
}

TEST(StaticBody, MayHangOnSprings) {
  const auto smooth = with(resting, ", friction: 0.2", "");
  EXPECT_TRUE(is_held(with(smooth, "contact:\n", "springs: [{on: tip, x: 1}]\ncontact:\n")));
  EXPECT_FALSE(is_held(with(smooth, "contact:\n", "springs: [{on: tip, y: 1}]\ncontact:\n")));
}

TEST(StaticBody, WithoutSupportsIsNamedByANodeOfIts) {
  auto apart =
      with(resting, "rectangle: {from: [0, 0], to: [1, 0.2]}", "rectangle: {from: [0, 5], to: [1, 5.2]}");
  apart.erase(apart.find("contact:"), apart.find("time:") - apart.find("contact:"));
  const auto fault = fault_of([&] { located_model(apart); });
  EXPECT_NE(fault.find("the body 'upper' (of node N1 (0, 5)) is not held"), std::string::npos) << fault;
  EXPECT_NE(fault.find("by turning about z, along y, along x"), std::string::npos) << fault;
  EXPECT_TRUE(fault.starts_with("deck.yaml:21:")) << fault;
}

TEST(StaticBody, TurnsWhenHeldAtOnePointOnly) {
  const auto lower_only = with(resting, "on: held, fix: [x, y]", "on: N16, fix: [x, y]");
  EXPECT_FALSE(is_held(lower_only));
}

TEST(StaticBody, OfAxisymmetryIsHeldByOneNodeAlongTheAxis) {
  const std::string ring =
      "mesh: {generate: [{name: body, rectangle: {from: [1, 0], to: [3, 2]}, divisions: [2, 2]}]}\n"
      "physics: axisymmetric\n"
      "materials: {steel: {young: 1000, poisson: 0.25, cells: all}}\n"
      "supports: [{on: N1, fix: y}]\n"
      "time: {scheme: static, step: 1, end: 1}\n";
  EXPECT_TRUE(is_held(ring));
  EXPECT_FALSE(is_held(with(ring, "fix: y", "fix: x")));
}

TEST(StaticBody, InSpaceNeedsSixHolds) {
  const auto box = with(test::box_deck, "{scheme: hht, alpha: 0, step: 1e-4, end: 4e-4}",
                        "{scheme: static, step: 1, end: 1}");
  EXPECT_TRUE(is_held(box));
  EXPECT_FALSE(is_held(with(box, "fix: [x, y, z]", "fix: x")));
  EXPECT_FALSE(is_held(with(box, "on: held, fix: [x, y, z]", "on: ridge, fix: [x, y, z]")));
}

/// A plane holds across itself and, with friction, along itself; a bore holds a shaft that may still turn.
TEST(StaticBody, MayRestOnAnObstacle) {
  const auto deck = [](const std::string& obstacle, const std::string& friction) {
    return "mesh: {generate: [{name: body, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [2, 2], sides: "
           "{left: skin, right: skin, top: skin, bottom: skin}}]}\n"
           "physics: plane_strain\n"
           "materials: {steel: {young: 1000, poisson: 0.25}}\n"
           "contact: {rest: {slave: skin, integration: nodes, friction: " +
           friction + ", obstacle: " + obstacle +
           "}}\n"
           "time: {scheme: static, step: 1, end: 1}\n";
  };
  const std::string plane = "{plane: {point: [0, 0], normal: [0, 1]}}";
  const std::string bore = "{cylinder: {point: [0.5, 0.5], radius: 0.7, side: inside}}";
  EXPECT_TRUE(is_held(deck(plane, "0.1")));
  EXPECT_FALSE(is_held(deck(plane, "0")));
  EXPECT_TRUE(is_held(deck(bore, "0.1")));
  EXPECT_FALSE(is_held(deck(bore, "0")));
}

TEST(StaticBody, IsToldAlongWhatNothingHoldsIt) {
  const auto told = [](const std::string& deck) { return fault_of([&] { located_model(deck); }); };
  const auto smooth = with(resting, ", friction: 0.2", "");
  EXPECT_NE(told(smooth).find("as a rigid body along x, and"), std::string::npos) << told(smooth);
  const auto box = with(test::box_deck, "{scheme: hht, alpha: 0, step: 1e-4, end: 4e-4}",
                        "{scheme: static, step: 1, end: 1}");
  const auto turning = told(with(box, "on: held, fix: [x, y, z]", "on: ridge, fix: [x, y, z]"));
  EXPECT_NE(turning.find("as a rigid body by turning about"), std::string::npos) << turning;
}

/// Contact is not counted: in a static run these bodies get weak springs to start with.
TEST(StaticBody, IsFreeWhereOnlyContactHoldsIt) {
  const auto model = located_model(resting);
  ASSERT_FALSE(model.free_body_nodes.empty());
  for (const auto node : model.free_body_nodes)
    EXPECT_GE(model.mesh.points[static_cast<std::size_t>(node)].y(), 0) << node;
  EXPECT_TRUE(located_model(with(resting, "{scheme: static, step: 1, end: 1}",
                                 "{scheme: hht, alpha: -0.1, step: 1e-4, end: 4e-4}"))
                  .free_body_nodes.empty());
}

TEST(DynamicBody, NeedsNoHolds) {
  EXPECT_EQ(fault_of([] {
              located_model(with(test::box_deck, "supports:\n  - {on: held, fix: [x, y, z]}\n", ""));
            }),
            "nothing thrown");
}

} // namespace
} // namespace rubato::model::rigid_modes_test
