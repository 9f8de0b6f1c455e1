// SPDX-License-Identifier: LGPL-3.0-or-later
// Texts that are not one plain YAML map, and YAML that tries to be too clever.
#include <gtest/gtest.h>

#include "sample_deck.hpp"

namespace rubato::deck::yaml_test {
namespace {

using test::faults_of;
using test::parse_one;
using test::replaced;
using test::Sentences;
using test::smallest_deck;

TEST(DeckText, MustSaySomething) {
  const Sentences empty{"study.yaml: found no deck: the text is empty"};
  EXPECT_EQ(faults_of(""), empty);
  EXPECT_EQ(faults_of("\n  \n# only a comment\r\n"), empty);
  EXPECT_EQ(faults_of("---\n"), Sentences{"study.yaml:2:1: found nothing, expected a map with mesh, physics, "
                                          "materials, time"});
}

TEST(DeckText, MustBeAMap) {
  EXPECT_EQ(faults_of("- a\n- b\n"),
            Sentences{"study.yaml:1:1: found a list, expected a map with mesh, physics, materials, time"});
  EXPECT_EQ(
      faults_of("just words"),
      Sentences{"study.yaml:1:1: found 'just words', expected a map with mesh, physics, materials, time"});
}

TEST(DeckText, MustBeOneDocument) {
  const auto faults = faults_of(smallest_deck + "---\n" + smallest_deck);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0], "study.yaml:5:1: found a second YAML document, expected one deck a file");
}

TEST(DeckText, IsIndentedWithBlanks) {
  EXPECT_EQ(
      faults_of("mesh:\n\tfile: a.med\n"),
      Sentences{
          "study.yaml:2:1: found a tab before the first word of the line; YAML is indented with blanks"});
  EXPECT_EQ(faults_of(smallest_deck + "newton: {\n  \tresidual: 1e-9}\n").size(), 1U);
}

TEST(DeckText, MayHaveTabsElsewhereAndWindowsLines) {
  EXPECT_EQ(faults_of("mesh:\t{file: a.med}\t# tab\r\nphysics: solid\r\n\r\n" +
                      smallest_deck.substr(smallest_deck.find("materials"))),
            Sentences{});
  EXPECT_EQ(faults_of("\xEF\xBB\xBF" + smallest_deck), Sentences{});
}

TEST(DeckText, MustBeUtf8WithoutControlCharacters) {
  EXPECT_EQ(faults_of("title: \xE9t\xE9\n"),
            Sentences{"study.yaml:1:8: found byte 0xe9, which is not UTF-8 text"});
  EXPECT_EQ(faults_of("title: \xC0\xAF\n"),
            Sentences{"study.yaml:1:8: found byte 0xc0, which is not UTF-8 text"});
  EXPECT_EQ(faults_of(std::string_view("title: a\0b\n", 11)),
            Sentences{"study.yaml:1:9: found control character 0x00, expected plain text"});
  EXPECT_EQ(parse_one("title: poutre à 2 €\n" + smallest_deck).title, "poutre à 2 €");
}

TEST(DeckText, BrokenYamlSaysWhere) {
  const auto faults = faults_of("mesh: {file: a.med\nphysics: solid\n");
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].substr(0, 36), "study.yaml:2:8: the text is not YAML");
  const auto alias = faults_of("mesh: *nothing\n");
  ASSERT_EQ(alias.size(), 1U);
  EXPECT_EQ(alias[0].substr(0, 36), "study.yaml:1:7: the text is not YAML");
}

TEST(DeckText, AKeyStandsOnceInAMap) {
  EXPECT_EQ(faults_of(smallest_deck + "physics: plane_stress\n"),
            Sentences{"study.yaml:5:1: found the key 'physics' a second time, first given on line 2"});
  EXPECT_EQ(faults_of(replaced(smallest_deck, "young: 200e9", "young: 200e9, young: 210e9")),
            Sentences{"study.yaml:3:35: found the key 'young' a second time, first given on line 3"});
}

TEST(DeckText, KeysAreWords) {
  EXPECT_EQ(faults_of(smallest_deck + "[a, b]: 1\n"),
            Sentences{"study.yaml:5:1: found a list as a key, expected a word"});
  EXPECT_EQ(faults_of(smallest_deck + "~: 1\n"),
            Sentences{"study.yaml:5:1: found nothing as a key, expected a word"});
}

TEST(DeckText, HasNoTags) {
  const auto faults = faults_of(replaced(smallest_deck, "200e9", "!!float 200e9"));
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].substr(0, 37), "study.yaml:3:28: found the YAML tag '");
}

TEST(DeckText, AnchorsAndMergeKeysAreExpanded) {
  const auto study = parse_one(R"(mesh: {file: a.med}
physics: solid
materials:
  steel: &steel {young: 200e9, poisson: 0.3, density: 7800, cells: a}
  brass: {<<: *steel, young: 100e9, cells: b}
  lead: {<<: [{young: 16e9}, *steel], cells: &group c}
supports: [{on: *group, fix: x}]
time: {scheme: newmark, step: 1, end: 2}
)");
  ASSERT_EQ(study.materials.size(), 3U);
  EXPECT_EQ(study.materials[1].young, 100e9);
  EXPECT_EQ(study.materials[1].density, 7800);
  EXPECT_EQ(study.materials[1].cells.at(0), "b");
  EXPECT_EQ(study.materials[2].young, 16e9);
  EXPECT_EQ(study.supports.at(0).on, "c");
  EXPECT_EQ(faults_of("<<: 1\n" + smallest_deck),
            Sentences{"study.yaml:1:5: found '1' after '<<', expected a map to "
                      "merge"});
}

TEST(DeckText, NestingIsBounded) {
  for (const auto* opening : {"[", "{a: ", "- ", "? ", "[{a: "}) {
    std::string text = "mesh: ";
    if (opening[0] == '-' || opening[0] == '?')
      text += "\n  ";
    for (int i = 0; i < 10'000; ++i)
      text += opening;
    EXPECT_EQ(faults_of(text).size(), 1U) << opening;
  }
}

TEST(DeckText, AliasesCannotGrowWithoutBound) {
  std::string text = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (char level = '1'; level <= '9'; ++level) {
    text.append("a").append(1, level).append(": &a").append(1, level).append(" [x");
    for (int j = 0; j < 10; ++j)
      text.append(", *a").append(1, static_cast<char>(level - 1));
    text += "]\n";
  }
  const auto faults = faults_of(text);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_NE(faults[0].find("found more than 200000 values (aliases expanded), which is no deck"),
            std::string::npos);
  EXPECT_EQ(faults_of("a: &a [*a]\n"), Sentences{"study.yaml:1:8: found an alias inside of its own anchor"});
}

} // namespace
} // namespace rubato::deck::yaml_test
