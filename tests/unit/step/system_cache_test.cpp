// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/system_cache.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/walk.hpp"

namespace rubato::step::system_cache_test {
namespace {

/// Counts the matrices that are factored.
class Counted {
public:
  EffectiveSystem& of(double length) { return cache_.of(length); }
  int factored() const { return factored_; }

private:
  test::Walk walk_{test::two_beams};
  int factored_ = 0;
  SystemCache cache_{walk_.model, walk_.scheme, [this](std::size_t) { ++factored_; }};
};

constexpr double main_length = 1e-4;

TEST(SystemCache, MakesTheSystemOfALengthOnce) {
  Counted cache;
  EXPECT_EQ(cache.of(main_length).step, main_length);
  EXPECT_EQ(&cache.of(main_length), &cache.of(main_length));
  EXPECT_EQ(cache.factored(), 1);
}

TEST(SystemCache, KeepsTheMainLengthThroughManyCuts) {
  Counted cache;
  for (int i = 0; i < 5; ++i)
    cache.of(main_length);
  for (int cut = 1; cut <= 10; ++cut)
    cache.of(main_length / (1 << cut));
  EXPECT_EQ(cache.factored(), 11);
  cache.of(main_length);
  EXPECT_EQ(cache.factored(), 11);
}

TEST(SystemCache, LetsGoOfTheLengthThatWasNotUsedForLongest) {
  Counted cache;
  for (const double part : {1.0, 1.0, 1.0, 2.0, 4.0, 8.0})
    cache.of(main_length / part);
  cache.of(main_length / 2);
  cache.of(main_length / 16); // the main length was used most, so a fourth of it goes
  EXPECT_EQ(cache.factored(), 5);
  for (const double part : {1.0, 2.0, 8.0, 16.0})
    cache.of(main_length / part);
  EXPECT_EQ(cache.factored(), 5);
  cache.of(main_length / 4);
  EXPECT_EQ(cache.factored(), 6);
}

} // namespace
} // namespace rubato::step::system_cache_test
