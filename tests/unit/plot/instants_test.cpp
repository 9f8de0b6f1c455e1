// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/instants.hpp"

#include <gtest/gtest.h>

#include "support/faults.hpp"
#include <array>

namespace rubato::plot::instants_test {
namespace {

constexpr std::array stored{0.0, 0.1, 0.30000000000000004, 1.0};

TEST(StoredInstants, AreFoundThroughTheRoundingOfTime) {
  EXPECT_EQ(stored_instant("run", stored, 0.3), 0.30000000000000004);
  EXPECT_EQ(stored_instant("run", stored, 1), 1.0);
  EXPECT_EQ(stored_instant("run", std::array{5e-4}, 5e-4), 5e-4);
}

TEST(StoredInstants, ThatAreNotThereAreToldWithTheNearest) {
  const auto fault = [](double at) { return test::fault_of([&] { stored_instant("run", stored, at); }); };
  EXPECT_EQ(fault(0.2), "run: nothing is stored at t = 0.2; the nearest stored are 0.1 and 0.3");
  EXPECT_EQ(fault(2), "run: nothing is stored at t = 2; the nearest stored is 1");
  EXPECT_EQ(fault(-1), "run: nothing is stored at t = -1; the nearest stored is 0");
}

} // namespace
} // namespace rubato::plot::instants_test
