// SPDX-License-Identifier: LGPL-3.0-or-later
#include <gtest/gtest.h>

#include "verification/bulk_seal.hpp"

namespace rubato::verification {
namespace {

/// Steps of a twentieth of the diameter are more than contact can be predicted for: the first moves of the
/// ring turn cells inside out, and the step is cut instead.
TEST(PressedSeal, IsCutWhereThePredictionTurnsCellsInsideOut) {
  const auto coarse = press_seal(8, 0.05);
  EXPECT_GT(coarse.cuts, 0);
  EXPECT_LE(coarse.balance, 1e-12);
}

} // namespace
} // namespace rubato::verification
