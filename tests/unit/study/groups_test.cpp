// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/study/groups.hpp"

#include <gtest/gtest.h>

namespace rubato::study::groups_test {
namespace {

MadeGroup union_of(const std::string& name, std::vector<std::string> of) {
  MadeGroup group;
  group.name = name;
  group.kind = GroupKind::union_of;
  group.of = std::move(of);
  return group;
}

TEST(TheOrderOfGroups, IsThatInWhichTheyNeedOneAnother) {
  const std::vector groups{union_of("a", {"c", "b"}), union_of("b", {"d", "left"}), union_of("c", {"b", "d"}),
                           union_of("d", {"left", "right"})};
  const auto found = order_of(groups);
  EXPECT_EQ(found.order, (std::vector<std::size_t>{3, 1, 2, 0}));
  EXPECT_TRUE(found.cycle.empty());
}

TEST(TheOrderOfGroups, LeavesOutThoseThatWaitForOneAnother) {
  const std::vector groups{union_of("a", {"b", "c"}), union_of("b", {"left", "c"}),
                           union_of("c", {"left", "b"}), union_of("d", {"left", "right"})};
  const auto found = order_of(groups);
  EXPECT_EQ(found.order, (std::vector<std::size_t>{3}));
  EXPECT_EQ(found.cycle, (std::vector<std::string>{"b", "c", "b"}));
}

TEST(TheOrderOfGroups, NamesAGroupThatIsMadeOfItself) {
  EXPECT_EQ(order_of(std::vector{union_of("a", {"left", "a"})}).cycle, (std::vector<std::string>{"a", "a"}));
}

TEST(KindsOfGroups, StandInTheOrderOfTheirValues) {
  for (std::size_t i = 0; i < group_kinds.size(); ++i)
    EXPECT_EQ(static_cast<std::size_t>(group_kinds[i].kind), i);
}

} // namespace
} // namespace rubato::study::groups_test
