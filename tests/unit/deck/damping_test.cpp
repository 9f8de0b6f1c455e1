// SPDX-License-Identifier: LGPL-3.0-or-later
// Damping by its ratios at two frequencies.
#include "rubato/deck/read.hpp"
#include "rubato/model/model.hpp"
#include "rubato/study/echo.hpp"

#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/model_of.hpp"
#include "support/two_blocks.hpp"
#include <string>

namespace rubato::deck::damping_test {
namespace {

std::string damped(const std::string& damping) {
  return test::with(test::two_blocks, "cells: all}", "cells: all, " + damping + "}");
}

std::string fault_of(const std::string& damping) {
  return test::fault_of([&] { parse_deck(damped(damping), "deck.yaml"); });
}

TEST(DampingOfADeck, IsReadAndEchoed) {
  const auto study = parse_deck(damped("damping: {ratio: [0.01, 0.02], at: [50, 400]}"), "deck.yaml").runs[0];
  EXPECT_EQ(study.materials[0].damping, (study::DampingRatios{{0.01, 0.02}, {50, 400}}));
  EXPECT_EQ(parse_echo(study::to_json(study), "echo"), study);
}

TEST(DampingOfADeck, IsRayleighsMatrix) {
  // 2 (ξ₂ω₂ − ξ₁ω₁)/(ω₂² − ω₁²) and 2 ω₁ω₂ (ξ₁ω₂ − ξ₂ω₁)/(ω₂² − ω₁²)
  const auto by_ratios = test::model_of(damped("damping: {ratio: [0.01, 0.02], at: [50, 400]}"));
  const auto by_coefficients =
      test::model_of(damped("rayleigh: {stiffness: 1.5157613627799554e-05, mass: 4.78718880547016}"));
  EXPECT_GT(by_ratios.damping.norm(), 0);
  EXPECT_LE((by_ratios.damping - by_coefficients.damping).norm(), 1e-9 * by_ratios.damping.norm());
}

TEST(DampingOfADeck, IsRefusedWhereItMakesNoSense) {
  const auto at = [](const std::string& damping, const std::string& text) {
    EXPECT_NE(fault_of("damping: " + damping).find(text), std::string::npos)
        << fault_of("damping: " + damping);
  };
  at("{ratio: [0.01], at: [50, 400]}", "materials.steel.damping.ratio: found 1 numbers, expected two");
  at("{ratio: [0.01, 0.02]}", "materials.steel.damping: 'at' is missing");
  at("{ratio: [0.01, -0.02], at: [50, 400]}", "damping.ratio.1: found '-0.02', expected a number >= 0");
  at("{ratio: [0.01, 0.02], at: [0, 400]}", "damping.at.0: found '0', expected a number > 0");
  at("{ratio: [0.01, 0.02], at: [50, 50]}", "damping.at: found 50 twice, expected two different frequencies");
  at("{ratio: [0.02, 0.001], at: [50, 400]}", "damping.ratio: the coefficient of the stiffness would be "
                                              "-1.213e-06 < 0, expected a ratio at the higher "
                                              "frequency of at least 0.0025");
  at("{ratio: [0.01, 0.1], at: [50, 400]}", "damping.ratio: the coefficient of the mass would be -1.596 < 0, "
                                            "expected a ratio at the higher frequency "
                                            "of at most 0.08");
  at("{ratio: [0.01, 0.02], at: [50, 400]}, rayleigh: {mass: 1}",
     "damping: found damping ratios beside 'rayleigh', expected one of the two");
}

} // namespace
} // namespace rubato::deck::damping_test
