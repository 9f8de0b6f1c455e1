// SPDX-License-Identifier: LGPL-3.0-or-later
// The rigid motions of bodies, and which of them supports and contact resist. What users are told:
// rigid_modes_test.cpp.
#include "rubato/model/model.hpp"
#include "rubato/model/rigid_motions.hpp"

#include <gtest/gtest.h>

#include "studies.hpp"
#include "support/dense.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace rubato::model::rigid_motions_test {
namespace {

using Eigen::Vector3d;
using test::located_model;

/// Two squares of side 1 with a gap between them, in a run that lets them be loose.
std::string squares(const std::string& supports, const std::string& contact = "",
                    const std::string& physics = "plane_strain") {
  return "mesh:\n"
         "  generate:\n"
         "    - {name: low, rectangle: {from: [1, 0], to: [2, 1]}, divisions: [2, 2], sides: {left: "
         "low_left, "
         "bottom: ground, top: table}, points: {left_bottom: corner}}\n"
         "    - {name: high, rectangle: {from: [1, 1.5], to: [2, 2.5]}, divisions: [2, 2], sides: {left: "
         "high_left, bottom: foot, top: roof}}\n"
         "physics: " +
         physics + "\nmaterials: {steel: {young: 1000, poisson: 0.25, density: 1}}\n" +
         (supports.empty() ? "" : "supports: [" + supports + "]\n") +
         (contact.empty() ? "" : "contact: {rest: {master: table, slave: foot" + contact + "}}\n") +
         "time: {scheme: hht, alpha: 0, step: 1, end: 1}\n";
}

const std::string low_held = "{on: ground, fix: [x, y]}";
const std::string both_held = low_held + ", {on: roof, fix: [x, y]}";

TEST(RigidMotions, OfFreeBodiesAreAllThatBodiesHave) {
  const auto model = located_model(squares(""));
  const RigidMotions motions(model);
  EXPECT_EQ(motions.bodies().count(), 2);
  EXPECT_EQ(motions.held(), (std::vector<char>{0, 0}));
  EXPECT_EQ(motions.loose_alone().size(), 6U);
  for (const int body : {0, 1})
    EXPECT_EQ(motions.all_of(body).size(), 3U);
}

TEST(RigidMotions, KeepDistances) {
  const auto model = located_model(test::box_deck);
  const RigidMotions motions(model);
  const auto all = motions.all_of(0);
  ASSERT_EQ(all.size(), 6U);
  Eigen::MatrixXd moved(9, 6);
  const std::array<Vector3d, 3> places{Vector3d(0, 0, 0), Vector3d(2, 1, 0), Vector3d(1, 0, 0.5)};
  for (std::size_t k = 0; k < all.size(); ++k)
    for (std::size_t a = 0; a < 3; ++a) {
      moved.block<3, 1>(static_cast<Eigen::Index>(3 * a), static_cast<Eigen::Index>(k)) =
          motions.at(all[k], places[a]);
      const auto b = (a + 1) % 3;
      const Vector3d apart = places[b] - places[a];
      EXPECT_NEAR(apart.dot(motions.at(all[k], places[b]) - motions.at(all[k], places[a])), 0, 1e-15) << k;
    }
  EXPECT_EQ(test::rank(moved), 6) << "each of its own kind";
}

TEST(RigidMotions, AreResistedBySupports) {
  const auto held = [](const std::string& supports) {
    const auto model = located_model(squares(supports));
    RigidMotions motions(model);
    motions.add_supports();
    return motions.held();
  };
  EXPECT_EQ(held(low_held), (std::vector<char>{1, 0}));
  EXPECT_EQ(held(both_held), (std::vector<char>{1, 1}));
  EXPECT_EQ(held("{on: corner, fix: [x, y]}"), (std::vector<char>{0, 0})) << "it may turn";
  EXPECT_EQ(held("{on: ground, fix: y}"), (std::vector<char>{0, 0})) << "it may slide";
}

/// Where the body is held does not move, wherever the model's centre is.
TEST(ALooseBody, TurnsAboutThePointThatHoldsIt) {
  const auto model = located_model(squares("{on: corner, fix: [x, y]}, {on: roof, fix: [x, y]}"));
  RigidMotions motions(model);
  motions.add_supports();
  const auto loose = motions.loose_alone();
  ASSERT_EQ(loose.size(), 1U);
  EXPECT_EQ(loose[0].body, 0);
  EXPECT_LE(motions.at(loose[0], {1, 0, 0}).norm(), 1e-12);
  const Vector3d there = motions.at(loose[0], {2, 0, 0});
  EXPECT_NEAR(there.x(), 0, 1e-12);
  EXPECT_GT(std::abs(there.y()), 0.1);
  EXPECT_EQ(direction_text(loose[0]), "by turning about z");
}

TEST(ALooseBody, SlidesAlongWhatHoldsIt) {
  const auto model = located_model(squares("{on: ground, fix: y}, {on: roof, fix: [x, y]}"));
  RigidMotions motions(model);
  motions.add_supports();
  const auto loose = motions.loose();
  ASSERT_EQ(loose.size(), 1U);
  EXPECT_EQ(loose[0].body, 0);
  EXPECT_EQ(loose[0].turn.norm(), 0);
  EXPECT_EQ(direction_text(loose[0]), "along x");
}

TEST(RigidMotions, AreResistedByContactAcrossAndWithFrictionAlong) {
  const auto loose = [](const std::string& contact) {
    const auto model = located_model(squares(low_held, contact));
    RigidMotions motions(model);
    motions.add_supports();
    motions.add_contact();
    EXPECT_EQ(motions.bodies().count(), 2);
    return motions.loose();
  };
  const auto smooth = loose(", friction: 0");
  ASSERT_EQ(smooth.size(), 1U);
  EXPECT_EQ(smooth[0].body, 1);
  EXPECT_EQ(direction_text(smooth[0]), "along x");
  EXPECT_TRUE(loose(", friction: 0.3").empty());
}

/// Contact of two bodies that nothing holds: they go together.
TEST(RigidMotions, OfBodiesTogetherAreNotResistedByTheirContact) {
  const auto model = located_model(squares("", ", friction: 0.3"));
  RigidMotions motions(model);
  motions.add_supports();
  motions.add_contact();
  EXPECT_EQ(motions.held(), (std::vector<char>{1, 1})) << "each alone";
  EXPECT_EQ(motions.loose().size(), 3U) << "both together";
}

TEST(RigidMotions, OfAxisymmetryAreOneAlongTheAxis) {
  const auto model = located_model(squares("{on: corner, fix: x}", "", "axisymmetric"));
  RigidMotions motions(model);
  motions.add_supports();
  const auto loose = motions.loose_alone();
  ASSERT_EQ(loose.size(), 2U);
  for (const auto& motion : loose) {
    EXPECT_EQ(direction_text(motion), "along y");
    EXPECT_EQ(motions.at(motion, {1.7, 0.3, 0}), motion.shift);
  }
}

TEST(MotionsToldApart, SpanTheSameEachAboutAnAxisOfItsOwn) {
  const auto model = located_model(test::box_deck);
  const RigidMotions motions(model);
  const auto all = motions.all_of(0);
  // Mixed: two turns and a shift.
  std::vector<RigidMotion> mixed(3, RigidMotion{.body = 0});
  const Eigen::Matrix3d parts{{1, 2, -1}, {0.5, -1, 3}, {2, 1, 1}};
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) {
      const auto& one = all[std::array<std::size_t, 3>{0, 4, 5}[static_cast<std::size_t>(i)]];
      mixed[static_cast<std::size_t>(k)].shift += parts(k, i) * one.shift;
      mixed[static_cast<std::size_t>(k)].turn += parts(k, i) * one.turn;
    }
  const auto apart = motions.told_apart(mixed);
  ASSERT_EQ(apart.size(), 3U);
  std::vector<std::string> texts;
  for (const auto& motion : apart)
    texts.push_back(direction_text(motion));
  EXPECT_EQ(texts, (std::vector<std::string>{"by turning about z", "by turning about y", "along x"}));
  mixed[2] = mixed[0];
  EXPECT_EQ(motions.told_apart(mixed).size(), 2U) << "two of them are one";
  EXPECT_TRUE(motions.told_apart({}).empty());
}

TEST(TheTextOfADirection, NamesAxesAndOtherDirections) {
  EXPECT_EQ(direction_text({0, {0, -2, 0}, {0, 0, 0}}), "along y") << "either way";
  EXPECT_EQ(direction_text({0, {-3, 0, -4}, {0, 0, 0}}), "along (0.6, 0, 0.8)");
  EXPECT_EQ(direction_text({0, {1, 0, 0}, {0, 0, 5}}), "by turning about z");
  EXPECT_EQ(direction_text({0, {1, 0, 0}, {0, 0, 1e-9}}), "along x") << "rounding does not turn";
}

TEST(LooseBodies, AreTheirFirstNodesWithWhatHasToHoldThem) {
  EXPECT_TRUE(loose_bodies(located_model(squares(both_held))).empty());
  const auto model = located_model(squares(low_held));
  const auto loose = loose_bodies(model);
  ASSERT_EQ(loose.size(), 1U);
  EXPECT_EQ(loose[0].node, Bodies(model.mesh, model.bulk).first_node(1));
  EXPECT_EQ(loose[0].against, "along x, along y, against turning about z");
  const auto nodes = free_body_nodes(model);
  EXPECT_EQ(nodes.size(), 9U);
  EXPECT_TRUE(std::ranges::is_sorted(nodes));
  for (const auto node : nodes)
    EXPECT_GE(model.mesh.points[static_cast<std::size_t>(node)].y(), 1.5);
}

} // namespace
} // namespace rubato::model::rigid_motions_test
