// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/inp_blocks.hpp"
#include "rubato/mesh/io/inp_elements.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

namespace rubato::mesh::inp::keywords_test {
namespace {

TEST(InpKeywords, AreEachInTheTableOnce) {
  std::set<std::string> names;
  for (const auto& keyword : all_keywords()) {
    EXPECT_TRUE(names.insert(compact(keyword.name)).second) << keyword.name;
    EXPECT_EQ(keyword_named(keyword.name), &keyword);
    for (const auto list : {keyword.takes, keyword.ignores})
      EXPECT_EQ(list.find(' '), std::string_view::npos) << keyword.name;
  }
  EXPECT_GT(names.size(), 200U);
}

TEST(InpKeywords, AreFoundInAnyCaseAndWithAnyBlanks) {
  EXPECT_EQ(keyword_named("solid  section"), keyword_named("SOLIDSECTION"));
  EXPECT_EQ(keyword_named("Pre-tension Section")->use, Use::study);
  EXPECT_EQ(keyword_named("NODES"), nullptr);
  EXPECT_EQ(nearest_keyword("ELEMNT"), "; did you mean '*ELEMENT'?");
}

/// The page says of each keyword what becomes of it.
TEST(InpKeywords, StandOnThePageAllOfThem) {
  std::ifstream stream(RUBATO_SOURCE_DIR "/docs/guide/inp.md");
  const std::string page(std::istreambuf_iterator<char>(stream), {});
  for (const auto& keyword : all_keywords())
    EXPECT_NE(page.find("`*" + std::string(keyword.name) + "`"), std::string::npos) << keyword.name;
  for (const auto& type : all_element_types())
    EXPECT_NE(page.find("`" + std::string(type.name) + "`"), std::string::npos) << type.name;
}

TEST(InpNumbers, HaveTheFormsOfFortran) {
  EXPECT_EQ(number_in("+1.D-3"), 1e-3);
  EXPECT_EQ(number_in(".5"), 0.5);
  EXPECT_EQ(number_in("-2.e+3"), -2000);
  EXPECT_EQ(number_in("3."), 3);
  for (const auto* text : {"", "1.0.0", "x", "1e999", "nan", "inf", "1 2", "0x1", "--1", "D3", "1D"})
    EXPECT_EQ(number_in(text), std::nullopt) << text;
  EXPECT_EQ(integer_in("+12"), 12);
  for (const auto* text : {"", "1.", "12x", "99999999999999999999"})
    EXPECT_EQ(integer_in(text), std::nullopt) << text;
}

TEST(InpBlocks, KnowWhereTheirWordsStand) {
  Faults faults;
  const auto source =
      parse_source("** first\n*NODE, NSET = Top ,\n SYSTEM=R\n 1,  2.5, \"a, b\",\n", "a.inp", faults);
  ASSERT_EQ(source.blocks.size(), 1U);
  const auto& block = source.blocks[0];
  EXPECT_TRUE(block.is("NODE"));
  EXPECT_EQ(to_string(block.at.at()), "a.inp:2:1");
  EXPECT_EQ(block.find("NSET")->value.text, "Top");
  EXPECT_EQ(to_string(block.find("NSET")->value.at()), "a.inp:2:15");
  EXPECT_EQ(to_string(block.find("SYSTEM")->name.at()), "a.inp:3:2");
  const auto fields = fields_at(block, 0);
  ASSERT_EQ(fields.size(), 3U);
  EXPECT_EQ(to_string(fields[1].at()), "a.inp:4:6");
  EXPECT_EQ(fields[2].text, "a, b");
  EXPECT_TRUE(faults.empty());
}

} // namespace
} // namespace rubato::mesh::inp::keywords_test
