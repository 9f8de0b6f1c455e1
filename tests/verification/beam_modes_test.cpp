// SPDX-License-Identifier: LGPL-3.0-or-later
// Natural frequencies against Code_Aster's, and V11's first one against Timoshenko's beam.
#include "rubato/deck/read.hpp"
#include "rubato/modes/modal_study.hpp"

#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "verification/beam_modes.hpp"
#include "verification/free_beam.hpp"
#include <numbers>

namespace rubato::verification::beam_modes_test {
namespace {

class ModesOfBeam : public testing::TestWithParam<BeamModes> {};

TEST_P(ModesOfBeam, AreThoseOfCodeAster) {
  const auto reference = reference_frequencies(GetParam());
  if (!reference)
    GTEST_SKIP() << "no ../shared/oracle";
  const auto modes = computed_modes(GetParam());
  ASSERT_EQ(reference->size(), 10U);
  EXPECT_LE(largest_deviation(modes, *reference), 1e-8);
  EXPECT_LE(modes.residuals.maxCoeff(), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Shared, ModesOfBeam, testing::ValuesIn(beams_with_modes()),
                         [](const auto& beam) { return beam.param.name; });

TEST(ModesOfV11, BeginWithTimoshenkosFrequency) {
  const auto study = deck::read_deck(RUBATO_SOURCE_DIR "/cases/v11_free_beam/beam.yaml").runs.front();
  const test::BuiltModel model(modes::modal_study(study));
  const double omega = 2 * std::numbers::pi * modes::modes_of(model, {.number = 1}).frequencies[0];
  EXPECT_NEAR(omega, first_mode(model).omega, 1e-9 * omega) << "by a dense solution";
  EXPECT_NEAR(omega, timoshenko, 1e-4 * timoshenko);
}

} // namespace
} // namespace rubato::verification::beam_modes_test
