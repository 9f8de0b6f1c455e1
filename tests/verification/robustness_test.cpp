// SPDX-License-Identifier: LGPL-3.0-or-later
// A few of the random variants that `make verify` runs hundreds of, small and short.
#include <gtest/gtest.h>

#include "verification/robustness.hpp"

namespace rubato::verification::robustness_test {
namespace {

constexpr std::uint32_t seed = 140;
constexpr int count = 20;

TEST(RandomBeams, AreTheSameEachTime) {
  const auto first = variants(seed, 3, 2);
  const auto second = variants(seed, 4, 1);
  EXPECT_EQ(first[1].deck, second[0].deck);
  EXPECT_NE(first[0].deck, first[1].deck);
}

TEST(RandomBeams, FinishOrSayWhyNotAndTheirLedgersClose) {
  int finished = 0;
  for (const auto& variant : variants(seed, 0, count, Meshes::coarse)) {
    const auto survival = survive(variant);
    finished += survival.finished() ? 1 : 0;
    EXPECT_LE(survival.balance, 1e-10) << variant.number << ": " << variant.words;
    if (variant.safe && !variant.overlaps) {
      EXPECT_FALSE(survival.keeps_gain()) << variant.number << ": " << variant.words;
    }
    if (!survival.finished()) {
      EXPECT_TRUE(survival.failure.starts_with("no convergence from t = ")) << variant.words << "\n"
                                                                            << survival.failure;
    }
  }
  EXPECT_GE(finished, count * 9 / 10);
}

} // namespace
} // namespace rubato::verification::robustness_test
