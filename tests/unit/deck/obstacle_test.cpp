// SPDX-License-Identifier: LGPL-3.0-or-later
// Obstacles in a deck: what they may be, how they are echoed, and every way to get them wrong.
#include "rubato/study/echo.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "sample_deck.hpp"

namespace rubato::deck::obstacle_test {
namespace {

using test::faults_of;
using test::parse_one;
using test::replaced;
using test::Sentences;
using test::smallest_deck;

const std::string ramp = "functions: {ramp: {times: [0, 1], values: [0, 1]}}\n";

std::string deck_with(const std::string& obstacle, const std::string& physics = "solid") {
  return replaced(smallest_deck, "solid", physics) + ramp +
         "contact: {floor: {slave: S, obstacle: " + obstacle + "}}\n";
}

study::Obstacle obstacle_of(const std::string& deck) {
  return parse_one(deck).contact.at(0).obstacle.value();
}

TEST(Obstacles, StandInForAMaster) {
  const auto zone = parse_one(deck_with("{plane: {point: [1, 2, 3], normal: [0, 0, 4]}}")).contact.at(0);
  EXPECT_EQ(zone.master, "");
  EXPECT_EQ(zone.slave, "S");
  EXPECT_EQ(zone.obstacle.value(), (study::Obstacle{.point = {1, 2, 3}, .direction = {0, 0, 4}}));
}

TEST(Obstacles, AreCylindersAndSpheresTouchedFromOutsideOrInside) {
  EXPECT_EQ(
      obstacle_of(deck_with("{cylinder: {point: [1, 2, 3], axis: [1, 0, 0], radius: 2, side: inside}}")),
      (study::Obstacle{.kind = study::ObstacleKind::cylinder,
                       .point = {1, 2, 3},
                       .direction = {1, 0, 0},
                       .radius = 2,
                       .side = study::ObstacleSide::inside}));
  EXPECT_EQ(obstacle_of(deck_with("{sphere: {point: [1, 2, 3], radius: 2}}")),
            (study::Obstacle{.kind = study::ObstacleKind::sphere, .point = {1, 2, 3}, .radius = 2}));
}

TEST(Obstacles, AreFlatterWherePhysicsIs) {
  EXPECT_EQ(
      obstacle_of(deck_with("{cylinder: {point: [1, 2], radius: 2}}", "plane_stress")),
      (study::Obstacle{
          .kind = study::ObstacleKind::cylinder, .point = {1, 2, 0}, .direction = {0, 0, 1}, .radius = 2}));
  EXPECT_EQ(obstacle_of(deck_with("{cylinder: {radius: 2}}", "axisymmetric")),
            (study::Obstacle{.kind = study::ObstacleKind::cylinder, .radius = 2}));
  EXPECT_EQ(obstacle_of(deck_with("{sphere: {point: [0, 2], radius: 2}}", "axisymmetric")),
            (study::Obstacle{.kind = study::ObstacleKind::sphere, .point = {0, 2, 0}, .radius = 2}));
}

TEST(Obstacles, MoveByNumbersAndFunctions) {
  const auto moved = obstacle_of(deck_with("{plane: {point: [0, 0, 0], normal: [0, 0, 1]}, "
                                           "move: {x: 0.5, z: {value: 1e-3, function: ramp}}}"))
                         .move;
  EXPECT_EQ(moved[0], (study::Amplitude{0.5, {}}));
  EXPECT_FALSE(moved[1].has_value());
  EXPECT_EQ(moved[2], (study::Amplitude{1e-3, "ramp"}));
}

TEST(Obstacles, RotateAsSupportsDo) {
  const auto turned =
      obstacle_of(deck_with("{plane: {point: [0, 0, 0], normal: [0, 0, 1]}, rotate: {about: [1, "
                            "2, 3], axis: [0, 0, 2], angle: {velocity: 5, function: ramp}}}"))
          .rotate.value();
  study::Field angle(5, "ramp");
  angle.given = study::Given::velocity;
  EXPECT_EQ(turned, (study::Rotation{.about = {1, 2, 3}, .axis = {0, 0, 2}, .angle = angle}));
  EXPECT_EQ(
      obstacle_of(deck_with("{cylinder: {point: [1, 2], radius: 2}, rotate: {about: [1, 2], angle: 3*t}}",
                            "plane_strain"))
          .rotate.value(),
      (study::Rotation{.about = {1, 2, 0}, .axis = {0, 0, 1}, .angle = study::Formula{"3*t"}}));
}

TEST(Obstacles, ReadBackFromTheirEcho) {
  const std::pair<const char*, const char*> all[] = {
      {"solid", "{plane: {point: [1, 2, 3], normal: [0, 0, 4]}, move: {z: {value: 2, function: ramp}}}"},
      {"solid", "{cylinder: {point: [1, 2, 3], axis: [0, 1, 1], radius: 4, side: inside}, move: {y: 3}}"},
      {"solid", "{sphere: {point: [1, 2, 3], radius: 4, side: outside}}"},
      {"plane_strain", "{plane: {point: [1, 2], normal: [0, 4]}}"},
      {"plane_strain",
       "{plane: {point: [1, 2], normal: [0, 4]}, rotate: {about: [3, 4], angle: 0.1}, move: {x: 1}}"},
      {"solid",
       "{sphere: {point: [1, 2, 3], radius: 4}, rotate: {about: [1, 2, 3], axis: [1, 0, 0], angle: {value: "
       "2, function: ramp}}}"},
      {"plane_stress", "{cylinder: {point: [1, 2], radius: 4}}"},
      {"axisymmetric", "{plane: {point: [1, 2], normal: [0, -1]}, move: {y: {value: 1, function: ramp}}}"},
      {"axisymmetric", "{cylinder: {radius: 4, side: inside}}"},
      {"axisymmetric", "{sphere: {point: [0, 2], radius: 4}}"}};
  for (const auto& [physics, obstacle] : all) {
    const auto study = parse_one(deck_with(obstacle, physics));
    EXPECT_EQ(parse_deck(study::to_json(study), "echo.json").runs.at(0), study) << obstacle;
    EXPECT_FALSE(nlohmann::json::parse(study::to_json(study))["contact"]["floor"].contains("master"));
  }
}

TEST(Obstacles, MayTakeTheMastersPlaceInARun) {
  const auto deck = smallest_deck + "contact: {floor: {master: M, slave: S}}\n"
                                    "runs: {rigid: {contact: {floor: {master: ~, obstacle: {plane: "
                                    "{point: [0, 0, 0], normal: [0, 0, 1]}}}}}}\n";
  EXPECT_TRUE(parse_one(deck).contact.at(0).obstacle.has_value());
}

struct Wrong {
  std::string physics;
  std::string obstacle;
  std::string sentence;
};

void PrintTo(const Wrong& wrong, std::ostream* out) {
  *out << wrong.obstacle;
}

class WrongObstacle : public testing::TestWithParam<Wrong> {};

TEST_P(WrongObstacle, IsRefusedWithOneSentence) {
  const auto& [physics, obstacle, sentence] = GetParam();
  Sentences sentences;
  for (const auto& told : faults_of(deck_with(obstacle, physics)))
    sentences.push_back(told.substr(told.find(": ") + 2));
  EXPECT_EQ(sentences, Sentences{sentence});
}

const Wrong wrongs[] = {
    {"solid", "plane", "contact.floor.obstacle: found 'plane', expected a map"},
    {"solid", "{}", "contact.floor.obstacle: found none of plane, cylinder and sphere, expected one of them"},
    {"solid", "{move: {x: 1}}",
     "contact.floor.obstacle: found none of plane, cylinder and sphere, expected one of them"},
    {"solid", "{plne: {point: [0, 0, 0], normal: [0, 0, 1]}}",
     "unknown key 'contact.floor.obstacle.plne'; did you mean 'plane'?"},
    {"solid", "{plane: {point: [0, 0, 0], normal: [0, 0, 1]}, sphere: {point: [0, 0, 0], radius: 1}}",
     "contact.floor.obstacle: found several of plane, cylinder and sphere, expected one of them"},
    {"solid", "{plane: {point: [0, 0, 0], normal: [0, 0, 1], side: inside}}",
     "unknown key 'contact.floor.obstacle.plane.side'; expected one of point, normal"},
    {"solid", "{plane: {point: [0, 0, 0], normal: [0, 0, 0]}}",
     "contact.floor.obstacle.plane.normal: found a vector of length 0, expected one that points somewhere"},
    {"solid", "{plane: {point: [0, 0], normal: [0, 0, 1]}}",
     "contact.floor.obstacle.plane.point: found 2 coordinates, expected 3"},
    {"plane_stress", "{plane: {point: [0, 0], normal: [0, 0, 1]}}",
     "contact.floor.obstacle.plane.normal: found 3 coordinates, expected 2"},
    {"solid", "{plane: {point: [0, 0, 0]}}", "contact.floor.obstacle.plane: 'normal' is missing"},
    {"solid", "{sphere: {point: [0, 0, 0], radius: 0}}",
     "contact.floor.obstacle.sphere.radius: found '0', expected a number > 0"},
    {"solid", "{sphere: {point: [0, 0, 0], radius: 1, side: insde}}",
     "contact.floor.obstacle.sphere.side: found 'insde', expected one of outside, inside; did you mean "
     "'inside'?"},
    {"solid", "{cylinder: {point: [0, 0, 0], radius: 1}}",
     "contact.floor.obstacle.cylinder: 'axis' is missing"},
    {"plane_strain", "{cylinder: {point: [0, 0], axis: [0, 1], radius: 1}}",
     "contact.floor.obstacle.cylinder.axis: the cylinder's axis is z in plane_strain"},
    {"plane_stress", "{sphere: {point: [0, 0], radius: 1}}",
     "contact.floor.obstacle.sphere: plane_stress has no sphere, expected cylinder, which is a circle there"},
    {"axisymmetric", "{cylinder: {point: [0, 0], radius: 1}}",
     "contact.floor.obstacle.cylinder.point: the cylinder's axis is the axis of revolution in axisymmetric"},
    {"axisymmetric", "{sphere: {point: [1, 0], radius: 1}}",
     "contact.floor.obstacle.sphere.point: found a centre 1 from the axis of revolution, expected one on it: "
     "the sphere would be a ring"},
    {"axisymmetric", "{plane: {point: [0, 0], normal: [1, 1]}}",
     "contact.floor.obstacle.plane.normal: found a normal that leaves the axis of revolution, expected "
     "[0, 1] or [0, -1]: the plane would be a cone"},
    {"axisymmetric", "{plane: {point: [0, 0], normal: [0, 1]}, move: {x: 1}}",
     "contact.floor.obstacle.move: found a motion along x, expected one along y: obstacles of axisymmetric "
     "move on the axis of revolution only"},
    {"plane_strain", "{plane: {point: [0, 0], normal: [0, 1]}, move: {z: 1}}",
     "contact.floor.obstacle.move.z: plane_strain has no z, expected x or y"},
    {"solid", "{rotate: {about: [0, 0, 0], axis: [0, 0, 1], angle: 1}}",
     "contact.floor.obstacle: found none of plane, cylinder and sphere, expected one of them"},
    {"solid", "{sphere: {point: [0, 0, 0], radius: 1}, rotate: {about: [0, 0, 0], angle: 1}}",
     "contact.floor.obstacle.rotate: 'axis' is missing"},
    {"solid",
     "{sphere: {point: [0, 0, 0], radius: 1}, rotate: {about: [0, 0, 0], axis: [0, 0, 0], angle: 1}}",
     "contact.floor.obstacle.rotate.axis: found a direction without length"},
    {"plane_strain",
     "{plane: {point: [0, 0], normal: [0, 1]}, rotate: {about: [0, 0], axis: [0, 1], angle: 1}}",
     "contact.floor.obstacle.rotate.axis: plane_strain turns about z, expected 'about' and 'angle'"},
    {"plane_strain", "{plane: {point: [0, 0], normal: [0, 1]}, rotate: {about: [0, 0], angle: x}}",
     "contact.floor.obstacle.rotate.angle: found an angle that depends on the place, expected a number or an "
     "expression of t: the group turns as a whole"},
    {"axisymmetric", "{plane: {point: [0, 0], normal: [0, 1]}, rotate: {about: [0, 0], angle: 1}}",
     "contact.floor.obstacle.rotate: found a rotation in axisymmetric, whose sections cannot turn as rigid "
     "ones, "
     "expected none"},
    {"solid", "{plane: {point: [0, 0, 0], normal: [0, 0, 1]}, move: {z: {value: 1, function: rmp}}}",
     "contact.floor.obstacle.move.z.function: no function is called 'rmp'; did you mean 'ramp'?"}};

INSTANTIATE_TEST_SUITE_P(Of, WrongObstacle, testing::ValuesIn(wrongs));

TEST(Obstacles, StandOnTheirOwn) {
  const std::string plane = "obstacle: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}}";
  const auto faults = [&](const std::string& zone) {
    Sentences sentences;
    for (const auto& told : faults_of(smallest_deck + "contact: {a: {slave: S, " + zone + "}}\n"))
      sentences.push_back(told.substr(told.find(": ") + 2));
    return sentences;
  };
  EXPECT_EQ(faults(""), Sentences{"contact.a: 'master' or 'obstacle' is missing"});
  EXPECT_EQ(faults("master: M, " + plane),
            Sentences{"contact.a: found both 'master' and 'obstacle', expected one of them"});
  EXPECT_EQ(
      faults(plane + ", normal: average"),
      Sentences{"contact.a.normal: found average, an obstacle gives the normal itself, expected master"});
  EXPECT_EQ(faults(plane + ", clamped_normal: projection"),
            Sentences{"contact.a.clamped_normal: no projection on an obstacle is ever clamped"});
  EXPECT_EQ(
      faults("obstacle: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, rotate: {about: [0, 0, 0], axis: "
             "[1, 0, 0], angle: 1}}, freeze: true"),
      Sentences{
          "contact.a.obstacle.rotate: found freeze: true beside 'rotate', expected one of them: normals "
          "that are held do not turn"});
  EXPECT_EQ(faults(plane + ", normal: master, method: nodal_lagrange, friction: 0.1"), Sentences{});
}

TEST(Obstacles, OfARunToStartFromMayOnlyMoveDifferently) {
  const auto faults = [](const std::string& change) {
    return faults_of(deck_with("{plane: {point: [0, 0, 0], normal: [0, 0, 1]}}") +
                     "runs: {one: {}, two: {time: {start: {from: one}, begin: 0.012, end: 0.024}, contact: "
                     "{floor: {obstacle: " +
                     change + "}}}}\n");
  };
  EXPECT_EQ(faults("{move: {z: 1}}"), Sentences{});
  EXPECT_EQ(faults("{rotate: {about: [0, 0, 0], axis: [0, 0, 1], angle: 1}}"), Sentences{});
  EXPECT_EQ(faults("{plane: {point: [0, 0, 1]}}").size(), 1U);
}

} // namespace
} // namespace rubato::deck::obstacle_test
