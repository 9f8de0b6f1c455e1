// SPDX-License-Identifier: LGPL-3.0-or-later
// Functions of time and tables along an axis in decks, with files of columns.
#include "rubato/study/echo.hpp"

#include <gtest/gtest.h>

#include "sample_deck.hpp"
#include "support/scratch_folder.hpp"
#include <filesystem>
#include <fstream>

namespace rubato::deck::functions_test {
namespace {

using test::faults_of;
using test::parse_one;
using test::Sentences;
using test::smallest_deck;

std::string with_functions(const std::string& functions) {
  return smallest_deck + "functions:\n" + functions;
}

const std::string every_kind = with_functions(R"(  table: {times: [0, 1], values: [2, 3], outside: zero}
  up: {ramp: [1, 3]}
  down: {ramp: {begin: 1, end: 3, from: 1, to: -1}}
  until: {ramp: {end: 3}}
  wave: {sine: {frequency: 2, amplitude: 3, phase: 90, mean: 1}}
  plain: {sine: {frequency: 2}}
  pulse: {expression: exp(-t)*sin(2*pi*t)}
  all: {product: [both, pulse, {ramp: [0, 1]}]}
  both: {product: [up, wave]}
)");

TEST(FunctionsOfADeck, AreOfEveryKind) {
  const auto functions = parse_one(every_kind).functions;
  EXPECT_EQ(functions.at("table"), (Function{{0, 1}, {2, 3}, Function::Outside::zero}));
  EXPECT_EQ(functions.at("up"), Function(Ramp{1, 3, 0, 1}));
  EXPECT_EQ(functions.at("down"), Function(Ramp{1, 3, 1, -1}));
  EXPECT_EQ(functions.at("until"), Function(Ramp{0, 3, 0, 1}));
  EXPECT_EQ(functions.at("wave"), Function(Sine{3, 2, 90, 1}));
  EXPECT_EQ(functions.at("plain"), Function(Sine{1, 2, 0, 0}));
  EXPECT_EQ(functions.at("pulse"), Function(Expression("exp(-t)*sin(2*pi*t)")));
}

TEST(FunctionsOfADeck, AreMultipliedWhateverTheirOrder) {
  const auto functions = parse_one(every_kind).functions;
  EXPECT_EQ(functions.at("both"), Function(Product{{functions.at("up"), functions.at("wave")}}));
  EXPECT_EQ(functions.at("all"), Function(Product{{functions.at("up"), functions.at("wave"),
                                                   functions.at("pulse"), Function(Ramp{0, 1, 0, 1})}}));
}

TEST(FunctionsOfADeck, AreEchoed) {
  const auto study = parse_one(every_kind);
  EXPECT_EQ(parse_one(study::to_json(study)), study);
}

struct BadFunction {
  std::string name;
  std::string function;
  std::string sentence;
};

std::ostream& operator<<(std::ostream& out, const BadFunction& bad) {
  return out << bad.name;
}

class BadFunctions : public testing::TestWithParam<BadFunction> {};

TEST_P(BadFunctions, AreToldAtTheirPlace) {
  const auto faults = faults_of(with_functions("  g: {ramp: [0, 1]}\n  f: " + GetParam().function + "\n"));
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults.front(), "study.yaml:7:" + GetParam().sentence);
  EXPECT_EQ(faults.size(), 1U) << faults.back();
}

INSTANTIATE_TEST_SUITE_P(
    As, BadFunctions,
    testing::Values(
        BadFunction{"TwoKinds", "{ramp: [0, 1], sine: {frequency: 1}}",
                    "6: functions.f: found ramp and sine together, expected one of them"},
        BadFunction{"TableAndRamp", "{ramp: [0, 1], values: [0, 1]}",
                    "29: functions.f.values: 'ramp' takes no 'values', a table of times does"},
        BadFunction{"OutsideOfARamp", "{ramp: [0, 1], outside: zero}",
                    "30: functions.f.outside: 'ramp' takes no 'outside', a table does"},
        BadFunction{
            "RampBackwards", "{ramp: [1, 0]}",
            "13: functions.f.ramp: found the end 0 of a ramp that begins at 1, expected a later instant"},
        BadFunction{"ThreeInstants", "{ramp: [1, 2, 3]}",
                    "13: functions.f.ramp: found 3 numbers, expected the two instants of a ramp"},
        BadFunction{"RampWithoutEnd", "{ramp: {begin: 1}}", "13: functions.f.ramp: 'end' is missing"},
        BadFunction{"NoFrequency", "{sine: {amplitude: 1}}", "13: functions.f.sine: 'frequency' is missing"},
        BadFunction{"BadFrequency", "{sine: {frequency: 0}}",
                    "25: functions.f.sine.frequency: found '0', expected a number > 0"},
        BadFunction{"OfPlace", "{expression: x*t}",
                    "19: functions.f.expression: found x in 'x*t', a function of time has t only"},
        BadFunction{"Infinite", "{expression: 1/t}",
                    "19: functions.f.expression: the function of time '1/t' is infinite at t = 0, expected a "
                    "finite number"},
        BadFunction{"UnknownFactor", "{product: [g, other]}",
                    "20: functions.f.product.1: no function is called 'other'; expected one of g, f"},
        BadFunction{"OfItself", "{product: [g, f]}",
                    "20: functions.f.product.1: found 'f', which is a product of itself"},
        BadFunction{"NoFactor", "{product: []}",
                    "16: functions.f.product: found 0 factors, expected 1 to 100"},
        BadFunction{"UnknownKey", "{rampe: [0, 1]}",
                    "7: unknown key 'functions.f.rampe'; did you mean 'ramp'?"},
        BadFunction{"NoFile", "{csv: none.csv, value: v}",
                    "12: functions.f.csv: file 'none.csv' does not exist"}),
    [](const auto& bad) { return bad.param.name; });

TEST(BadFunctions, WithABrokenExpressionAreToldOnce) {
  const auto faults = faults_of(with_functions("  f: {expression: 2*q}\n"));
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_TRUE(faults.front().starts_with("study.yaml:6:19: functions.f.expression: ")) << faults.front();
}

/// A deck beside a file of columns.
class ColumnsOfAFile : public testing::Test {
protected:
  study::Study study(const std::string& columns, const std::string& more,
                     const std::vector<Setting>& settings = {}) const {
    std::ofstream(folder_ / "data.csv") << columns;
    return parse_deck(smallest_deck + more, (folder_ / "study.yaml").string(), settings).runs.at(0);
  }

  std::string refusal(const std::string& columns) const {
    try {
      study(columns, "functions: {f: {csv: data.csv, time: t, value: v}}\n");
    } catch (const InputError& error) {
      const auto& fault = error.faults().front();
      return std::filesystem::path(fault.at.file).filename().string() + ":" + std::to_string(fault.at.line) +
             ": " + fault.text;
    }
    return "nothing thrown";
  }

  test::ScratchFolder folder_;
};

TEST_F(ColumnsOfAFile, AreFunctionsOfTime) {
  const auto read = study("# measured\nt, u, \"v\"\n0, 9, 1e-3\n0.5, 9, +2\n\n1, 9, -3\n",
                          "functions: {f: {csv: data.csv, time: t, value: v}, g: {csv: data.csv, value: u, "
                          "outside: zero}}\n");
  EXPECT_EQ(read.functions.at("f"), (Function{{0, 0.5, 1}, {1e-3, 2, -3}}));
  EXPECT_EQ(read.functions.at("g"), (Function{{0, 0.5, 1}, {9, 9, 9}, Function::Outside::zero}));
  EXPECT_EQ(parse_one(study::to_json(read)), read);
}

TEST_F(ColumnsOfAFile, MayHaveOtherSeparatorsAndLineEnds) {
  for (const char separator : {';', '\t'}) {
    std::string columns = "t?v\r\n0?1\r\n1?2\r\n";
    std::ranges::replace(columns, '?', separator);
    const auto read = study(columns, "functions: {f: {csv: data.csv, time: t, value: v}}\n");
    EXPECT_EQ(read.functions.at("f"), (Function{{0, 1}, {1, 2}}));
  }
}

TEST_F(ColumnsOfAFile, AreTablesAlongAnAxis) {
  const auto read = study("y,p\n0,1\n2,5\n", R"(
supports: [{on: A, x: {along: z, at: [0, 1], values: [0, 2], outside: linear}, y: {value: {along: x, at: [0], values: [1]}, function: f}}]
functions: {f: {ramp: [0, 1]}}
loads:
  - pressure: {on: A, value: {along: y, csv: data.csv, column: p}, function: f}
  - nodal_force: {on: A, x: {along: y, csv: data.csv, coordinate: y, column: p, outside: zero}}
contact: {c: {master: A, slave: B, gap: {along: x, at: [0, 1], values: [0, 0.1]}}}
)");
  const Profile along_y{1, {{0, 2}, {1, 5}, LinearTable::Outside::constant}};
  ASSERT_NE(read.loads[0].components[0].profile(), nullptr);
  EXPECT_EQ(*read.loads[0].components[0].profile(), along_y);
  EXPECT_EQ(read.loads[1].components[0].profile()->table.outside, LinearTable::Outside::zero);
  EXPECT_EQ(*read.supports[0].components[0],
            study::Field(Profile{2, {{0, 1}, {0, 2}, LinearTable::Outside::linear}}));
  EXPECT_EQ(*read.supports[0].components[1],
            study::Field(Profile{0, {{0}, {1}, LinearTable::Outside::constant}}, "f"));
  EXPECT_NE(read.contact[0].gap.value.profile(), nullptr);
  EXPECT_EQ(parse_one(study::to_json(read)), read);
}

TEST_F(ColumnsOfAFile, AreRefusedAtTheirLine) {
  EXPECT_EQ(refusal("t,v\n0,1\n1,nan\n"),
            "data.csv:3: functions.f.csv: found 'nan' in the column 'v', expected a number");
  EXPECT_EQ(refusal("t,v\n0,1\n1,2s\n"),
            "data.csv:3: functions.f.csv: found '2s' in the column 'v', expected a number");
  EXPECT_EQ(refusal("t,v\n0,1\n1\n"), "data.csv:3: functions.f.csv: found 1 columns, expected 2");
  EXPECT_EQ(refusal("t,v\n0,1\n\n0,2\n"),
            "data.csv:4: functions.f.csv: found 0 after 0 in the column 't', expected numbers that ascend");
  EXPECT_EQ(refusal("time,speed\n0,1\n"),
            "data.csv:1: functions.f.csv: found no column 't'; expected one of time, speed");
  EXPECT_EQ(refusal("t,v\n"), "data.csv:1: functions.f.csv: found no numbers below the names of the columns");
  EXPECT_EQ(refusal(""),
            "study.yaml:5: functions.f.csv: found no line, expected names of columns and numbers below");
}

TEST(FrictionOfADeck, MayDependOnThePlace) {
  const auto zone = [](const std::string& friction) {
    return smallest_deck + "contact: {a: {master: M, slave: S, friction: " + friction + "}}\n";
  };
  const auto study = parse_one(zone("0.1+x"));
  EXPECT_EQ(study.contact[0].friction, 1);
  EXPECT_EQ(study.contact[0].friction_in_place, study::FieldValue(study::Formula{"0.1+x"}));
  EXPECT_EQ(parse_one(study::to_json(study)), study);
  EXPECT_NE(parse_one(zone("{along: x, at: [0, 1], values: [0, 1]}")).contact[0].friction_in_place->profile(),
            nullptr);
  EXPECT_FALSE(parse_one(zone("0.3")).contact[0].friction_in_place);
  EXPECT_EQ(
      faults_of(zone("t")),
      Sentences{"study.yaml:5:46: contact.a.friction: found t in 't', friction depends on the place only"});
  EXPECT_EQ(
      faults_of(zone("0.1*y, tie: true")),
      Sentences{
          "study.yaml:5:46: contact.a.friction: found friction in a tie, expected none: surfaces that are "
          "tied do not slide"});
}

TEST(MaterialsOfADeck, MayDependOnThePlace) {
  const auto deck =
      test::replaced(smallest_deck, "young: 200e9, poisson: 0.3, density: 7800",
                     "young: 200e9*(1+x), poisson: {along: y, at: [0, 1], values: [0, 0.3]}, density: 1+z");
  const auto material = parse_one(deck).materials[0];
  EXPECT_EQ(material.in_place.at("young"), study::FieldValue(study::Formula{"200e9*(1+x)"}));
  EXPECT_NE(material.in_place.at("poisson").profile(), nullptr);
  EXPECT_EQ(material.in_place.size(), 3U);
  EXPECT_TRUE(parse_one(smallest_deck).materials[0].in_place.empty());
  EXPECT_EQ(faults_of(test::replaced(smallest_deck, "young: 200e9", "young: 1+t")),
            Sentences{"study.yaml:3:28: materials.steel.young: found t in '1+t', a number of a material "
                      "depends on the place only"});
}

TEST(AxesOfMaterials, TurnWithThePlace) {
  const auto with_axes = [](const std::string& axes) {
    return test::replaced(
        smallest_deck, "young: 200e9, poisson: 0.3",
        "law: orthotropic, young_x: 9, young_y: 4, young_z: 1, poisson_xy: 0.3, poisson_yz: 0.2, "
        "poisson_xz: 0.1, shear_xy: 3, shear_yz: 2, shear_xz: 1, axes: " +
            axes);
  };
  const auto study = parse_one(with_axes("{cylindrical: {point: [1, 2, 3], direction: [0, 0, 2]}}"));
  EXPECT_EQ(study.materials[0].orthotropy.cylindrical, (study::CylindricalAxes{{1, 2, 3}, {0, 0, 2}}));
  EXPECT_NE(faults_of(with_axes("{cylindrical: {point: [1, 2], direction: [0, 0, 1]}}"))
                .front()
                .find("found 2 coordinates"),
            std::string::npos);
  EXPECT_NE(faults_of(with_axes("{}")).front().find("'cylindrical' is missing"), std::string::npos);
  EXPECT_NE(faults_of(test::replaced(with_axes("{cylindrical: {point: [1, 2], direction: [0, 1]}}"), "solid",
                                     "plane_strain"))
                .front()
                .find("in plane_strain the axes turn about z, expected 'point' alone"),
            std::string::npos);
  EXPECT_NE(faults_of(test::replaced(smallest_deck, "poisson: 0.3", "poisson: 0.3, axes: {}"))
                .front()
                .find("the law elastic takes no axes"),
            std::string::npos);
}

TEST(FieldsOfFiles, AreReadWithTheirNames) {
  const auto with_x = [](const std::string& value) {
    return smallest_deck + "supports: [{on: A, x: " + value + "}]\n" + "functions: {f: {ramp: [0, 1]}}\n";
  };
  const auto read = parse_one(with_x("{field: a.med, name: T, component: b, at: 2}"));
  EXPECT_EQ(*read.supports[0].components[0]->value.of_file(), (study::FileField{"a.med", "T", "b", 2.0}));
  EXPECT_EQ(parse_one(study::to_json(read)), read);
  const auto times =
      parse_one(with_x("{value: {field: a.vtu, name: T}, function: f}")).supports[0].components[0];
  EXPECT_EQ(*times->value.of_file(), (study::FileField{"a.vtu", "T", "", {}}));
  EXPECT_EQ(times->function, "f");
  EXPECT_EQ(parse_one(test::replaced(smallest_deck, "poisson: 0.3", "poisson: {field: a.vtu, name: nu}"))
                .materials[0]
                .in_place.at("poisson")
                .of_file()
                ->name,
            "nu");
  EXPECT_EQ(faults_of(with_x("{field: a.med}")),
            Sentences{"study.yaml:5:23: supports.0.x: 'name' is missing"});
  EXPECT_EQ(faults_of(test::replaced(smallest_deck, "young: 200e9", "young: {field: a.vtu}")),
            Sentences{"study.yaml:3:28: materials.steel.young: 'name' is missing"});
  EXPECT_EQ(faults_of(with_x("{field: a.med, name: T, componnt: b}")),
            Sentences{"study.yaml:5:47: unknown key 'supports.0.x.componnt'; did you mean 'component'?"});
}

TEST(FieldsOfPrograms, AreRefused) {
  const auto faults = faults_of(smallest_deck + "supports: [{on: A, x: {given: mine}}]\n");
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(
      faults.front(),
      "study.yaml:5:23: supports.0.x: found a field that a program gave to the study, expected a number, "
      "an expression, a table or a field of a file: no deck has the function that computes it");
}

TEST(BadTablesAlongAnAxis, AreToldAtTheirPlace) {
  const auto faults = [](const std::string& value) {
    return faults_of(smallest_deck + "supports: [{on: A, x: " + value + "}]\n");
  };
  EXPECT_EQ(
      faults("{along: r, at: [0], values: [1]}"),
      Sentences{
          "study.yaml:5:31: supports.0.x.along: found 'r', expected one of x, y, z; did you mean 'x'?"});
  EXPECT_EQ(faults("{along: x, at: [1, 0], values: [1, 2]}"),
            Sentences{"study.yaml:5:42: supports.0.x.at.1: found 0 after 1, expected numbers that ascend"});
  EXPECT_EQ(faults("{along: x, at: [0, 1], values: [1]}"),
            Sentences{"study.yaml:5:54: supports.0.x.values: found 1 values for 2 at"});
  EXPECT_EQ(faults("{along: x, values: [1]}"), Sentences{"study.yaml:5:23: supports.0.x: 'at' is missing"});
  const auto plane = test::replaced(smallest_deck, "solid", "plane_strain");
  EXPECT_EQ(faults_of(plane + "supports: [{on: A, x: {along: z, at: [0], values: [1]}}]\n"),
            Sentences{"study.yaml:5:31: supports.0.x.along: plane_strain has no z, expected x or y"});
}

} // namespace
} // namespace rubato::deck::functions_test
