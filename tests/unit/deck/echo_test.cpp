// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/study/echo.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "sample_deck.hpp"

namespace rubato::deck::echo_test {
namespace {

using test::full_deck;
using test::parse_one;
using test::replaced;
using test::smallest_deck;

study::Study read_back(const study::Study& study) {
  return parse_deck(study::to_json(study), "echo.json").runs.at(0);
}

TEST(StudyEcho, ReadsBackToTheSameStudy) {
  for (const auto& deck : {full_deck, smallest_deck, full_deck + "runs: {evol1: {}}"}) {
    const auto study = parse_one(deck);
    EXPECT_EQ(read_back(study), study);
    EXPECT_EQ(study::to_json(read_back(study)), study::to_json(study));
  }
}

TEST(StudyEcho, ReadsBackForEverySchemePhysicsAndShape) {
  const auto box = replaced(smallest_deck, "{file: beams.med}", R"({generate: [{name: b,
    box: {from: [0, 0, 0], to: [1, 2, 3]}, divisions: [4, 5, 6], cells: tetra10, edges: {right_top: C}}]})");
  std::vector<std::string> decks{box, replaced(smallest_deck, "solid", "axisymmetric"),
                                 replaced(smallest_deck, "solid", "plane_strain\nthickness: 3"),
                                 replaced(smallest_deck, "step: 1e-3, end: 0.012", "instants: [0.1, 0.3]")};
  for (const auto* scheme :
       {"newmark, beta: 0.3, gamma: 0.6", "hht, alpha: -0.1", "modified_average_acceleration, alpha: -0.1",
        "generalized_alpha", "wbz_alpha, alpha: -0.2", "static"})
    decks.push_back(replaced(smallest_deck, "newmark", scheme));
  for (const auto* scheme : {"central_difference", "central_difference, safety: 0.5, record: 1e-4",
                             "central_difference, mass_scaling: {step: 1e-6}"}) {
    decks.push_back(replaced(smallest_deck, "newmark", scheme));
    decks.push_back(replaced(decks.back(), "step: 1e-3", "step: auto"));
  }
  const auto timber = replaced(smallest_deck, "young: 200e9, poisson: 0.3",
                               "law: orthotropic, young_x: 9, young_y: 4, young_z: 1, poisson_xy: 0.3, "
                               "poisson_yz: 0.2, poisson_xz: 0.1, shear_xy: 3, shear_yz: 2, shear_xz: 1");
  decks.push_back(timber);
  decks.push_back(replaced(timber, "shear_xz: 1", "shear_xz: 1, angle_z: 10, angle_y: -20, angle_x: 30"));
  decks.push_back(replaced(
      timber, "shear_xz: 1",
      "shear_xz: 1+x, angle_x: 30*z, axes: {cylindrical: {point: [1, 2, 3], direction: [0, 1, 1]}}"));
  decks.push_back(replaced(smallest_deck, "young: 200e9, poisson: 0.3, density: 7800",
                           "young: 1+x^2, poisson: {along: y, at: [0, 1], values: [0, 0.3]}, density: 3+z"));
  decks.push_back(smallest_deck + "solver: condensed\n");
  for (const auto* zone : {"between: [M, S]", "self: skin", "self: skin, integration: nodes", "all: true"})
    decks.push_back(smallest_deck + "contact: {a: {" + zone + "}}\n");
  decks.push_back(smallest_deck +
                  "contact: {a: {master: M, slave: S, tie: true, integration: nodes}, b: {master: K, "
                  "slave: L, bilateral: true, gap: -0.1, interference: {value: 2, function: f}}, "
                  "c: {master: I, slave: J, freeze: true, interference: 0.1}, "
                  "d: {master: G, slave: H, method: nodal_lagrange, nodal_pairs: true}}\n"
                  "functions: {f: {times: [0, 1], values: [0, 1]}}\n");
  decks.push_back(replaced(smallest_deck, "solid", "plane_strain") +
                  "supports: [{on: g, rotate: {about: [1, 2], angle: 0.01*t}, x: 3}]\n");
  decks.push_back(
      replaced(smallest_deck, "density: 7800", "density: 7800, strain: green_lagrange") +
      "supports: [{on: g, rotate: {about: [1, 2, 3], axis: [0, 1, 1], angle: {acceleration: 1e-3, "
      "function: f}}}]\nloads: [{pressure: {on: h, value: 1, follower: true}}]\n"
      "functions: {f: {times: [0, 1], values: [0, 1]}}\n"
      "probes: {p: {on: g, field: reaction, about: [1, 2, 3]}}\n");
  for (const auto& deck : decks) {
    const auto study = parse_one(deck);
    EXPECT_EQ(read_back(study), study) << deck;
  }
}

TEST(StudyEcho, SaysWhetherPressuresFollow) {
  auto study = parse_one(full_deck);
  const auto follower = [&] {
    return nlohmann::json::parse(study::to_json(study))["loads"][3]["pressure"]["follower"];
  };
  EXPECT_EQ(follower(), false);
  study.loads.at(3).follower = true;
  EXPECT_EQ(follower(), true);
}

TEST(StudyEcho, SaysWhatTheDeckSaysAndWhatItLeavesOut) {
  const auto json = nlohmann::json::parse(study::to_json(parse_one(full_deck)));
  EXPECT_EQ(json["title"], "two beams");
  EXPECT_EQ(json["mesh"]["generate"][0]["cells"], "quad8");
  EXPECT_EQ(json["mesh"]["generate"][1]["cells"], "quad4");
  EXPECT_EQ(json["materials"]["steel"]["law"], "elastic");
  EXPECT_EQ(json["materials"]["steel"]["young"], 200e9);
  EXPECT_EQ(json["supports"][1]["y"]["function"], "ramp");
  EXPECT_EQ(json["loads"][0]["nodal_force"]["y"], -1e7);
  EXPECT_EQ(json["contact"]["interface"]["integration"]["gauss"], 3);
  EXPECT_EQ(json["time"]["alpha"], -0.3);
  EXPECT_EQ(json["checks"][0]["probe"], "tip.y");
  EXPECT_TRUE(json["runs"].contains("run"));
  const auto smallest = nlohmann::json::parse(study::to_json(parse_one(smallest_deck)));
  EXPECT_EQ(smallest["newton"]["max_iterations"], 40);
  EXPECT_EQ(smallest["solver"], "auto");
  EXPECT_EQ(smallest["time"]["start"], "consistent");
  EXPECT_EQ(smallest["materials"]["steel"]["cells"], "all");
}

TEST(StudyEcho, ReadsBackRelationsAndDiscreteParts) {
  for (const auto* physics : {"solid", "plane_strain"}) {
    const bool flat = std::string_view(physics) == "plane_strain";
    const auto study =
        test::parse(
            R"(mesh: {file: any.med}
materials: {steel: {young: 200e9, poisson: 0.3, density: 7800}}
time: {step: 0.001, end: 0.01}
functions: {ramp: {times: [0, 1], values: [0, 1]}}
supports: [{on: a, along: normal, value: {value: 1, function: ramp}}, {on: b, along: )" +
            std::string(flat ? "[1, 2]" : "[1, 2, 3]") +
            R"(}, {on: hub, x: 1, turn: {z: {velocity: 0.1}}}, {on: c, x: {velocity: "t^2"}, y: {acceleration: 1, function: ramp}, until: 0.005}]
base_motion: {x: {velocity: 1, function: ramp}, y: sin(t), frame: absolute}
preload: {bolt: {cut: {point: )" +
            std::string(flat ? "[1, 2], normal: [0, 1]" : "[1, 2, 3], normal: [0, 0, 1]") +
            R"(, cells: c}, force: 3, function: ramp, lock: 0.005}, nut: {cut: {point: )" +
            std::string(flat ? "[1, 2], normal: [0, 1]" : "[1, 2, 3], normal: [0, 0, 1]") +
            R"(}, displacement: 0.1}}
relations:
  lever: {equation: {terms: [{on: N1, y: 1}, {on: N2, x: -2}], value: "t^2"}}
  flat: {equal: {on: top, in: y}}
  all: {equal: {on: top}}
  period: {pairs: {on: a, with: b, in: [x], difference: {x: 0.1}}}
  hub: {rigid: {on: c}}
  mean: {distributed: {on: d, at: )" +
            std::string(flat ? "[1, 2]" : "[1, 2, 3]") + R"(}}
connectors: [{on: hub, to: N1, stiffness: 2}, {on: a, along: )" +
            std::string(flat ? "[1, 2]" : "[1, 2, 3]") + R"(, damping: 3, to: N3},
  {on: hub, to: N2, rotates: true, stiffness: 2}]
masses: [{on: N1, mass: 2}]
loads: [{moment: {on: hub, z: 3, function: ramp}}]
physics: )" +
            physics + "\n")
            .runs.at(0);
    EXPECT_EQ(study.relations.size(), 6U);
    EXPECT_EQ(parse_echo(study::to_json(study), "echo.json"), study) << physics;
  }
}

TEST(StudyEcho, ReadsBackAnchors) {
  const auto study =
      parse_one(smallest_deck + "connectors: [{on: a, rotates: true, damping: 2, anchor: [1, 2, 3]}]\n");
  ASSERT_EQ(study.connectors.size(), 1U);
  EXPECT_EQ(study.connectors[0].anchor, (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(parse_echo(study::to_json(study), "echo.json"), study);
}

TEST(StudyEcho, NamesTheRunItStartsFrom) {
  auto study = parse_one(smallest_deck);
  study.time.start = study::StartKind::from_run;
  study.time.start_run = "preload";
  EXPECT_EQ(nlohmann::json::parse(study::to_json(study))["time"]["start"]["from"], "preload");
}

TEST(StudyEcho, ReadsBackWithoutTheOtherRunsItNames) {
  const auto deck = test::parse(smallest_deck + R"(probes: {tip: {node: N1}}
fields: {formats: [med], every: 1}
runs:
  first: {}
  second:
    time: {start: {from: first}}
    checks:
      - {probe: tip.z, at: 0.001, run: first, tolerance: 0.1, kind: absolute, note: evol1 - evol2}
      - {field: stress.xy, on: N1, at: 0.002, run: first, tolerance: 0.2}
      - {field: displacement, at: 0.003, run: first, tolerance: 0.3}
)");
  const auto& study = deck.runs.at(1);
  ASSERT_EQ(study.checks.size(), 3U);
  EXPECT_EQ(parse_echo(study::to_json(study), "echo.json"), study);
  EXPECT_EQ(study.checks[0].source, study::CheckSource::other_run);
  EXPECT_EQ(study.checks[1].field, (study::CheckedField{"stress", "xy", "N1"}));
  EXPECT_EQ(study.checks[2].field, (study::CheckedField{"displacement", "", {}}));
}

TEST(Study, IsEqualWhateverPlaceItWasReadFrom) {
  EXPECT_EQ(parse_one("\n\n" + full_deck), parse_one(full_deck));
  EXPECT_NE(parse_one(replaced(full_deck, "friction: 0.2", "friction: 0.3")), parse_one(full_deck));
}

} // namespace
} // namespace rubato::deck::echo_test
