// SPDX-License-Identifier: LGPL-3.0-or-later
// Models of mutated decks: each is built or refused with sentences, whatever stands at a node.
#include "rubato/core/error.hpp"
#include "rubato/model/model.hpp"

#include <gtest/gtest.h>

#include "support/driven_deck.hpp"
#include "support/model_of.hpp"
#include <algorithm>
#include <array>
#include <cctype>
#include <random>
#include <string>

namespace rubato::model::fuzz_test {
namespace {

constexpr std::array tokens{"0",       "-1",          "1e300",        "1e-300",       "2",
                            "\"1/x\"", "\"1/(x-2)\"", "\"log(y-1)\"", "\"sqrt(-t)\"", "\"t/(t-t)\"",
                            "roof",    "sole",        "ground",       "table",        "N1",
                            "N999",    "up",          "low",          "cap",          "mean",
                            "place",   "facing",      "corner",       "both",         "normal",
                            "x",       "z",           "all",          "pin",          "nowhere",
                            "static",  "\"x*1e9\"",   "west",         "east"};

bool is_word(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_' || letter == '.' ||
         letter == '-';
}

/// One word in the place of another, drawn the same on every machine.
std::string mutated(std::string text, std::mt19937& random) {
  auto begin =
      std::find_if(text.begin() + static_cast<std::ptrdiff_t>(random() % text.size()), text.end(), is_word);
  if (begin == text.end())
    begin = std::find_if(text.begin(), text.end(), is_word);
  const auto end = std::find_if_not(begin, text.end(), is_word);
  return text.replace(begin, end, tokens[random() % tokens.size()]);
}

/// Whether there is a model.
bool builds(const std::string& text) {
  try {
    test::model_of(text);
    return true;
  } catch (const InputError& error) {
    EXPECT_FALSE(error.faults().empty()) << text;
    for (const auto& fault : error.faults())
      EXPECT_FALSE(fault.text.empty()) << text;
    return false;
  }
}

TEST(ModelFuzz, MutatedDecksGiveAModelOrASentence) {
  constexpr int decks = 2000;
  ASSERT_TRUE(builds(test::driven_deck));
  int valid = 0;
  for (int i = 0; i < decks; ++i) {
    std::mt19937 random(static_cast<std::uint32_t>(i));
    auto text = test::driven_deck;
    for (auto mutations = 1 + random() % 2; mutations > 0; --mutations)
      text = mutated(std::move(text), random);
    valid += builds(text) ? 1 : 0;
  }
  EXPECT_GT(valid, decks / 50);
  EXPECT_LT(valid, decks / 2);
}

} // namespace
} // namespace rubato::model::fuzz_test
