// SPDX-License-Identifier: LGPL-3.0-or-later
// Words that were meant, and how messages show what was found.
#include "rubato/core/naming.hpp"

#include <gtest/gtest.h>

namespace rubato::naming_test {
namespace {

const std::vector<std::string> keys{"step", "end", "instants", "scheme"};

TEST(TheNearestWord, IsTheOneWithTheFewestEdits) {
  EXPECT_EQ(nearest_word("stpe", keys), "step");
  EXPECT_EQ(nearest_word("sheme", keys), "scheme");
  EXPECT_EQ(nearest_word("instant", keys), "instants");
  EXPECT_EQ(nearest_word("steps", {"stops", "step"}), "stops") << "one edit each: the first";
}

TEST(TheNearestWord, DoesNotSeeTheCaseOfLetters) {
  EXPECT_EQ(nearest_word("SCHEME", keys), "scheme");
}

/// Two edits of a short word, half the letters of a long one.
TEST(TheNearestWord, IsNoneWhereAllAreFar) {
  EXPECT_EQ(nearest_word("abd", {"abc"}), "abc");
  EXPECT_EQ(nearest_word("ade", {"abc"}), "abc");
  EXPECT_EQ(nearest_word("xyz", {"abc"}), "");
  EXPECT_EQ(nearest_word("abcdefgh", {"abcd"}), "abcd");
  EXPECT_EQ(nearest_word("abcdefgh", {"abc"}), "");
  EXPECT_EQ(nearest_word("step", {}), "");
}

TEST(ASuggestion, NamesTheNearestWordOrAll) {
  EXPECT_EQ(suggestion("stpe", keys), "; did you mean 'step'?");
  EXPECT_EQ(suggestion("friction", {"a", "b"}), "; expected one of a, b");
  EXPECT_EQ(suggestion("friction", {}), "");
}

TEST(AWordInAMessage, IsCutWhereItIsLongAndNeverInsideALetter) {
  EXPECT_EQ(shown(""), "''");
  EXPECT_EQ(shown(std::string(60, 'a')), "'" + std::string(60, 'a') + "'");
  EXPECT_EQ(shown(std::string(61, 'a')), "'" + std::string(60, 'a') + "…'");
  EXPECT_EQ(shown(std::string(59, 'a') + "μμ"), "'" + std::string(59, 'a') + "…'");
  EXPECT_EQ(shown(std::string(58, 'a') + "μμ"), "'" + std::string(58, 'a') + "μ…'");
}

TEST(AName, IsWhatFilesAndColumnsCanBeCalled) {
  EXPECT_TRUE(is_name("run_1-b"));
  EXPECT_TRUE(is_name("Größe"));
  EXPECT_TRUE(is_name(std::string(100, 'a')));
  EXPECT_FALSE(is_name(std::string(101, 'a')));
  EXPECT_FALSE(is_name(""));
  for (const char* text : {"a b", "a/b", "..", "a,b", "a\n", "a\"b"})
    EXPECT_FALSE(is_name(text)) << text;
}

} // namespace
} // namespace rubato::naming_test
