// SPDX-License-Identifier: LGPL-3.0-or-later
// Groups that a deck makes of what its mesh has.
#include "rubato/deck/groups.hpp"
#include "rubato/study/echo.hpp"

#include <gtest/gtest.h>

#include "sample_deck.hpp"
#include "support/faults.hpp"

namespace rubato::deck::groups_test {
namespace {

using test::fault_of;
using test::faults_of;
using test::parse_one;
using test::replaced;
using test::Sentences;
using test::smallest_deck;

std::string with_groups(const std::string& groups) {
  return replaced(smallest_deck, "{file: beams.med}", "\n  file: beams.med\n  groups:\n" + groups);
}

const std::string every_kind = with_groups(R"(    both: {union: [left, right]}
    shared: {intersection: [left, right]}
    rest: {difference: [left, right, N4]}
    corner: {box: {from: [0, 0, 0], to: [1, 2, 3]}, of: left, take: cells}
    ball: {sphere: {point: [1, 0, 0], radius: 2}}
    bore: {cylinder: {point: [0, 0, 1], axis: [0, 0, -1], radius: 3}, within: 1e-3, take: faces}
    floor: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, take: nodes}
    roof: {normal: [0, 0, 1], of: left, angle: 10}
    shell: {skin: all}
    points: {nodes_of: left}
    ends: {corners_of: left}
    middles: {middles_of: left}
    line: {along: [1, 0, 0], of: points}
)");

TEST(GroupsOfADeck, AreMadeInEveryWay) {
  const auto groups = parse_one(every_kind).mesh.groups;
  ASSERT_EQ(groups.size(), 13U);
  EXPECT_EQ(groups[2].kind, study::GroupKind::difference);
  EXPECT_EQ(groups[2].of, (std::vector<std::string>{"left", "right", "N4"}));
  EXPECT_EQ(groups[3].to, (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(groups[3].take, study::GroupTake::cells);
  EXPECT_EQ(groups[4].radius, 2);
  EXPECT_EQ(groups[4].take, study::GroupTake::nodes);
  EXPECT_EQ(groups[4].of, std::vector<std::string>{});
  EXPECT_EQ(groups[5].direction, (std::array<double, 3>{0, 0, -1}));
  EXPECT_EQ(groups[5].within, 1e-3);
  EXPECT_EQ(groups[7].angle, 10);
  EXPECT_EQ(groups[8].of, std::vector<std::string>{"all"});
  EXPECT_EQ(groups[12].name, "line");
  EXPECT_EQ(groups[12].of, std::vector<std::string>{"points"});
}

TEST(GroupsOfADeck, AreEchoed) {
  const auto study = parse_one(every_kind);
  EXPECT_EQ(parse_one(study::to_json(study)), study);
  const auto plane = replaced(replaced(smallest_deck, "solid", "plane_strain"), "{file: beams.med}",
                              "{file: beams.med, groups: {a: {plane: {point: [0, 1], normal: [1, 0]}}}}");
  EXPECT_EQ(parse_one(study::to_json(parse_one(plane))), parse_one(plane));
}

TEST(GroupsOfADeck, AreChangedBySettings) {
  const auto groups =
      parse_one(every_kind, {{"mesh.groups.roof.angle", "20"}, {"mesh.groups.line", ""}}).mesh.groups;
  EXPECT_EQ(groups[7].angle, 20);
  EXPECT_EQ(groups.size(), 12U);
}

struct BadGroup {
  std::string name;
  std::string group;
  std::string sentence;
};

std::ostream& operator<<(std::ostream& out, const BadGroup& bad) {
  return out << bad.name;
}

class BadGroups : public testing::TestWithParam<BadGroup> {};

TEST_P(BadGroups, AreToldAtTheirPlace) {
  const auto faults = faults_of(with_groups("    a: " + GetParam().group + "\n"));
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults.front(), "study.yaml:4:" + GetParam().sentence);
}

INSTANTIATE_TEST_SUITE_P(
    As, BadGroups,
    testing::Values(
        BadGroup{"NoKind", "{take: faces}",
                 "8: mesh.groups.a: does not say how it is made, expected one of union, intersection, "
                 "difference, box, sphere, cylinder, plane, normal, skin, nodes_of, corners_of, middles_of, "
                 "along"},
        BadGroup{"TwoKinds", "{skin: b, nodes_of: c}",
                 "8: mesh.groups.a: found skin and nodes_of together, expected one of them"},
        BadGroup{"UnknownKind", "{skinn: b}", "9: unknown key 'mesh.groups.a.skinn'; did you mean 'skin'?"},
        BadGroup{"OneOperand", "{union: [b]}",
                 "16: mesh.groups.a.union: found 1 groups, expected two or more"},
        BadGroup{"NoList", "{union: b}", "16: mesh.groups.a.union: found 'b', expected a list of groups"},
        BadGroup{"Twice", "{union: [b, b]}", "20: mesh.groups.a.union.1: found 'b' a second time"},
        BadGroup{"WrongKey", "{skin: b, take: faces}",
                 "24: mesh.groups.a.take: 'skin' takes no 'take', these do: box, sphere, cylinder, plane"},
        BadGroup{"WordOfTake", "{box: {from: [0, 0, 0], to: [1, 1, 1]}, take: face}",
                 "54: mesh.groups.a.take: found 'face', expected one of nodes, faces, cells; did you mean "
                 "'faces'?"},
        BadGroup{"Coordinates", "{plane: {point: [0, 0], normal: [0, 0, 1]}}",
                 "24: mesh.groups.a.plane.point: found 2 coordinates, expected 3"},
        BadGroup{"NoDirection", "{normal: [0, 0, 0]}",
                 "17: mesh.groups.a.normal: found a vector of length 0, expected one that points somewhere"},
        BadGroup{"BoxUpsideDown", "{box: {from: [0, 0, 2], to: [1, 1, 1]}}",
                 "43: mesh.groups.a.box.to.2: found 1 for z, expected at least the 2 of 'from'"},
        BadGroup{"NoRadius", "{sphere: {point: [0, 0, 0]}}", "17: mesh.groups.a.sphere: 'radius' is missing"},
        BadGroup{"BadRadius", "{sphere: {point: [0, 0, 0], radius: -1}}",
                 "44: mesh.groups.a.sphere.radius: found '-1', expected a number > 0"},
        BadGroup{"BadAngle", "{normal: [1, 0, 0], angle: 181}",
                 "35: mesh.groups.a.angle: found '181', expected a number > 0 and <= 180"},
        BadGroup{"NothingOrdered", "{along: [1, 0, 0]}", "8: mesh.groups.a: 'of' is missing"},
        BadGroup{"OfItself", "{union: [b, a]}",
                 "5: mesh.groups.a: found groups that are made of one another, a of a, expected an end"}),
    [](const auto& bad) { return bad.param.name; });

TEST(BadGroups, ThatNeedOneAnotherAreNamed) {
  EXPECT_EQ(
      faults_of(with_groups("    a: {skin: b}\n    b: {union: [c, a]}\n")),
      Sentences{"study.yaml:4:5: mesh.groups.a: found groups that are made of one another, a of b of a, "
                "expected an end"});
}

TEST(BadGroups, StandForEverythingUnderNoOtherName) {
  EXPECT_EQ(faults_of(with_groups("    all: {skin: b}\n")),
            Sentences{"study.yaml:4:5: mesh.groups.all: found the name 'all', which stands for everything, "
                      "expected another one"});
}

TEST(BadGroups, OfPlaneMeshesHaveNoCylinders) {
  const auto deck = replaced(with_groups("    a: {cylinder: {point: [0, 0], axis: [0, 1], radius: 1}}\n"),
                             "solid", "plane_strain");
  EXPECT_EQ(faults_of(deck),
            Sentences{"study.yaml:4:19: mesh.groups.a.cylinder: plane_strain has no cylinder, "
                      "expected sphere, a circle there"});
}

TEST(GroupsOfACommandLine, AreThoseOfADeck) {
  const std::vector<std::string> options{"top={normal: [0, 0, 1], angle: 5}",
                                         "rest={difference: [shell, top]}"};
  const auto groups = parse_groups(options, 3);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].name, "top");
  EXPECT_EQ(groups[0].angle, 5);
  EXPECT_EQ(groups[1].of, (std::vector<std::string>{"shell", "top"}));
  EXPECT_TRUE(parse_groups({}, 2).empty());
}

TEST(GroupsOfACommandLine, AreRefusedWithTheirName) {
  const auto refusal = [](const std::vector<std::string>& options, int dimension) {
    return fault_of([&] { parse_groups(options, dimension); });
  };
  EXPECT_EQ(refusal({"top"}, 3),
            "--group: found 'top', expected NAME={...}, as in 'top={normal: [0, 0, 1]}'");
  EXPECT_EQ(refusal({"top={normal: [0, 0, 1]}"}, 2),
            "--group top: mesh.groups.top.normal: found 3 coordinates, expected 2");
  EXPECT_EQ(refusal({"top={skin: b, angle: 3}"}, 2),
            "--group top: mesh.groups.top.angle: 'skin' takes no 'angle', these do: normal");
  EXPECT_EQ(refusal({"top={union: [b]}"}, 2),
            "--group top: mesh.groups.top.union: found 1 groups, expected two or more");
  EXPECT_EQ(refusal({"t={skin: b}", "t={skin: c}"}, 2), "--group t: found a second group named 't'");
}

} // namespace
} // namespace rubato::deck::groups_test
