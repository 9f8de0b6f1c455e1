// SPDX-License-Identifier: LGPL-3.0-or-later
// Where faults are, and how several are told.
#include "rubato/core/error.hpp"

#include <gtest/gtest.h>

namespace rubato::error_test {
namespace {

TEST(ALocation, IsToldAsFarAsItIsKnown) {
  EXPECT_EQ(to_string(Location{"deck.yaml", 3, 7}), "deck.yaml:3:7");
  EXPECT_EQ(to_string(Location{"deck.yaml", 3, 0}), "deck.yaml:3");
  EXPECT_EQ(to_string(Location{"deck.yaml", 0, 7}), "deck.yaml");
  EXPECT_EQ(to_string(Location{}), "");
}

TEST(APlace, IsInTheFileOrElseInTheStudy) {
  Fault fault = fault_at("supports.0.on", "found 'hold'");
  EXPECT_EQ(place_of(fault), "supports.0.on");
  fault.at = {"deck.yaml", 3, 7};
  EXPECT_EQ(place_of(fault), "deck.yaml:3:7");
}

TEST(APlace, IsNotToldTwice) {
  EXPECT_EQ(place_of(fault_at("time.step", "time.step: found 0, expected > 0")), "");
  EXPECT_EQ(place_of(fault_at("", "found nothing")), "");
}

TEST(BadInput, TellsEachFaultOnALineOfItsOwn) {
  const InputError error(
      {fault_at("time.end", "found 0"), {{"deck.yaml", 3, 7}, "found 'hold'"}, {{}, "all"}});
  EXPECT_STREQ(error.what(), "time.end: found 0\ndeck.yaml:3:7: found 'hold'\nall");
  EXPECT_EQ(error.faults().size(), 3U);
}

TEST(BadInput, MayBeOneSentence) {
  const InputError error("found nothing", {"deck.yaml", 3, 0});
  EXPECT_STREQ(error.what(), "deck.yaml:3: found nothing");
  ASSERT_EQ(error.faults().size(), 1U);
  EXPECT_EQ(error.faults()[0].text, "found nothing");
}

} // namespace
} // namespace rubato::error_test
