// SPDX-License-Identifier: LGPL-3.0-or-later
// A few of the random variants of bodies that yield and stretch, of which `make verify` runs hundreds.
#include <gtest/gtest.h>

#include "verification/solids_sweep.hpp"
#include <algorithm>

namespace rubato::verification::solids_sweep_test {
namespace {

constexpr std::uint32_t seed = 2200;

TEST(RandomSolids, AreTheSameEachTime) {
  const auto first = solid_variants(seed, 3, 2);
  const auto second = solid_variants(seed, 4, 1);
  EXPECT_EQ(first[1].deck, second[0].deck);
  EXPECT_NE(first[0].deck, first[1].deck);
}

class RandomSolid : public testing::TestWithParam<int> {};

TEST_P(RandomSolid, FinishesWithDefaultsAndItsLedgerCloses) {
  const auto variant = solid_variants(seed, GetParam(), 1).front();
  const auto survival = survive(variant);
  EXPECT_TRUE(survival.finished()) << variant.words << "\n" << survival.failure;
  EXPECT_LE(survival.balance, 1e-9) << variant.words;
  EXPECT_LE(survival.penetration, 1e-6) << variant.words;
  EXPECT_LE(survival.tension, 1e-6) << variant.words;
}

INSTANTIATE_TEST_SUITE_P(Variants, RandomSolid, testing::Range(0, 16));
/// A round seal that nothing but three obstacles hold, and blocks that slide between two plates: bodies
/// without loads, whose matrix has springs of contact. 81 flows at a constant stress and slips along both.
INSTANTIATE_TEST_SUITE_P(HeldByContact, RandomSolid, testing::Values(81, 121, 164));

TEST(RandomPlasticBeams, TakeAtMostTwoFactorisationsAStep) {
  double factorisations = 0;
  double steps = 0;
  int yielded = 0;
  for (const auto& variant : solid_variants(seed, 20, 70)) {
    if (variant.family != "plastic beams")
      continue;
    const auto survival = survive(variant);
    EXPECT_TRUE(survival.finished()) << variant.words << "\n" << survival.failure;
    factorisations += survival.factorisations;
    steps += survival.result.steps;
    yielded += survival.plastic > 1e-3 ? 1 : 0;
  }
  EXPECT_GE(yielded, 6);
  EXPECT_LE(factorisations / std::max(1., steps), 2);
}

} // namespace
} // namespace rubato::verification::solids_sweep_test
