// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/threads.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace rubato::threads_test {
namespace {

TEST(Threads, AreOneByDefaultWhichIsTheCaller) {
  const Threads one;
  EXPECT_EQ(one.count(), 1);
  const auto caller = std::this_thread::get_id();
  std::vector<int> called;
  one.each(3, [&](int part) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    called.push_back(part);
  });
  EXPECT_EQ(called, (std::vector{0, 1, 2}));
}

TEST(Threads, DoEveryPartOnce) {
  for (const int count : {2, 3, 7}) {
    const Threads threads(count);
    EXPECT_EQ(threads.count(), count);
    std::vector<std::atomic<int>> calls(100);
    threads.each(100, [&](int part) { ++calls[static_cast<std::size_t>(part)]; });
    for (const auto& call : calls)
      EXPECT_EQ(call, 1);
  }
}

TEST(Threads, WorkAtTheSameTime) {
  const Threads two(2);
  std::atomic<int> arrived = 0;
  // Each part waits for the other one: one thread alone would not come to an end.
  two.each(2, [&](int) {
    ++arrived;
    while (arrived < 2)
      std::this_thread::yield();
  });
  EXPECT_EQ(arrived, 2);
}

TEST(Threads, MayBeAskedFromWithinAPart) {
  const Threads two(2);
  std::atomic<int> sum = 0;
  two.each(2, [&](int) { two.each(5, [&](int part) { sum += part; }); });
  EXPECT_EQ(sum, 20);
}

TEST(Threads, PassOnWhatAPartThrows) {
  const Threads two(2);
  EXPECT_THROW(two.each(4,
                        [](int part) {
                          if (part == 3)
                            throw std::runtime_error("three");
                        }),
               std::runtime_error);
}

TEST(Threads, TakeNoMorePartsThanPay) {
  const Threads four(4);
  EXPECT_EQ(four.parts_of(0, 100), 1);
  EXPECT_EQ(four.parts_of(199, 100), 1);
  EXPECT_EQ(four.parts_of(200, 100), 2);
  EXPECT_EQ(four.parts_of(5000, 100), 4);
  EXPECT_EQ(Threads().parts_of(5000, 100), 1);
}

TEST(Threads, DealOutRangesThatFollowOneAnother) {
  for (const std::size_t pieces : {std::size_t{0}, std::size_t{7}, std::size_t{1001}}) {
    std::vector<int> met(pieces, 0);
    std::atomic<int> ranges = 0;
    Threads(3).each_range(pieces, 100, [&](std::size_t first, std::size_t last) {
      ++ranges;
      for (auto i = first; i < last; ++i)
        ++met[i];
    });
    EXPECT_EQ(met, std::vector<int>(pieces, 1));
    EXPECT_EQ(ranges, pieces < 200 ? 1 : 3);
  }
}

TEST(Threads, AreAtLeastOne) {
  EXPECT_THROW(Threads(0), std::invalid_argument);
  EXPECT_THROW(Threads(-2), std::invalid_argument);
  EXPECT_GE(physical_cores(), 1);
  EXPECT_LE(physical_cores(), static_cast<int>(std::thread::hardware_concurrency()));
}

} // namespace
} // namespace rubato::threads_test
