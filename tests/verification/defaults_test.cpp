// SPDX-License-Identifier: LGPL-3.0-or-later
/// Nobody has to choose a number: with a true start and no coefficient given, modeling C runs to its end at
/// any step and on finer meshes.
#include <gtest/gtest.h>

#include "verification/sdnl140.hpp"

namespace rubato::verification::defaults_test {
namespace {

run::RunResult modeling_c(std::vector<deck::Setting> changes) {
  changes.push_back({"time.start", "consistent"});
  return finish(sdnl140('c', MeshFrom::generator, changes)).result;
}

TEST(Defaults, CarryModelingCToItsEndAtTheStepOfTheReference) {
  const auto result = modeling_c({});
  EXPECT_EQ(result.status, run::Status::complete) << result.message;
}

TEST(Defaults, CarryModelingCToItsEndAtATenthOfTheStep) {
  const auto result = modeling_c({{"time.step", "1e-4"}});
  EXPECT_EQ(result.status, run::Status::complete) << result.message;
}

TEST(Defaults, CarryModelingCToItsEndOnAMeshTwiceAsFine) {
  const auto result = modeling_c({{"mesh.refine", "2"}});
  EXPECT_EQ(result.status, run::Status::complete) << result.message;
}

} // namespace
} // namespace rubato::verification::defaults_test
