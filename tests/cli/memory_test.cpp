// SPDX-License-Identifier: LGPL-3.0-or-later
// Models too large for the memory there is: told before it is used up, and plainly when it is.
#include <gtest/gtest.h>

#include "program.hpp"
#include <algorithm>

namespace rubato::memory_test {
namespace {

constexpr rlim_t mebibyte = 1 << 20;

const std::string block = R"(mesh:
  generate:
    - {name: block, box: {from: [0, 0, 0], to: [1, 1, 1]}, divisions: [CELLS, CELLS, CELLS], sides: {bottom: ground, top: roof}}
physics: solid
materials: {steel: {young: 2e11, poisson: 0.3, density: 7800}}
supports: [{on: ground, fix: [x, y, z]}]
loads: [{pressure: {on: roof, value: 1e6}}]
time: {scheme: hht, alpha: -0.1, step: 1e-4, end: 1e-4}
)";

std::string with_cells(int count) {
  auto deck = block;
  for (auto at = deck.find("CELLS"); at != std::string::npos; at = deck.find("CELLS"))
    deck.replace(at, 5, std::to_string(count));
  return deck;
}

class SmallMemory : public testing::Test {
protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the sanitizer reserves more address space than there is to limit";
#endif
  }

  test::Outcome run(int cells, rlim_t memory) const {
    test::write_text(folder_ / "deck.yaml", with_cells(cells));
    setenv("OPENBLAS_NUM_THREADS", "1", 1);
    return test::run_program({"run", "deck.yaml", "-o", "out", "-q"}, folder_.path(), {.memory = memory});
  }

  test::ScratchFolder folder_;
};

TEST_F(SmallMemory, IsFoundOutBeforeAFactorIsComputed) {
  const auto outcome = run(22, 500 * mebibyte);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  EXPECT_TRUE(
      outcome.err.starts_with("error: the model is too large for this machine: with its 34914 unknowns the "
                              "factor of the matrix needs "))
      << outcome.err;
  EXPECT_NE(outcome.err.find("; expected solver: iterative, a coarser mesh or cells of lower order, or "
                             "more memory\n"),
            std::string::npos)
      << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(SmallMemory, IsToldPlainlyWhenItIsUsedUp) {
  const auto outcome = run(60, 300 * mebibyte);
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  EXPECT_TRUE(outcome.err.starts_with("error: the memory does not suffice: ")) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

} // namespace
} // namespace rubato::memory_test
