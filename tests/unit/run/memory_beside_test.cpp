// SPDX-License-Identifier: LGPL-3.0-or-later
// What a run may take beside others.
#include "rubato/run/memory_beside.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace rubato::run::memory_beside_test {
namespace {

constexpr auto unlimited = std::numeric_limits<std::size_t>::max();

TEST(MemoryLeft, IsAllThatIsFreeForARunAlone) {
  EXPECT_EQ(memory_left(10, {}, {.free = 100, .limit = unlimited}), 100);
}

TEST(MemoryLeft, IsWithoutWhatOthersHaveCountedAndNotTakenYet) {
  const std::vector<MemoryOfRun> others{{.need = 50, .taken = 20}, {.need = 30, .taken = 30}};
  EXPECT_EQ(memory_left(10, others, {.free = 100, .limit = unlimited}), 70);
}

TEST(MemoryLeft, OfARunThatTookMoreThanItCountedIsWhatIsFree) {
  const std::vector<MemoryOfRun> others{{.need = 50, .taken = 80}};
  EXPECT_EQ(memory_left(10, others, {.free = 100, .limit = unlimited}), 100);
}

TEST(MemoryLeft, IsNothingWhereOthersWillTakeAll) {
  const std::vector<MemoryOfRun> others{{.need = 500, .taken = 20}};
  EXPECT_EQ(memory_left(10, others, {.free = 100, .limit = unlimited}), 0);
}

TEST(MemoryLeft, StaysBelowTheLimitOfAllTogether) {
  const std::vector<MemoryOfRun> others{{.need = 50, .taken = 20, .address_space = 100},
                                        {.need = 30, .taken = 35, .address_space = 200}};
  EXPECT_EQ(memory_left(90, others, {.free = 1000, .limit = 500}), 500 - (100 + 30) - 200 - 90);
  EXPECT_EQ(memory_left(90, others, {.free = 1000, .limit = 400}), 0);
}

TEST(NeedAlike, GoesByMeshPhysicsAndSolver) {
  study::Study one;
  one.mesh.file = "part.med";
  auto other = one;
  other.name = "other";
  other.time.end = 7;
  EXPECT_TRUE(need_alike(one, other));
  other.solver = study::Solver::full;
  EXPECT_FALSE(need_alike(one, other));
  other = one;
  other.mesh.file = "fine.med";
  EXPECT_FALSE(need_alike(one, other));
  other = one;
  other.time.scheme = study::SchemeKind::central_difference;
  EXPECT_FALSE(need_alike(one, other));
}

} // namespace
} // namespace rubato::run::memory_beside_test
