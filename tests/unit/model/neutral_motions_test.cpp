// SPDX-License-Identifier: LGPL-3.0-or-later
// Static runs hold motions that only the facets of a mesh resist.
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/neutral_motions.hpp"

#include <gtest/gtest.h>

#include "studies.hpp"
#include "support/rings.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace rubato::model::neutral_motions_test {
namespace {

using Eigen::Vector3d;
using test::circle;
using test::with;

constexpr double round = 2 * std::numbers::pi;

/// A pin held at its core and something round it. Rectangles: x is the angle, y tells the radius.
std::string ring_deck(int cells, const std::string& end = "6.283185307179586") {
  return "mesh:\n"
         "  generate:\n"
         "    - {name: pin, rectangle: {from: [0, 0.3], to: [6.283185307179586, 0.9]}, divisions: [40, 2],"
         " sides: {bottom: core, top: pin_skin}}\n"
         "    - {name: ring, rectangle: {from: [0, 1], to: [" +
         end + ", 1.3]}, divisions: [" + std::to_string(cells) +
         ", 2], sides: {bottom: ring_skin}, points: {left_top: start}}\n"
         "physics: plane_strain\n"
         "materials: {steel: {young: 2e11, poisson: 0.3, density: 1}}\n"
         "supports: [{on: core, fix: [x, y]}]\n"
         "loads: [{gravity: {on: ring, y: -7.8e4}}]\n"
         "contact: {rest: {master: pin_skin, slave: ring_skin, integration: nodes, friction: 0}}\n"
         "time: {scheme: static, step: 1, end: 1}\n";
}

/// Angles between nodes from half to one and a half times their mean.
Vector3d irregular(double angle, double radius) {
  const double moved = 0.5 * round / 48 * std::sin(12 * angle + 1) + 0.05 * std::sin(angle);
  return circle(angle + moved, radius);
}

Vector3d ellipse(double angle, double radius) {
  return {1.5 * radius * std::cos(angle), -radius * std::sin(angle), 0};
}

Vector3d box(double angle, double radius) {
  const Vector3d place = circle(angle, radius);
  return place * radius / place.lpNorm<Eigen::Infinity>();
}

/// Of 16 nodes every second one is in the middle of a side.
Vector3d octagon(double angle, double radius) {
  const bool corner = std::lround(16 * angle / round) % 2 == 0;
  return circle(angle, corner ? radius : radius * std::cos(round / 16));
}

Vector3d gear(double angle, double radius) {
  return circle(angle, radius * (1 + 0.1 * std::cos(8 * angle)));
}

/// What the deck has, the ring in another shape, ends that meet joined.
Model shaped(const std::string& deck, const test::RingShape& shape, std::vector<deck::Setting> changes = {}) {
  const auto study = deck::parse_deck(deck, "deck.yaml", changes).runs.front();
  return build_model(study, test::closed_rings(load_mesh(study.mesh), shape));
}

std::size_t held(const Model& model) {
  return model.gauges.size();
}

TEST(NeutralMotion, IsTheTurnOfARing) {
  for (const int cells : {12, 47, 48, 96})
    EXPECT_EQ(held(shaped(ring_deck(cells), circle)), 1U) << cells;
  EXPECT_EQ(held(shaped(ring_deck(48), irregular)), 1U);
  for (const auto* cells : {"quad8", "quad9", "tria3", "tria6"}) {
    const std::vector<deck::Setting> changes{{"mesh.generate.1.cells", cells}};
    EXPECT_EQ(held(shaped(ring_deck(48), circle, changes)), 1U) << cells;
    EXPECT_EQ(held(shaped(ring_deck(48), irregular, changes)), 1U) << cells;
  }
}

TEST(NeutralMotion, IsFoundOnMastersToo) {
  const std::vector<deck::Setting> turned{{"contact.rest.master", "ring_skin"},
                                          {"contact.rest.slave", "pin_skin"}};
  EXPECT_EQ(held(shaped(ring_deck(48), circle, turned)), 1U);
  EXPECT_EQ(held(shaped(ring_deck(48), ellipse, turned)), 0U);
}

TEST(NeutralMotion, IsNoneOfWhatHasCorners) {
  EXPECT_EQ(held(shaped(ring_deck(48), ellipse)), 0U);
  EXPECT_EQ(held(shaped(ring_deck(12), ellipse)), 0U);
  for (const int cells : {8, 16, 48})
    EXPECT_EQ(held(shaped(ring_deck(cells), box)), 0U) << cells;
  EXPECT_EQ(held(shaped(ring_deck(16), octagon)), 0U);
  EXPECT_EQ(held(shaped(ring_deck(48), gear)), 0U);
}

TEST(NeutralMotion, IsResistedByFrictionAndSupports) {
  EXPECT_EQ(held(shaped(ring_deck(48), circle, {{"contact.rest.friction", "0.1"}})), 0U);
  // The start is at (1.3, 0): a turn takes it along y.
  EXPECT_EQ(
      held(shaped(ring_deck(48), circle, {{"supports", "[{on: core, fix: [x, y]}, {on: start, fix: x}]"}})),
      1U);
  EXPECT_EQ(
      held(shaped(ring_deck(48), circle, {{"supports", "[{on: core, fix: [x, y]}, {on: start, fix: y}]"}})),
      0U);
}

TEST(NeutralMotion, IsLeftToTimeInDynamics) {
  EXPECT_EQ(held(shaped(ring_deck(48), circle, {{"time", "{scheme: newmark, step: 1, end: 1}"}})), 0U);
}

/// A half ring turns about the middle of its arc, unless its weight turns it; so does a ring that is wound.
TEST(NeutralMotion, IsNoneThatALoadWorksOn) {
  const auto half = ring_deck(24, "3.141592653589793");
  EXPECT_EQ(held(shaped(half, circle)), 1U);
  EXPECT_EQ(held(shaped(half, circle, {{"loads.0.gravity.x", "7.8e3"}})), 0U);
  EXPECT_EQ(held(shaped(ring_deck(48), circle,
                        {{"loads", "[{gravity: {on: ring, y: -7.8e4}}, {nodal_force: {on: start, y: 1}}]"}})),
            0U);
}

TEST(NeutralMotion, IsHeldAloneAndTold) {
  const auto model = shaped(ring_deck(48), circle);
  RigidMotions rigid(model);
  rigid.add_supports();
  std::vector<std::string> left;
  for (const auto& motion : rigid.loose_alone())
    left.push_back(direction_text(motion));
  EXPECT_EQ(left, (std::vector<std::string>{"along y", "along x"}));
  EXPECT_EQ(std::ranges::count_if(model.notes,
                                  [](const std::string& note) {
                                    return note.find(
                                               "the body 'ring' (of node N124 (1, -0)) can move by turning "
                                               "about z and nothing resists") != std::string::npos;
                                  }),
            1);
  // Shifts of the ring, and what the pin does, are not touched.
  const auto& gauge = model.gauges.front();
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < gauge.nodes.size(); ++i) {
    sum.head<2>() += gauge.values.segment<2>(2 * static_cast<Eigen::Index>(i));
    EXPECT_GT(model.mesh.points[static_cast<std::size_t>(gauge.nodes[i])].norm(), 0.95);
  }
  EXPECT_LE(sum.norm(), 1e-12 * gauge.values.norm());
  // Whole rings that turn are resisted, whole models that shift are not.
  Eigen::VectorXd shift = Eigen::VectorXd::Ones(model.dofs.dof_count);
  EXPECT_LE((model.domain.initial_tangent() * shift).lpNorm<Eigen::Infinity>(),
            1e-12 * model.domain.initial_tangent().diagonal().lpNorm<Eigen::Infinity>());
}

/// A ball in a bowl that is held: boxes over [−1, 1]³, and over angles and radius.
const std::string ball_deck = R"(mesh:
  generate:
    - {name: ball, box: {from: [-1, -1, -1], to: [1, 1, 1]}, divisions: [6, 6, 6],
       sides: {left: skin, right: skin, top: skin, bottom: skin, front: skin, back: skin}}
    - {name: bowl, box: {from: [-1, 1.5, -1], to: [1, 1.7, 1]}, divisions: [8, 1, 8],
       sides: {bottom: inside, top: outside}}
physics: solid
materials: {steel: {young: 2e11, poisson: 0.3, density: 1}}
supports: [{on: outside, fix: [x, y, z]}]
loads: [{gravity: {on: ball, y: -7.8e4}}]
contact: {rest: {master: inside, slave: skin, integration: nodes, friction: 0}}
time: {scheme: static, step: 1, end: 1}
)";

Vector3d ball(const Vector3d& place) {
  const double size = place.lpNorm<Eigen::Infinity>();
  return size == 0 ? place : Vector3d((0.3 * (1 - size) + size * size / place.norm()) * place);
}

Vector3d bowl(const Vector3d& place) {
  const Vector3d direction(std::tan(0.6 * place.x()), -1, -std::tan(0.6 * place.z()));
  return place.y() * direction.normalized();
}

std::vector<std::string> held_in_bowl(const std::function<Vector3d(const Vector3d&)>& shape,
                                      const std::vector<deck::Setting>& changes = {}) {
  const auto study = deck::parse_deck(ball_deck, "deck.yaml", changes).runs.front();
  auto mesh = load_mesh(study.mesh);
  for (auto& point : mesh.points)
    point = point.y() < 1.2 ? shape(point) : bowl(point);
  auto model = build_model(study, std::move(mesh));
  model.gauges.clear();
  RigidMotions rigid(model);
  rigid.add_supports();
  std::vector<std::string> directions;
  for (const auto& motion : neutral_motions(model, rigid))
    directions.push_back(direction_text(motion));
  return directions;
}

using Directions = std::vector<std::string>;
const Directions all_turns{"by turning about z", "by turning about y", "by turning about x"};

TEST(NeutralMotion, IsEveryTurnOfABall) {
  EXPECT_EQ(held_in_bowl(ball), all_turns);
  const auto uneven = [](const Vector3d& place) {
    return ball(place +
                0.15 * Vector3d(std::sin(3.14159265358979 * place.x()), 0,
                                std::sin(3.14159265358979 * (place.z() + place.z() * place.z() - 1))));
  };
  EXPECT_EQ(held_in_bowl(uneven), all_turns);
  for (const auto* cells : {"tetra4", "penta6", "hexa20", "hexa27"})
    EXPECT_EQ(held_in_bowl(ball, {{"mesh.generate.0.cells", cells}}), all_turns) << cells;
  EXPECT_EQ(held_in_bowl(ball, {{"contact.rest.master", "skin"}, {"contact.rest.slave", "inside"}}),
            all_turns);
}

TEST(NeutralMotion, IsTheOneTurnOfASpheroid) {
  const auto spheroid = [](const Vector3d& place) {
    return Vector3d(ball(place).cwiseProduct(Vector3d(1, 0.7, 1)));
  };
  EXPECT_EQ(held_in_bowl(spheroid), Directions{"by turning about y"});
}

TEST(NeutralMotion, IsNoneOfACube) {
  EXPECT_EQ(held_in_bowl([](const Vector3d& place) { return Vector3d(0.5 * place); }), Directions{});
}

} // namespace
} // namespace rubato::model::neutral_motions_test
