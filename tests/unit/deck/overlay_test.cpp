// SPDX-License-Identifier: LGPL-3.0-or-later
// Runs and command-line settings laid over a deck.
#include <gtest/gtest.h>

#include "sample_deck.hpp"

namespace rubato::deck::overlay_test {
namespace {

using test::faults_of;
using test::full_deck;
using test::parse;
using test::parse_one;
using test::place_of;
using test::replaced;
using test::Sentences;
using test::smallest_deck;

TEST(DeckRuns, KeepTheirOrderAndNames) {
  const auto runs = parse(full_deck + "runs: {second: {}, first: , third: {}}").runs;
  ASSERT_EQ(runs.size(), 3U);
  EXPECT_EQ(runs[0].name, "second");
  EXPECT_EQ(runs[1].name, "first");
  auto third = runs[2];
  third.name = "run";
  EXPECT_EQ(third, parse_one(full_deck));
}

TEST(DeckRuns, MergeMapsKeyByKeyAndReplaceTheRest) {
  const auto runs = parse(full_deck + R"(runs:
  plain: {}
  changed:
    title: other
    contact: {interface: {friction: 0.5, coefficients: {normal: 2e9}, exclude_nodes: [N1]}}
    supports: [{on: Clamped, fix: x}]
    materials: {steel: {rayleigh: {mass: 0}}}
    time: {step: 5e-4}
)")
                        .runs;
  auto expected = runs.at(0);
  expected.name = "changed";
  expected.title = "other";
  expected.contact[0].friction = 0.5;
  expected.contact[0].normal_coefficient = 2e9;
  expected.contact[0].exclude_nodes = {"N1"};
  expected.supports.resize(1);
  expected.supports[0].components[1].reset();
  expected.materials[0].rayleigh_mass = 0;
  expected.time.step = 5e-4;
  EXPECT_EQ(runs.at(1), expected);
}

TEST(DeckRuns, NothingRemovesAKey) {
  const auto runs = parse(full_deck + R"(runs:
  newmark: {time: {scheme: newmark, alpha: ~, start: null}, contact: ~, fields:, checks: ~, newton: ~}
  one_probe: {probes: {middle: ~}}
)")
                        .runs;
  EXPECT_EQ(runs.at(0).time.scheme, study::SchemeKind::newmark);
  EXPECT_EQ(runs.at(0).time.start, study::StartKind::consistent);
  EXPECT_TRUE(runs.at(0).contact.empty());
  EXPECT_FALSE(runs.at(0).fields.vtu);
  EXPECT_EQ(runs.at(0).newton, study::NewtonSettings{});
  EXPECT_EQ(runs.at(1).probes.size(), 1U);
}

TEST(DeckRuns, CannotRemoveWhatHasNoMeaning) {
  const auto deck = smallest_deck + "runs: {a: {tmie: ~, contact: ~}}";
  EXPECT_EQ(faults_of(deck),
            Sentences{place_of(deck, "tmie") + ": unknown key 'tmie'; did you mean 'time'?"});
}

TEST(DeckRuns, TheMeshGivenLastStands) {
  const auto runs = parse(full_deck + R"(runs:
  from_file: {mesh: {file: other.med, convert: none}}
  generated: {mesh: {generate: [{name: b, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [1, 1]}]}}
)")
                        .runs;
  EXPECT_TRUE(runs.at(0).mesh.bodies.empty());
  EXPECT_EQ(runs.at(0).mesh.file, "other.med");
  EXPECT_EQ(runs.at(0).mesh.refine, 2);
  EXPECT_EQ(runs.at(1).mesh.bodies.size(), 1U);
  const auto generated =
      parse_one(replaced(smallest_deck, "beams.med", "beams.med, name: m") +
                "runs: {a: {mesh: {generate: [{name: b, box: {from: [0, 0, 0], to: [1, 1, 1]}, "
                "divisions: [1, 1, 1]}]}}}");
  EXPECT_EQ(generated.mesh.file, "");
  EXPECT_EQ(generated.mesh.bodies.size(), 1U);
}

TEST(DeckRuns, FaultsStandWhereTheRunSaysIt) {
  const auto deck = smallest_deck + "runs: {a: {}, b: {time: {stp: 1}}, c: {time: {step: 0}}}";
  EXPECT_EQ(faults_of(deck),
            (Sentences{place_of(deck, "stp") + ": unknown key 'time.stp'; did you mean 'step'? (run b)",
                       place_of(deck, "0}}}") + ": time.step: found '0', expected a number > 0 (run c)"}));
}

TEST(DeckRuns, AreAMapOfMapsWithSafeNames) {
  EXPECT_EQ(faults_of(smallest_deck + "runs: {}"),
            Sentences{"study.yaml:5:7: runs: found no run, expected at least "
                      "one"});
  EXPECT_EQ(faults_of(smallest_deck + "runs: [a]"),
            Sentences{"study.yaml:5:7: runs: found a list, expected a map from names to entries"});
  EXPECT_EQ(faults_of(smallest_deck + "runs: {a: 1}"),
            Sentences{"study.yaml:5:11: runs.a: found '1', expected a map of changes"});
  EXPECT_EQ(
      faults_of(smallest_deck + "runs: {../a: {}}"),
      Sentences{
          "study.yaml:5:8: runs: found the name '../a', expected up to 100 letters, digits, '_' or '-'"});
  EXPECT_EQ(faults_of(smallest_deck + "runs: {a: {runs: {}}}").size(), 1U);
}

TEST(DeckStart, FromAnEarlierRun) {
  const auto runs = parse(smallest_deck + R"(runs:
  preload: {time: {scheme: static}}
  motion: {time: {begin: 1, end: 2, start: {from: preload}}}
)")
                        .runs;
  EXPECT_EQ(runs.at(1).time.start, study::StartKind::from_run);
  EXPECT_EQ(runs.at(1).time.start_run, "preload");
}

TEST(DeckStart, RefusesRunsThatCannotBeStartedFrom) {
  const auto sentence = [](const std::string& runs) {
    const auto deck = smallest_deck + "runs: " + runs;
    const auto faults = faults_of(deck);
    return faults.size() == 1 ? faults[0] : "not one fault";
  };
  EXPECT_EQ(sentence("{a: {time: {start: {from: a}}}}"),
            "study.yaml:5:33: time.start.from: run a cannot start from itself");
  EXPECT_EQ(
      sentence("{a: {time: {start: {from: b}}}, b: {}}"),
      "study.yaml:5:33: time.start.from: run b comes later than run a, expected an earlier one (run a)");
  EXPECT_EQ(sentence("{pre: {}, b: {time: {start: {from: prr}}}}"),
            "study.yaml:5:42: time.start.from: no run is called 'prr'; did you mean 'pre'? (run b)");
  EXPECT_EQ(sentence("{a: {}, b: {mesh: {refine: 2}, time: {start: {from: a}}}}"),
            "study.yaml:5:59: time.start.from: run a has another mesh or physics than run b (run b)");
  EXPECT_EQ(sentence("{a: {time: {start: {form: b}}}}").substr(0, 15), "not one fault");
}

TEST(DeckSettings, ChangeWordsListsAndEntries) {
  const auto study = parse_one(full_deck, {{"loads.0.nodal_force.y", "-1e6"},
                                           {"contact.interface.friction", "0"},
                                           {"mesh.generate.1.divisions", "[40, 4]"},
                                           {"mesh.generate.0.divisions.1", "8"},
                                           {"newton", "{residual: 1e-6}"},
                                           {"title", "set"},
                                           {"probes.new", "{node: N1}"},
                                           {"fields", ""},
                                           {"checks", "~"}});
  EXPECT_EQ(study.loads.at(0).components[1], -1e6);
  EXPECT_EQ(study.contact.at(0).friction, 0);
  EXPECT_EQ(study.mesh.bodies.at(1).divisions, (std::array{40, 4, 1}));
  EXPECT_EQ(study.mesh.bodies.at(0).divisions, (std::array{20, 8, 1}));
  EXPECT_EQ(study.newton, (study::NewtonSettings{25, 1e-6}));
  EXPECT_EQ(study.title, "set");
  EXPECT_EQ(study.probes.size(), 3U);
  EXPECT_FALSE(study.fields.vtu);
  EXPECT_TRUE(study.checks.empty());
  EXPECT_EQ(parse(full_deck, {{"title", "set"}}).title, "set");
}

TEST(DeckSettings, MakeMapsThatTheDeckHasNot) {
  EXPECT_EQ(parse_one(smallest_deck, {{"newton.residual", "1e-10"}}).newton.residual, 1e-10);
  EXPECT_EQ(parse_one(smallest_deck, {{"time.on_failure.cut", "3"}}).time.cut_parts, 3);
}

TEST(DeckSettings, ComeAfterTheRunsAndLaterOnesWin) {
  const auto deck = full_deck + "runs: {a: {time: {step: 5e-4}}, b: {}}";
  const auto runs = parse(deck, {{"time.step", "1e-4"}, {"runs.b.time.step", "2e-4"}}).runs;
  EXPECT_EQ(runs.at(0).time.step, 1e-4);
  EXPECT_EQ(runs.at(1).time.step, 2e-4);
  EXPECT_EQ(parse_one(smallest_deck, {{"runs.run.time.step", "2e-4"}}).time.step, 2e-4);
}

TEST(DeckSettings, MeshFileIsFromTheCurrentFolderAndDrivesOutTheGenerator) {
  const std::vector<Setting> settings{{"mesh.file", "real/f.med"}};
  const auto deck = parse_deck(full_deck, "cases/f/f.yaml", settings);
  const auto& mesh = deck.runs.at(0).mesh;
  EXPECT_EQ(mesh.file, "real/f.med");
  EXPECT_TRUE(mesh.bodies.empty());
  EXPECT_EQ(to_string(deck.places.at(0).of("mesh.file")), "--set mesh.file");
  const std::vector<Setting> whole{{"mesh", "{file: g.med}"}};
  EXPECT_TRUE(parse_deck(full_deck, "cases/f/f.yaml", whole).runs.at(0).mesh.bodies.empty());
  const std::vector<Setting> bodies{
      {"mesh.generate", "[{name: b, box: {from: [0, 0, 0], to: [1, 1, 1]}, divisions: [1, 1, 1]}]"}};
  EXPECT_EQ(parse_deck(smallest_deck, "f.yaml", bodies).runs.at(0).mesh.file, "");
}

TEST(DeckSettings, FaultsStandAtTheSetting) {
  const auto only = [](const Setting& setting, const std::string& deck = full_deck) {
    const auto faults = faults_of(deck, {setting});
    return faults.size() == 1 ? faults[0] : std::to_string(faults.size()) + " faults";
  };
  EXPECT_EQ(only({"time.step", "fast"}), "--set time.step: time.step: found 'fast', expected a number > 0");
  EXPECT_EQ(only({"time.stp", "1"}), "--set time.stp: unknown key 'time.stp'; did you mean 'step'?");
  EXPECT_EQ(only({"tme.step", "1"}), "--set tme.step: unknown key 'tme'; did you mean 'time'?");
  EXPECT_EQ(only({"contact.interfce.friction", "0"}),
            "--set contact.interfce.friction: contact has no 'interfce'; did you mean 'interface'?");
  EXPECT_EQ(only({"loads.7.nodal_force.y", "0"}),
            "--set loads.7.nodal_force.y: found '7' as place in a list, expected a number from 0 to 4");
  EXPECT_EQ(only({"checks.x", "0"}),
            "--set checks.x: found 'x' as place in a list, expected 0, the list has one entry");
  EXPECT_EQ(only({"time.start.from", "a"}),
            "--set time.start.from: found 'consistent' at 'start', which has no 'from'");
  EXPECT_EQ(only({"runs.evol.time.step", "1"}, smallest_deck + "runs: {evol1: {}}"),
            "--set runs.evol.time.step: no run is called 'evol'; did you mean 'evol1'?");
  EXPECT_EQ(only({"runs.run", "1"}), "--set runs.run: expected a key of one run, as in runs.NAME.time.step");
  EXPECT_EQ(only({"time..step", "1"}),
            "--set time..step: found the path 'time..step', expected keys joined by dots, as in time.step");
  EXPECT_EQ(only({"time.step", "[1"}).substr(0, 42), "--set time.step: the text is not YAML: end");
  EXPECT_EQ(only({"newton", "{residual: 1e-8, residual: 1e-9}"}),
            "--set newton: found the key 'residual' a second "
            "time");
}

TEST(DeckSettings, AreSplitAtTheFirstEqualsSign) {
  const auto setting = parse_setting("checks.0.note=a=b");
  EXPECT_EQ(setting.path, "checks.0.note");
  EXPECT_EQ(setting.value, "a=b");
  EXPECT_EQ(parse_setting("contact=").value, "");
  EXPECT_THROW(parse_setting("time.step"), InputError);
  EXPECT_THROW(parse_setting("=1"), InputError);
}

} // namespace
} // namespace rubato::deck::overlay_test
