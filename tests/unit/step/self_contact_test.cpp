// SPDX-License-Identifier: LGPL-3.0-or-later
// One body that touches itself: a ring pressed flat, a clip that closes, a hairpin folded in space.
#include "rubato/contact/zone.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/walk.hpp"
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace rubato::step::self_contact_test {
namespace {

using deck::Setting;
using Eigen::Vector3d;

/// Where the place (s, t) of the generated rectangle or (s, t, z) of the box is put.
using Shape = Vector3d (*)(const Vector3d& flat);

constexpr double pi = std::numbers::pi;

/// A whole ring of radii 0.6 and 1 around 0; s runs once round it from its right.
Vector3d ring(const Vector3d& flat) {
  const double angle = 2 * pi * flat[0], radius = 0.6 + 0.4 * flat[1];
  return {radius * std::cos(angle), -radius * std::sin(angle), 0};
}

/// A ring of radii 0.6 and 1 with a gap of 10° at its right.
Vector3d clip(const Vector3d& flat) {
  const double half_gap = pi * 5 / 180;
  const double angle = half_gap + (2 * pi - 2 * half_gap) * flat[0], radius = 0.6 + 0.4 * flat[1];
  return {radius * std::cos(angle), -radius * std::sin(angle), 0};
}

/// A hairpin: two arms of length 1 and thickness 0.1 along x, 0.1 apart, and half a ring at x < 0 that joins
/// them; t = 0 is its inside.
Vector3d hairpin(const Vector3d& flat) {
  const double radius = 0.05 + 0.1 * flat[1], arm = 1, s = 3 * flat[0];
  if (s < 1)
    return {arm * (1 - s), -radius, flat[2]};
  if (s > 2)
    return {arm * (s - 2), radius, flat[2]};
  const double angle = pi * (s - 1);
  return {-radius * std::sin(angle), -radius * std::cos(angle), flat[2]};
}

/// The nodes of a mesh at the places of others become one with them.
void join_ends(mesh::Mesh& mesh) {
  const auto flat = mesh.points;
  const auto first_of = [&](mesh::NodeIndex node) {
    const auto& place = flat[static_cast<std::size_t>(node)];
    for (std::size_t i = 0; place[0] > 1 - 1e-9 && i < flat.size(); ++i)
      if (flat[i][0] < 1e-9 && (flat[i] - place).tail<2>().norm() < 1e-9)
        return static_cast<mesh::NodeIndex>(i);
    return node;
  };
  for (auto& block : mesh.blocks)
    for (auto& node : block.nodes)
      node = first_of(node);
}

/// Groups "left", "upper" and "lower": where a body is pressed and held.
struct Marks {
  double pressed_at = 0; ///< x of the nodes of upper and lower
  double height = 1;     ///< their |y|
};

void mark(const Marks& marks, mesh::Mesh& mesh) {
  mesh::Group left{"left", {}}, upper{"upper", {}}, lower{"lower", {}};
  double least = 0;
  for (const auto& point : mesh.points)
    least = std::min(least, point.x());
  for (mesh::NodeIndex node = 0; node < mesh.node_count(); ++node) {
    const auto& point = mesh.points[static_cast<std::size_t>(node)];
    if (point.x() < least + 1e-9 && std::abs(point.y()) < 1e-9)
      left.items.push_back(node);
    if (std::abs(point.x() - marks.pressed_at) < 1e-9 && std::abs(std::abs(point.y()) - marks.height) < 1e-9)
      (point.y() > 0 ? upper : lower).items.push_back(node);
  }
  for (auto& group : {left, upper, lower})
    mesh.node_groups.push_back(group);
}

struct Bent {
  std::string deck;
  Shape shape;
  bool closed = false;
  Marks marks = {};
};

/// A body of `bent`, pressed from above and below.
test::BuiltModel pressed(const Bent& bent, const std::vector<Setting>& changes) {
  const auto study = deck::parse_deck(bent.deck, "deck.yaml", changes).runs.front();
  auto mesh = model::load_mesh(study.mesh);
  if (bent.closed)
    join_ends(mesh);
  for (auto& point : mesh.points)
    point = bent.shape(point);
  mark(bent.marks, mesh);
  return test::BuiltModel(study, std::move(mesh));
}

/// A plane body that is pressed by `each` from above and below.
std::string plane_deck(const char* sides, const char* skin, double each, const char* left) {
  return fmt::format(R"(
mesh: {{generate: [{{name: body, rectangle: {{from: [0, 0], to: [1, 1]}}, divisions: [48, 4], cells: quad4,
                    sides: {{{}}}}}]}}
physics: plane_strain
materials: {{rubber: {{young: 1, poisson: 0.3}}}}
functions: {{press: {{times: [0, 1], values: [0, 1]}}}}
supports:
  - {{on: left, fix: [{}]}}
  - {{on: upper, y: {{value: -{}, function: press}}}}
  - {{on: lower, y: {{value: {}, function: press}}}}
contact: {{own: {{self: {}}}}}
time: {{scheme: static, step: 0.05, end: 1}}
)",
                     sides, left, each, each, skin);
}

Bent pressed_ring() {
  auto deck = plane_deck("bottom: inside, top: outside", "inside", 0.75, "y");
  const std::string left = "  - {on: left, fix: [y]}\n";
  deck.erase(deck.find(left), left.size());
  for (const std::string place : {"  - {on: upper, ", "  - {on: lower, "})
    deck.replace(deck.find(place), place.size(), place + "fix: x, ");
  return {deck, ring, true};
}

Vector3d moved(const test::Walk& walk, mesh::NodeIndex node) {
  Vector3d u = Vector3d::Zero();
  for (int i = 0; i < walk.model.dofs.components; ++i)
    u[i] = walk.displacement(node, i);
  return u;
}

Vector3d place(const test::Walk& walk, mesh::NodeIndex node) {
  return walk.model.mesh.points[static_cast<std::size_t>(node)] + moved(walk, node);
}

/// The largest difference of the displacements of nodes that a mirror takes to each other.
double asymmetry(const test::Walk& walk, int axis) {
  double largest = 0;
  for (const auto node : walk.model.dofs.nodes) {
    Vector3d mirrored = walk.model.mesh.points[static_cast<std::size_t>(node)];
    mirrored[axis] *= -1;
    const auto other = walk.node_at(mirrored[0], mirrored[1], mirrored[2]);
    EXPECT_GE(other, 0);
    Vector3d expected = moved(walk, other);
    expected[axis] *= -1;
    largest = std::max(largest, (moved(walk, node) - expected).norm());
  }
  return largest;
}

/// How far nodes of the surface are beyond the plane y = 0, those from above below it and the other way
/// round.
double overlap_at_the_middle(const test::Walk& walk) {
  double deepest = 0;
  for (const auto node : walk.model.zones.front().slave.nodes) {
    const double y = walk.model.mesh.points[static_cast<std::size_t>(node)].y();
    if (std::abs(y) > 1e-9)
      deepest = std::max(deepest, -std::copysign(1.0, y) * place(walk, node).y());
  }
  return deepest;
}

std::vector<Setting> cells_of(const char* cells, int around, int through) {
  return {{"mesh.generate.0.cells", cells},
          {"mesh.generate.0.divisions", fmt::format("[{}, {}]", around, through)}};
}

TEST(ARingPressedFlat, TouchesItselfWithoutOverlapAndStaysSymmetric) {
  for (const char* cells : {"quad4", "quad8", "quad9"}) {
    const bool linear = std::string(cells) == "quad4";
    test::Walk walk(pressed(pressed_ring(), linear ? cells_of(cells, 48, 4) : cells_of(cells, 24, 2)));
    ASSERT_TRUE(walk.to_end()) << cells;
    EXPECT_GE(walk.resultants().in_contact, 3) << cells;
    EXPECT_GT(walk.resultants().normal, 0) << cells;
    EXPECT_LT(overlap_at_the_middle(walk), 1e-10) << cells;
    EXPECT_LT(asymmetry(walk, 0), 1e-10) << cells;
    EXPECT_LT(asymmetry(walk, 1), 1e-10) << cells;
  }
}

/// Whatever is made of its points.
TEST(ARingPressedFlat, TouchesItselfByNodesAsByMortar) {
  const auto force = [](const std::vector<Setting>& changes) {
    test::Walk walk(pressed(pressed_ring(), changes));
    EXPECT_TRUE(walk.to_end());
    EXPECT_LT(overlap_at_the_middle(walk), 2e-3);
    return walk.resultants().normal;
  };
  EXPECT_NEAR(force({{"contact.own.integration", "nodes"}}), force({}), 0.02 * force({}));
}

/// Its whole skin is one surface, with the corners of its ends.
Bent closing_clip() {
  return {plane_deck("left: skin, right: skin, top: skin, bottom: skin", "skin", 0.05, "x, y"), clip, false};
}

TEST(AClipOfWhichTheWholeSkinIsNamed, ClosesAtItsEndsOnlyAndStaysSymmetric) {
  auto changes = cells_of("quad4", 70, 4);
  for (const char* friction : {"0", "0.3"}) {
    changes.push_back({"contact.own.friction", friction});
    test::Walk walk(pressed(closing_clip(), changes));
    ASSERT_TRUE(walk.to_end()) << friction;
    EXPECT_GE(walk.resultants().in_contact, 1) << friction;
    for (std::size_t i = 0; i < walk.slave_count(); ++i)
      if (walk.pressure(i) != 0) {
        EXPECT_LT(std::abs(std::atan2(walk.slave_point(i).y(), walk.slave_point(i).x())), pi * 5.1 / 180);
      }
    EXPECT_LT(overlap_at_the_middle(walk), 1e-10) << friction;
    EXPECT_LT(asymmetry(walk, 1), 1e-10) << friction;
  }
}

/// The ends would overlap by half the gap at the end of one step that nothing held them in.
TEST(AClipThatClosesInLongSteps, DoesNotPassThroughItself) {
  const auto pressed_in = [](const char* step) {
    auto changes = cells_of("quad4", 70, 4);
    changes.push_back({"time.step", step});
    test::Walk walk(pressed(closing_clip(), changes));
    EXPECT_TRUE(walk.to_end());
    EXPECT_LT(overlap_at_the_middle(walk), 1e-10) << step;
    return walk.resultants().normal;
  };
  const double force = pressed_in("0.05");
  EXPECT_GT(force, 0);
  EXPECT_NEAR(pressed_in("1"), force, 1e-6 * force);
}

/// Thinner than its faces are long: the two sides of an arm, and the outsides of both, never meet.
TEST(AHairpinPressedInSpace, TouchesItselfWithoutOverlapAndStaysSymmetric) {
  const std::string deck = R"(
mesh: {generate: [{name: pin, box: {from: [0, 0, 0], to: [1, 1, 0.2]}, divisions: [24, 1, 1], cells: hexa8,
                   sides: {bottom: skin, top: skin, left: skin, right: skin, front: skin, back: skin}}]}
physics: solid
materials: {rubber: {young: 1, poisson: 0.3}}
functions: {press: {times: [0, 1], values: [0, 1]}}
supports:
  - {on: left, fix: [x, y]}
  - {on: upper, fix: z, y: {value: -0.06, function: press}}
  - {on: lower, fix: z, y: {value: 0.06, function: press}}
contact: {own: {self: skin}}
time: {scheme: static, step: 0.05, end: 1}
)";
  for (const char* friction : {"0", "0.3"}) {
    test::Walk walk(pressed({deck, hairpin, false, {7.0 / 8, 0.15}}, {{"contact.own.friction", friction}}));
    ASSERT_TRUE(walk.to_end());
    EXPECT_EQ(walk.resultants().in_contact, 6) << friction;
    EXPECT_LT(overlap_at_the_middle(walk), 1e-10) << friction;
    EXPECT_LT(asymmetry(walk, 1), 1e-10) << friction;
  }
  test::Walk walk(pressed({deck, hairpin, false, {7.0 / 8, 0.15}}, {{"contact.own.integration", "nodes"}}));
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.resultants().in_contact, 6);
  EXPECT_LT(overlap_at_the_middle(walk), 2e-3);
}

} // namespace
} // namespace rubato::step::self_contact_test
