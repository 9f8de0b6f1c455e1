// SPDX-License-Identifier: LGPL-3.0-or-later
// How much memory is left, and how it is told.
#include "rubato/linalg/memory.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>
#include <sys/resource.h>
#include <unistd.h>

namespace rubato::linalg::memory_test {
namespace {

constexpr std::size_t mebibyte = 1 << 20;

/// Limits the address space of this process, until the end of the scope, to what it has and `more` [bytes],
/// which may be less than nothing.
class AddressSpace {
public:
  explicit AddressSpace(std::ptrdiff_t more) {
    getrlimit(RLIMIT_AS, &before_);
    auto now = before_;
    now.rlim_cur = in_use() + static_cast<std::size_t>(more);
    limited_ = setrlimit(RLIMIT_AS, &now) == 0;
  }
  ~AddressSpace() { setrlimit(RLIMIT_AS, &before_); }
  AddressSpace(const AddressSpace&) = delete;
  AddressSpace& operator=(const AddressSpace&) = delete;
  bool limited() const { return limited_; }

private:
  static std::size_t in_use() {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  }
  rlimit before_{};
  bool limited_ = false;
};

TEST(AvailableMemory, IsWhatTheMachineHasAtMost) {
  const auto available = available_memory();
  const auto machine =
      static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  EXPECT_GT(available, 64 * mebibyte) << "less than any test of this project needs";
  EXPECT_LE(available, machine);
}

TEST(AvailableMemory, IsNoMoreThanTheLimitOfTheProcessLeaves) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer reserves more address space than there is to limit";
#endif
  const auto before = available_memory();
  if (before < 256 * mebibyte)
    GTEST_SKIP() << "the machine itself has less left";
  std::size_t within = 0;
  std::size_t none = 1;
  {
    const AddressSpace limit(64 * mebibyte);
    ASSERT_TRUE(limit.limited());
    within = available_memory();
  }
  {
    const AddressSpace limit(-static_cast<std::ptrdiff_t>(mebibyte));
    ASSERT_TRUE(limit.limited());
    none = available_memory();
  }
  EXPECT_LE(within, 64 * mebibyte);
  EXPECT_GT(within, 48 * mebibyte);
  EXPECT_EQ(none, 0U);
  EXPECT_GT(available_memory(), 64 * mebibyte) << "the limit is gone";
}

TEST(MemoryText, HasTwoDigitsAndTheUnitThatFits) {
  EXPECT_EQ(memory_text(0), "0.0 kB");
  EXPECT_EQ(memory_text(1'500), "1.5 kB");
  EXPECT_EQ(memory_text(512'000), "512 kB");
  EXPECT_EQ(memory_text(2'560'000'000), "2.6 GB");
  EXPECT_EQ(memory_text(38'400'000), "38 MB");
  EXPECT_EQ(memory_text(123'000'000'000), "123 GB");
}

TEST(MemoryText, TakesTheNextUnitWhereRoundingReachesIt) {
  EXPECT_EQ(memory_text(999'499), "999 kB");
  EXPECT_EQ(memory_text(999'500), "1.0 MB");
  EXPECT_EQ(memory_text(999'499'999), "999 MB");
  EXPECT_EQ(memory_text(999'500'000), "1.0 GB");
}

TEST(AFactorTooLarge, TellsWhatItNeedsAndWhatThereIs) {
  const TooLargeForMemory error(2'560'000'000, 38'400'000);
  EXPECT_EQ(error.needed, 2'560'000'000U);
  EXPECT_EQ(error.available, 38'400'000U);
  EXPECT_STREQ(error.what(), "the factor of the matrix needs 2.6 GB of memory, of which 0.038 GB are left");
}

TEST(MemoryOfAProcess, IsPartOfItsAddressSpace) {
  const auto own = memory_of_process(getpid());
  EXPECT_GT(own.resident, mebibyte);
  EXPECT_GT(own.address_space, own.resident);
  EXPECT_EQ(memory_of_process(-1).resident, 0);
}

TEST(FreeMemory, DoesNotKnowTheLimitOfThisProcess) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer reserves more address space than there is to limit";
#endif
  const AddressSpace few(64 * mebibyte);
  ASSERT_TRUE(few.limited());
  EXPECT_LE(available_memory(), 64 * mebibyte);
  EXPECT_GT(free_memory(), 64 * mebibyte);
  EXPECT_GT(memory_limit(), 64 * mebibyte);
  EXPECT_LT(memory_limit(), memory_of_process(getpid()).address_space + 128 * mebibyte);
}

} // namespace
} // namespace rubato::linalg::memory_test
