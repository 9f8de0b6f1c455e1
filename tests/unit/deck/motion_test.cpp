// SPDX-License-Identifier: LGPL-3.0-or-later
// Supports by velocity and acceleration, their end, and the motion of the base: what decks say and what they
// are refused for.
#include "rubato/core/error.hpp"
#include "rubato/deck/read.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace rubato::deck::motion_test {
namespace {

struct BadPart {
  std::string part;                                                 ///< of the deck
  std::string told;                                                 ///< part of the sentence
  std::string time = "{scheme: hht, alpha: -0.1, step: 1, end: 2}"; ///< of the deck
  std::string physics = "plane_strain";
};

std::ostream& operator<<(std::ostream& out, const BadPart& bad) {
  return out << bad.part;
}

study::Study study_of(const BadPart& deck) {
  return parse_deck("mesh: {file: any.med}\nphysics: " + deck.physics +
                        "\nmaterials: {any: {young: 1, poisson: 0, density: 1, rayleigh: {stiffness: 0.1}}}\n"
                        "functions: {f: {ramp: [0, 1]}}\ntime: " +
                        deck.time + "\n" + deck.part,
                    "deck.yaml")
      .runs.front();
}

class BadMotion : public testing::TestWithParam<BadPart> {};

TEST_P(BadMotion, IsTold) {
  std::string told = "nothing";
  try {
    study_of(GetParam());
  } catch (const InputError& error) {
    told = error.what();
  }
  EXPECT_NE(told.find(GetParam().told), std::string::npos) << told;
}

const std::string at_rest = "{scheme: static, step: 1, end: 2}";

INSTANTIATE_TEST_SUITE_P(
    Of, BadMotion,
    testing::Values(
        BadPart{"supports: [{on: g, x: {velocity: 1, value: 2}}]",
                "supports.0.x: found value and velocity together, expected one of them"},
        BadPart{"supports: [{on: g, x: {function: f}}]", "supports.0.x: 'value' is missing"},
        BadPart{"supports: [{on: g, x: {velocty: 1}}]", "did you mean 'velocity'?"},
        BadPart{"supports: [{on: g, x: {velocity: 1, function: h}}]", "no function is called 'h'"},
        BadPart{"supports: [{on: g, x: {velocity: 'x+'}}]", "supports.0.x.velocity"},
        BadPart{"supports: [{on: g, fix: x, until: soon}]", "supports.0.until"},
        BadPart{"supports: [{on: g, fix: x, until: 0}]",
                "supports.0.until: found 0, expected an instant after the begin of the run, 0"},
        BadPart{"supports: [{on: g, rotate: {angle: 0.01*t}}]", "supports.0.rotate: 'about' is missing"},
        BadPart{"supports: [{on: g, rotate: {about: [0, 0]}}]", "supports.0.rotate: 'angle' is missing"},
        BadPart{"supports: [{on: g, rotate: {about: [0, 0], axis: [0, 0, 1], angle: 0}}]",
                "supports.0.rotate.axis: plane_strain turns about z, expected 'about' and 'angle'"},
        BadPart{"supports: [{on: g, rotate: {about: [0, 0, 0], angle: 0}}]",
                "supports.0.rotate.about: found 3 coordinates, expected 2"},
        BadPart{"supports: [{on: g, rotate: {about: [0, 0, 0], angle: 0}}]",
                "supports.0.rotate: 'axis' is missing", "{scheme: hht, alpha: -0.1, step: 1, end: 2}",
                "solid"},
        BadPart{"supports: [{on: g, rotate: {about: [0, 0, 0], axis: [0, 0, 0], angle: 0}}]",
                "supports.0.rotate.axis: found a direction without length",
                "{scheme: hht, alpha: -0.1, step: 1, end: 2}", "solid"},
        BadPart{"supports: [{on: g, rotate: {about: [0, 0], angle: 0.01*x}}]",
                "supports.0.rotate.angle: found an angle that depends on the place"},
        BadPart{"supports: [{on: g, rotate: {about: [0, 0], angle: {value: 1, function: h}}}]",
                "no function is called 'h'"},
        BadPart{"supports: [{on: g, rotate: {about: [0, 0], angle: 0}}]",
                "supports.0.rotate: found a rotation in axisymmetric",
                "{scheme: hht, alpha: -0.1, step: 1, end: 2}", "axisymmetric"},
        BadPart{"supports: [{on: g, rotate: {about: [0, 0], angle: 0}, along: [1, 0]}]",
                "supports.0.along: found 'along' beside 'rotate', which holds every component"},
        BadPart{
            "relations: {hub: {rigid: {on: g}}}\nsupports: [{on: hub, rotate: {about: [0, 0], angle: 0}}]",
            "supports.0.rotate: 'hub' is a reference, which takes 'turn'; 'rotate' expects a group"},
        BadPart{"loads: [{surface_force: {on: g, x: 1, follower: true}}]",
                "unknown key 'loads.0.surface_force.follower'"},
        BadPart{"loads: [{pressure: {on: g, value: 1, follower: sometimes}}]", "loads.0.pressure.follower"},
        BadPart{
            "loads: [{pressure: {on: g, value: 1, follower: true}}]",
            "loads.0.pressure.follower: found a pressure that follows the faces of bodies of small strain"},
        BadPart{"preload: {b: {cut: {point: [0, 0], normal: [0, 1]}}}", "preload.b: 'force' is missing"},
        BadPart{"preload: {b: {cut: {point: [0, 0], normal: [0, 1]}, force: 1, displacement: 2}}",
                "preload.b: found 'force' and 'displacement', expected one of them"},
        BadPart{"preload: {b: {force: 1}}", "preload.b: 'cut' is missing"},
        BadPart{"preload: {b: {cut: {point: [0, 0], normal: [0, 0]}, force: 1}}",
                "preload.b.cut.normal: found a vector of length 0"},
        BadPart{"preload: {b: {cut: {point: [0, 0], normal: [0, 1]}, force: 1, function: h}}",
                "no function is called 'h'"},
        BadPart{"preload: {b: {cut: {point: [0, 0], normal: [0, 1]}, force: 1, lock: 0}}",
                "preload.b.lock: found 0, expected an instant after the begin of the run, 0"},
        BadPart{"preload: {b: {cut: {point: [0, 0], normal: [0, 1]}, force: 1, lock: 1}}",
                "does not lock the sides of a cut", "{scheme: central_difference, record: 1, end: 2}"},
        BadPart{"preload: {b: {cut: {point: [0, 0], normal: [1, 0]}, force: 1}}",
                "axisymmetric bolts are tightened along their axis y",
                "{scheme: hht, alpha: -0.1, step: 1, end: 2}", "axisymmetric"},
        BadPart{"base_motion: {frame: absolute}", "has no component, expected at least one of x, y, z"},
        BadPart{"base_motion: {x: {acceleration: 1}, frame: fixed}", "expected one of relative, absolute"},
        BadPart{"base_motion: {z: {acceleration: 1}}", "plane_strain has no z"},
        BadPart{"base_motion: {x: {velocity: 1}}",
                "found a velocity, but forces of inertia need the acceleration of the base, expected "
                "'acceleration', or frame: absolute"},
        BadPart{"base_motion: {x: 0.1*t}", "found a displacement, but forces of inertia need"},
        BadPart{"base_motion: {x: {acceleration: x}}", "the base moves as a whole"},
        BadPart{"base_motion: {x: {acceleration: 1}}", "expected frame: absolute", at_rest},
        BadPart{"base_motion: {x: {acceleration: 1}, frame: absolute}\nsprings: [{on: g, x: 1}]",
                "has no springs and dashpots to a ground that moves",
                "{scheme: central_difference, record: 1, end: 2}"},
        BadPart{"base_motion: {x: {acceleration: 1}, frame: absolute}\nconnectors: [{on: g, anchor: [7, 7], "
                "rotates: true, stiffness: 1}]",
                "the anchor of a connector cannot move with a base in the frame absolute"},
        BadPart{"base_motion: {x: 0.1*t, frame: absolute}\nconnectors: [{on: g, along: [1, 0], damping: 1}]",
                "need the velocity of the base, expected 'velocity' or 'acceleration'"},
        BadPart{"base_motion: {x: {acceleration: 1}}", "axisymmetric bases move along their axis y only",
                "{scheme: hht, alpha: -0.1, step: 1, end: 2}", "axisymmetric"}));

TEST(DeckMotion, IsReadAsItIsWritten) {
  const auto study =
      study_of({"supports: [{on: g, x: {velocity: 0.1, function: f}, y: {acceleration: '2*t'}, until: 1.5}, "
                "{on: h, along: [1, 0], value: {velocity: 3}}]\nbase_motion: {x: {acceleration: -1, "
                "function: f}, y: {acceleration: 't^2'}}",
                ""});
  const auto& support = study.supports.at(0);
  EXPECT_EQ(support.components[0]->given, study::Given::velocity);
  EXPECT_EQ(support.components[0]->function, "f");
  EXPECT_EQ(support.components[1]->given, study::Given::acceleration);
  EXPECT_EQ(support.until, 1.5);
  EXPECT_EQ(study.supports.at(1).along->value.given, study::Given::velocity);
  ASSERT_TRUE(study.base_motion);
  EXPECT_EQ(study.base_motion->frame, study::BaseFrame::relative);
  EXPECT_EQ(study.base_motion->components[0]->value, study::FieldValue(-1));
  EXPECT_FALSE(study.base_motion->components[2]);
}

TEST(DeckMotion, MayBeARotation) {
  const auto study = study_of(
      {"supports: [{on: g, rotate: {about: [1, 2], angle: {value: 0.05, function: f}}, y: 0.1}]", ""});
  const auto& support = study.supports.at(0);
  ASSERT_TRUE(support.rotate);
  EXPECT_EQ(support.rotate->about, (std::array<double, 3>{1, 2, 0}));
  EXPECT_EQ(support.rotate->axis, (std::array<double, 3>{0, 0, 1}));
  EXPECT_EQ(support.rotate->angle, study::Field(0.05, "f"));
  EXPECT_TRUE(support.components[1]);
}

} // namespace
} // namespace rubato::deck::motion_test
