// SPDX-License-Identifier: LGPL-3.0-or-later
// Zones of one study, each with a method of its own.
#include "rubato/contact/zone.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/step/energy.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/walk.hpp"
#include <cmath>
#include <string>
#include <tuple>

namespace rubato::step::mixed_methods_test {
namespace {

using test::Walk;

constexpr const char* methods[] = {"augmented_lagrangian", "penalty", "nodal_lagrange", "nodal_penalty",
                                   "exponential"};

class ZonesBy : public testing::TestWithParam<std::tuple<const char*, const char*>> {
protected:
  static std::vector<deck::Setting> changes(const char* solver) {
    std::vector<deck::Setting> settings{
        {"contact.above.friction", "0.2"},
        {"supports", "[{on: ground, fix: [x, y]}, {on: roof, fix: x, y: -0.03}]"},
        {"solver", solver}};
    for (const std::string zone : {"below", "above"}) {
      const std::string method = zone == "below" ? std::get<0>(GetParam()) : std::get<1>(GetParam());
      settings.push_back({"contact." + zone + ".method", method});
      if (method == "exponential")
        settings.push_back({"contact." + zone + ".coefficients", "{pressure: 1e4, clearance: 1e-4}"});
    }
    return settings;
  }
  static bool by_springs(std::size_t zone) {
    const std::string method = zone == 0 ? std::get<0>(GetParam()) : std::get<1>(GetParam());
    return method.ends_with("penalty") || method == "exponential";
  }
};

/// Three blocks on one another: ε = 0.01 in all, and E ε A = 2e4 through both zones, but for what springs
/// give way.
TEST_P(ZonesBy, DifferentMethodsHandOnTheSameForce) {
  Walk walk(test::three_blocks, changes("condensed"));
  ASSERT_TRUE(walk.to_end());
  const auto below = walk.resultants(0), above = walk.resultants(1);
  EXPECT_NEAR(below.normal, above.normal, 1e-7 * below.normal);
  EXPECT_NEAR(below.normal, 2e4, 0.05 * 2e4);
  if (!by_springs(0) && !by_springs(1)) {
    EXPECT_NEAR(below.normal, 2e4, 1e-7 * 2e4);
  } else {
    EXPECT_LT(below.normal, 2e4 * (1 - 1e-7)) << "springs give way";
  }
}

TEST_P(ZonesBy, DifferentMethodsMoveAlikeByBothSolvers) {
  Walk condensed(test::three_blocks, changes("condensed"));
  Walk full(test::three_blocks, changes("full"));
  ASSERT_TRUE(condensed.to_end());
  ASSERT_TRUE(full.to_end());
  const double size = full.state().motion.u.lpNorm<Eigen::Infinity>();
  EXPECT_LT((condensed.state().motion.u - full.state().motion.u).lpNorm<Eigen::Infinity>(), 1e-7 * size);
}

/// Work of the roof: what the blocks and the springs of those zones that have some hold, friction is nothing.
TEST_P(ZonesBy, DifferentMethodsHoldEnergyInTheirOwnSpringsOnly) {
  Walk walk(test::three_blocks, changes("condensed"));
  ASSERT_TRUE(walk.to_end());
  for (std::size_t z = 0; z < 2; ++z) {
    const double held = energy_of_springs(std::span(walk.model.zones).subspan(z, 1),
                                          std::span(walk.state().zones).subspan(z, 1));
    if (by_springs(z))
      EXPECT_GT(held, 0) << z;
    else
      EXPECT_EQ(held, 0) << z;
  }
}

INSTANTIATE_TEST_SUITE_P(Every, ZonesBy,
                         testing::Combine(testing::ValuesIn(methods), testing::ValuesIn(methods)),
                         [](const auto& chosen) {
                           return std::string(std::get<0>(chosen.param)) + "_" + std::get<1>(chosen.param);
                         });

} // namespace
} // namespace rubato::step::mixed_methods_test
